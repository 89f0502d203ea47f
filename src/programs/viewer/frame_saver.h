#pragma once
// Saves the picture that a window shows, in a thread of its own.

#include "programs/viewer/live_picture.h"

#include <filesystem>
#include <future>
#include <memory>
#include <optional>

namespace sunfleck {

class FrameSaver {
 public:
  // Returns a file in the folder that does not exist yet: view_PICTURE_NUMBER.png.
  [[nodiscard]] std::filesystem::path next_file(const std::filesystem::path& folder, const Picture& picture);

  // Returns whether a frame is being saved, or its outcome has not been taken yet.
  [[nodiscard]] bool busy() const { return saving_.valid(); }

  // Begins to save a frame as a PNG, and makes its folder. There must be no other at work.
  void save(std::shared_ptr<const LivePictureFrame> frame, const std::filesystem::path& file);

  // Returns the outcome once the frame is saved, and then nothing until the next one.
  [[nodiscard]] std::optional<SaveOutcome> take_saved();

 private:
  int saved_ = 0;
  std::future<SaveOutcome> saving_;
};

}  // namespace sunfleck
