// The scene of the window: loading it, entering it and watching its files.

#include "app/terminal.h"
#include "base/error.h"
#include "base/log.h"
#include "io/file.h"
#include "viewer/viewer.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <exception>
#include <new>
#include <utility>

namespace sunfleck {
namespace {

namespace fs = std::filesystem;

constexpr double look_at_files_s = 0.5;

}  // namespace

// Enters a loaded scene. Camera and charts stay as they are if the same scene is reloaded; the light is the scene's.
void Viewer::enter(std::unique_ptr<Session> session) {
  const bool another = session_ && session_->file != session->file;
  const auto ended = [](const std::future<void>& one) {
    return one.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  };
  leaving_.erase(std::remove_if(leaving_.begin(), leaving_.end(), ended), leaving_.end());
  if (session_) leaving_.push_back(std::async(std::launch::async, [old = std::move(session_)]() mutable { old.reset(); }));
  session_ = std::move(session);
  const Scene& scene = session_->light.geometry();
  state_.light = session_->light_of_scene;
  state_.news = {};
  state_.title = session_->title;
  state_.device = device_line(session_->simulation.device());
  state_.plot_text = fmt::format("{} triangles, plot {:.4g} x {:.4g} m{}", scene.model.canopy.size(), scene.model.plot.size_x_m,
                                 scene.model.plot.size_z_m, scene.model.plot.periodic ? ", periodic" : "");
  state_.bands = session_->bands;
  state_.optics_names = session_->optics;
  if (state_.band() == 0) state_.options.band.clear();
  state_.picked.reset();
  state_.playing = false;
  if (another || !asked_picture_) choose_view(another ? ViewKind::camera : options_.run.pictures.view);
  asked_light_ = state_.light;
  asked_light_at_s_ = now_s();
  light_number_ = 1;
  told_first_ = told_done_ = 0;
  asked_picture_.reset();
  shown_frame_ = 0;
  save_told_ = true;
  placed_.reset();
  told_problems_ = {};
  for (const std::string& warning : session_->warnings) warn(warning);
  if (!session_->warnings.empty()) say_to_user(session_->warnings.front(), false);
  window_.set_title("sunfleck: " + session_->title);
  events_.tell("loaded", {{"scene", session_->file.string()},
                          {"triangles", scene.model.canopy.size()},
                          {"device", session_->simulation.device().name},
                          {"window", window_.device().name}});
}

void Viewer::load(const fs::path& file) {
  if (loading_.valid()) {  // one at a time
    to_load_ = file;
    return;
  }
  say_to_user(fmt::format("Loading {} …", file.filename().string()), false);
  loading_file_ = file;
  loading_files_ = std::make_unique<SourceFiles>();
  loading_ = std::async(std::launch::async, [options = options_, file, files = loading_files_.get()] {
    return std::make_unique<Session>(options, file, *files, &Window::wake);
  });
}

void Viewer::finish_loading() {
  if (!loading_.valid() || loading_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
  try {
    enter(loading_.get());
    watch_.clear();
    if (session_->warnings.empty()) say_to_user("Loaded.", false);
  } catch (const std::bad_alloc&) {
    say_to_user("out of memory (the scene does not fit); load a smaller one", true);
  } catch (const std::exception& error) {
    say_to_user(error.what(), true);
  }
  // Also watches the files of a scene that failed to load, since a broken or missing one may be repaired.
  if (session_->file == loading_file_) watch_.add(loading_files_->list());
  if (to_load_) load(*std::exchange(to_load_, std::nullopt));
}

void Viewer::take_dropped_files() {
  for (const fs::path& file : window_.take_dropped_files()) {
    if (file.extension() == ".toml") {
      load(file);
    } else {
      say_to_user(fmt::format("{} (not a scene file); drop a .toml file", printable(file.filename().string())), true);
    }
  }
}

void Viewer::watch_files() {
  if (now_s() < next_look_at_files_s_ || loading_.valid()) return;
  next_look_at_files_s_ = now_s() + look_at_files_s;
  if (watch_.has_changed()) load(session_->file);
}

}  // namespace sunfleck
