#pragma once
// The main loop of the window: handles input and draws frames.

#include "programs/cli/options.h"
#include "programs/viewer/camera_fit.h"
#include "programs/viewer/events.h"
#include "programs/viewer/frame_saver.h"
#include "programs/viewer/hands.h"
#include "programs/viewer/scene_loader.h"
#include "programs/viewer/session.h"
#include "programs/viewer/state.h"
#include "programs/viewer/window.h"

#include <array>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sunfleck {

class Viewer {
 public:
  // Loads the scene; the window must outlive the object. Throws as Session does.
  Viewer(const ViewOptions& options, Window& window);

  // Runs until the window is closed or the program interrupted. Returns the exit status.
  [[nodiscard]] int run();

 private:
  using Clock = std::chrono::steady_clock;

  // Enters a loaded scene. Camera and charts stay as they are if the same scene is reloaded; the light is the scene's.
  void enter(std::unique_ptr<Session> session);
  // Begins to load a scene, now or after the one that is being loaded.
  void load(const std::filesystem::path& file);
  void finish_loading();
  void take_dropped_files();

  void frame();
  [[nodiscard]] PictureFrame picture_frame() const;
  void take_news();
  void take_picture();
  void take_keys();
  void obey(const PanelOrders& orders);
  void choose_view(ViewKind view);
  void pick(glm::ivec2 pixel);
  void play();
  void ask_for_light();
  void ask_for_picture();
  void save_picture();
  void tell_saved(const SaveOutcome& outcome);
  void tell_assumed_light();
  [[nodiscard]] std::filesystem::path save_folder() const;
  void tell_problem(std::string& told, const std::string& problem);
  void say_to_user(const std::string& message, bool problem);
  void tell_controls();
  void tell_end();
  [[nodiscard]] double now_s() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
  [[nodiscard]] bool at_work() const;

  ViewOptions options_;
  Window& window_;
  Events events_;
  Clock::time_point start_ = Clock::now();

  std::vector<std::future<void>> leaving_;  // earlier sessions while they end
  std::unique_ptr<Session> session_;
  SceneLoader loader_;

  ViewerState state_;
  CameraFit camera_fit_;
  Hands hands_;
  std::optional<LightRequest> asked_light_;
  std::optional<PictureRequest> asked_picture_;
  double asked_light_at_s_ = 0.0;
  bool asked_played_ = false;       // as a moment of a day that is played
  std::uint64_t light_number_ = 0;  // of the last request
  std::uint64_t told_first_ = 0;    // requests whose first picture and whose end were reported
  std::uint64_t told_done_ = 0;
  std::uint64_t shown_frame_ = 0;
  bool new_pixels_ = true;
  double message_until_s_ = 0.0;
  std::string told_controls_;
  bool save_told_ = true;
  FrameSaver frame_saver_;
  std::array<std::string, 2> told_problems_;  // of light and picture
  bool picked_told_ = false;
  std::optional<double> told_assumed_;
  std::vector<double> frame_times_s_;
};

}  // namespace sunfleck
