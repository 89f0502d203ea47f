#pragma once
// The simulation behind a window. It restarts whenever the light changes, and publishes intermediate results. The moments of a
// day that is played are simulated together, some ahead of being shown, for as long as they will be shown.

#include "files/scene/scene_reader.h"
#include "physics/transport/model/result.h"
#include "programs/cli/options.h"
#include "programs/viewer/light_request.h"
#include "simulate/simulation.h"

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace sunfleck {

// Outcome of a request to save.
struct SaveOutcome {
  bool done = false;
  std::string text;  // one line
};

// State of the simulation, small enough to be copied every frame.
struct LightNews {
  std::uint64_t request = 0;                  // number of the request that is or was simulated last; counts from 1
  std::uint64_t version = 0;                  // of the latest result; 0: none yet
  std::uint64_t result_request = 0;           // number of the request that the result belongs to
  bool complete = false;                      // no further result of this request will follow
  StopReason stop = StopReason::interrupted;  // why it ended: the bounds or a limit were reached
  double seconds = 0.0;                       // from the request to the result
  std::uint64_t rays = 0;                     // of the result, including packets and sky rays
  // Replicates of the direct pass that were reused instead of traced, since the scene was loaded.
  std::uint64_t spared_beams = 0;
  std::optional<SunPosition> sun;
  std::vector<Waveband> incoming;  // [band], incident light
  // As grant returns it.
  std::optional<double> assumed_diffuse_share;
  std::optional<double> direct_error, indirect_error;
  double direct_bound = 0.0, indirect_bound = 0.0;
  std::vector<BandResult> bands;
  std::vector<LayerResult> layers;
  std::string problem;               // one line, why the last request failed; empty if it did not
  std::optional<SaveOutcome> saved;  // outcome of the last request to save, once known
  bool saving = false;
};

// Identifies a result.
struct LightStamp {
  std::uint64_t version = 0;  // as in LightNews; increases with every result
  std::uint64_t request = 0;
  bool complete = false;
};

// How long each moment of a played day is shown at least, s.
inline constexpr double played_moment_s = 0.35;

class LiveLight {
 public:
  // Starts with the scene's own light. The simulation must outlive the object; `notify` is called from the simulating thread when
  // there is news. `played_s` is how long each moment of a played day is simulated at most.
  LiveLight(Simulation& simulation, const RunOptions& options, std::function<void()> notify, double played_s = played_moment_s);
  ~LiveLight();
  LiveLight(const LiveLight&) = delete;
  LiveLight& operator=(const LiveLight&) = delete;

  // Restarts with other light. Returns the number of the request. `ahead` are the moments of a day that will be asked for next,
  // with no other difference than the sun's hour: this moment and they share packets, as far as memory allows, and have one
  // result each, whose accuracy is what the time for which moments are shown allows.
  std::uint64_t ask(const LightRequest& request, std::vector<LightRequest> ahead = {});

  // Writes the result into a folder as `run` does, complete or not, as soon as there is one; planes and sensors are left out.
  // Beside it goes scene.toml, from which `run` makes the same result, with copies of the files that it names. Moments
  // of a played day are not saved, as `run` cannot repeat them; the next other light is.
  void save(const std::filesystem::path& folder);

  // Returns whether the scene's beam keeps its irradiance while the sun moves.
  [[nodiscard]] bool has_fixed_beam() const { return sunfleck::has_fixed_beam(original_); }

  [[nodiscard]] LightNews news() const;

  // Returns the scene, of which only the parts that no light changes may be read at any time: triangles, organs, plot, camera.
  [[nodiscard]] const Scene& geometry() const { return simulation_.scene(); }

  // Calls `use` with the result and its scene, both valid during the call. Returns false without calling it if there is no
  // result yet.
  template <class Use>
  bool with_result(const Use& use) const {
    const std::lock_guard lock(result_mutex_);
    if (!result_) return false;
    use(simulation_.scene(), *result_, stamp_);
    return true;
  }

 private:
  using Clock = std::chrono::steady_clock;
  using Kept = std::vector<std::pair<LightRequest, RadiationResult>>;

  void work();
  [[nodiscard]] bool wait_for_order();
  void simulate_request(const LightRequest& request, std::uint64_t number);
  // Makes a request's light that of the scene.
  void begin_request(const LightRequest& request, std::uint64_t number);
  // Simulates those of the moments together that are not kept, up to the first without light. Returns false if there are none,
  // or if so little time is not enough for this scene.
  [[nodiscard]] bool simulate_together(const std::vector<LightRequest>& moments, double most_s);
  // Shows the moment that is asked for if its result is kept; returns whether it was.
  bool show_kept();
  // Returns the scene in a moment's light; nothing if that is impossible.
  [[nodiscard]] std::optional<RadiationModel> granted(const LightRequest& request) const;
  // Return the kept result of a moment, and whether that of the request is kept or being made. The caller holds news_mutex_.
  [[nodiscard]] Kept::const_iterator find_kept(const LightRequest& request) const;
  [[nodiscard]] bool is_foreseen() const;
  // Returns the first of the moments that are not kept, as many as are simulated together.
  [[nodiscard]] std::vector<LightRequest> missing(const std::vector<LightRequest>& moments) const;
  void take_result(RadiationResult result, std::uint64_t number, bool complete);
  void tell(const RadiationResult& result, std::uint64_t number, bool complete);
  void save_if_asked();
  void write(const std::filesystem::path& folder, const RadiationResult& result);
  [[nodiscard]] bool superseded(std::uint64_t number) const { return quitting_ || asked_ != number; }
  [[nodiscard]] bool wants_result() const;

  Scene original_;  // with the light as read; its canopy is empty
  Simulation& simulation_;
  RunOptions options_;
  std::function<void()> notify_;
  SolveSettings settings_;
  double played_s_;
  bool has_receivers_;          // planes or sensors, which the window does not show
  bool is_played_ = false;      // the result is that of a moment of a played day
  std::size_t most_in_memory_;  // moments for which there is memory
  // Moments that are simulated together: half as many after a time that was too short for them, twice as many after one that
  // was long enough, and never more again once a single one is left.
  std::size_t most_together_;

  std::atomic<bool> quitting_ = false;
  std::atomic<std::uint64_t> asked_ = 0;  // number of the last request
  std::atomic<bool> save_asked_ = false;
  std::atomic<bool> in_vain_ = false;  // what is asked for is not among the moments that are kept or being simulated

  mutable std::mutex result_mutex_;  // guards the simulation's scene and the next three members; readers may hold it
  std::optional<RadiationResult> result_;
  LightRequest granted_;  // the light of the simulation's scene
  LightStamp stamp_;

  // Guards the members below up to the worker; held only briefly.
  mutable std::mutex news_mutex_;
  std::condition_variable order_;
  LightRequest request_;
  std::vector<LightRequest> ahead_;     // empty once they were simulated
  std::vector<LightRequest> together_;  // moments that are being simulated
  Kept kept_;
  LightNews news_;
  std::filesystem::path save_folder_;
  Clock::time_point asked_at_, last_result_;

  // Declared last, so that all other members exist when it starts.
  std::thread worker_;
};

}  // namespace sunfleck
