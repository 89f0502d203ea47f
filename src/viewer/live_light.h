#pragma once
// The simulation behind a window: begins anew whenever the light is changed, and hands over what is known while it goes on.

#include "app/options.h"
#include "io/scene_reader.h"
#include "simulate/simulation.h"
#include "transport/result.h"
#include "viewer/light_wish.h"

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace sunfleck {

// What became of an order to save.
struct SaveOutcome {
  bool done = false;
  std::string text;  // one line
};

// A result in numbers small enough to be copied at every frame.
struct LightNews {
  std::uint64_t wish = 0;                     // number of the wish that is being simulated, or was last; from 1 on
  std::uint64_t version = 0;                  // of the result that there is; 0: none yet
  std::uint64_t result_wish = 0;              // the wish that the result is of
  bool complete = false;                      // nothing more is to come of this wish
  StopReason stop = StopReason::interrupted;  // why: the bounds are reached, or a limit is
  double seconds = 0.0;                       // from the wish to the result
  std::uint64_t rays = 0;                     // of the result, packets and sky rays included
  std::uint64_t spared_beams = 0;             // replicates of the direct pass that were remembered, since the scene was loaded
  std::optional<SunPosition> sun;
  std::vector<Waveband> incoming;  // [band], what comes in
  std::optional<double> direct_error, indirect_error;
  double direct_bound = 0.0, indirect_bound = 0.0;
  std::vector<BandResult> bands;
  std::vector<LayerResult> layers;
  std::string problem;               // one line, why the last wish was not granted; empty if it was
  std::optional<SaveOutcome> saved;  // what became of the last order to save, once it is known
  bool saving = false;
};

// Which result it is.
struct LightStamp {
  std::uint64_t version = 0;  // as in LightNews; rises with every result
  std::uint64_t wish = 0;
  bool complete = false;
};

class LiveLight {
 public:
  // Begins with the scene as it is. The tree and the engine must outlive it; `notify` is called from the simulating thread when
  // there is news.
  LiveLight(Simulation& simulation, const RunOptions& options, std::function<void()> notify);
  ~LiveLight();
  LiveLight(const LiveLight&) = delete;
  LiveLight& operator=(const LiveLight&) = delete;

  // Begins anew with other light; returns the wish's number.
  std::uint64_t ask(const LightWish& wish);

  // Writes the result as `run` does into a folder, complete or not, as soon as there is one; all but planes and sensors.
  void save(const std::filesystem::path& folder);

  [[nodiscard]] LightNews news() const;

  // What no light changes may be read of it at any time: triangles, organs, plot, camera.
  [[nodiscard]] const Scene& geometry() const { return simulation_.scene(); }

  // The result with the scene it is of, both as long as the call lasts; false, and no call, while there is none.
  template <class Use>
  bool with_result(const Use& use) const {
    const std::lock_guard lock(result_mutex_);
    if (!result_) return false;
    use(simulation_.scene(), *result_, stamp_);
    return true;
  }

 private:
  using Clock = std::chrono::steady_clock;

  void work();
  [[nodiscard]] bool wait_for_order();
  void simulate_wish(const LightWish& wish, std::uint64_t number);
  void take_result(RadiationResult result, std::uint64_t number, bool complete);
  void tell(const RadiationResult& result, std::uint64_t number, bool complete);
  void save_if_asked();
  void write(const std::filesystem::path& folder, const RadiationResult& result);
  [[nodiscard]] bool superseded(std::uint64_t number) const { return quitting_ || asked_ != number; }
  [[nodiscard]] bool wants_result() const;

  Scene original_;  // the light it was read with; its canopy is empty
  Simulation& simulation_;
  RunOptions options_;
  std::function<void()> notify_;
  SolveSettings settings_;
  bool has_receivers_;  // planes or sensors, of which a window knows nothing

  std::atomic<bool> quitting_ = false;
  std::atomic<std::uint64_t> asked_ = 0;  // number of the last wish
  std::atomic<bool> save_asked_ = false;

  mutable std::mutex result_mutex_;  // guards the simulation's scene and the next two members; readers may hold it
  std::optional<RadiationResult> result_;
  LightStamp stamp_;

  mutable std::mutex news_mutex_;  // of the next ones; held for a moment
  std::condition_variable order_;
  LightWish wish_;
  LightNews news_;
  std::filesystem::path save_folder_;
  Clock::time_point asked_at_, last_result_;

  std::thread worker_;  // last, so that all is there when it begins
};

}  // namespace sunfleck
