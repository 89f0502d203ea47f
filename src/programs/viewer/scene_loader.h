#pragma once
// Loads the scenes of a window in a thread of its own, and watches the files of the scene that is shown.

#include "base/source_files.h"
#include "programs/cli/options.h"
#include "programs/viewer/file_watch.h"
#include "programs/viewer/session.h"

#include <filesystem>
#include <future>
#include <memory>
#include <optional>

namespace sunfleck {

class SceneLoader {
 public:
  // The options must outlive the object.
  explicit SceneLoader(const ViewOptions& options) : options_(options) {}

  // Loads a scene in this thread and watches its files. Throws as Session does.
  [[nodiscard]] std::unique_ptr<Session> load(const std::filesystem::path& file);

  // Begins to load a scene in another thread, which wakes the window when it is done. Scenes are loaded one at a time: while
  // another one is being loaded, only keeps the file for take_next and returns false.
  [[nodiscard]] bool begin(const std::filesystem::path& file);
  // Returns true from begin until take.
  [[nodiscard]] bool is_loading() const { return loading_.valid(); }
  // Returns true if a scene is being loaded and the thread is done.
  [[nodiscard]] bool is_ready() const;
  // Returns the loaded scene and stops watching the files of the earlier one. Throws what loading threw.
  [[nodiscard]] std::unique_ptr<Session> take();
  // Returns the file that was last requested while another scene was being loaded, once.
  [[nodiscard]] std::optional<std::filesystem::path> take_next();

  // Also watches the files that were last loaded if they are those of the scene that is shown, even if loading failed, since a
  // broken or missing file may be repaired.
  void watch_files_of(const std::filesystem::path& shown_scene);
  // Returns true if a watched file has changed, as FileWatch::has_changed. Looks at most twice a second, and not while a scene
  // is being loaded.
  [[nodiscard]] bool have_files_changed(double now_s);

 private:
  const ViewOptions& options_;
  std::filesystem::path file_;          // of the scene that is being loaded, or was loaded last
  std::unique_ptr<SourceFiles> files_;  // of that scene; the loading thread uses them until it is done
  std::future<std::unique_ptr<Session>> loading_;
  std::optional<std::filesystem::path> next_;
  FileWatch watch_;
  double next_look_s_ = 0.0;
};

}  // namespace sunfleck
