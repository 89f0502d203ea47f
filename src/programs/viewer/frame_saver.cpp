#include "programs/viewer/frame_saver.h"

#include "base/check.h"
#include "base/file.h"

#include <fmt/format.h>

#include <chrono>
#include <exception>
#include <utility>

namespace sunfleck {

std::filesystem::path FrameSaver::next_file(const std::filesystem::path& folder, const Picture& picture) {
  std::error_code error;
  while (true) {
    std::filesystem::path file = folder / fmt::format("view_{}_{:03d}.png", stem_of(picture), ++saved_);
    if (!std::filesystem::exists(file, error)) return file;
  }
}

void FrameSaver::save(std::shared_ptr<const LivePictureFrame> frame, const std::filesystem::path& file) {
  EXPECT(busy(), ==, false);
  saving_ = std::async(std::launch::async, [frame = std::move(frame), file] {
    try {
      make_folder(file.parent_path());
      write_frame(*frame, file);
      return SaveOutcome{true, file.string()};
    } catch (const std::exception& problem) {
      return SaveOutcome{false, problem.what()};
    }
  });
}

std::optional<SaveOutcome> FrameSaver::take_saved() {
  if (!busy() || saving_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return std::nullopt;
  return saving_.get();
}

}  // namespace sunfleck
