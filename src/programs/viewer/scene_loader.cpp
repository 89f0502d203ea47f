#include "programs/viewer/scene_loader.h"

#include "programs/viewer/window.h"

#include <chrono>
#include <utility>

namespace sunfleck {
namespace {

constexpr double look_at_files_s = 0.5;

}  // namespace

std::unique_ptr<Session> SceneLoader::load(const std::filesystem::path& file) {
  SourceFiles files;
  auto session = std::make_unique<Session>(options_, file, files, &Window::wake);
  watch_.add(files.list());
  return session;
}

bool SceneLoader::begin(const std::filesystem::path& file) {
  if (is_loading()) {
    next_ = file;
    return false;
  }
  file_ = file;
  files_ = std::make_unique<SourceFiles>();
  loading_ = std::async(std::launch::async, [options = options_, file, files = files_.get()] {
    return std::make_unique<Session>(options, file, *files, &Window::wake);
  });
  return true;
}

bool SceneLoader::is_ready() const {
  return is_loading() && loading_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

std::unique_ptr<Session> SceneLoader::take() {
  std::unique_ptr<Session> session = loading_.get();
  watch_.clear();
  return session;
}

std::optional<std::filesystem::path> SceneLoader::take_next() {
  return std::exchange(next_, std::nullopt);
}

void SceneLoader::watch_files_of(const std::filesystem::path& shown_scene) {
  if (shown_scene == file_) watch_.add(files_->list());
}

bool SceneLoader::have_files_changed(double now_s) {
  if (now_s < next_look_s_ || is_loading()) return false;
  next_look_s_ = now_s + look_at_files_s;
  return watch_.has_changed();
}

}  // namespace sunfleck
