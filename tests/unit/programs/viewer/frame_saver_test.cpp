#include "programs/viewer/frame_saver.h"

#include "support/picture.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace sunfleck {
namespace {

std::shared_ptr<const LivePictureFrame> small_frame() {
  LivePictureFrame frame;
  frame.width = 2;
  frame.height = 1;
  frame.pixels = {0x00102030, 0x00ff8000};
  frame.surface = {7, 9};
  return std::make_shared<const LivePictureFrame>(std::move(frame));
}

SaveOutcome saved_by(FrameSaver& saver) {
  while (true) {
    if (const auto outcome = saver.take_saved()) return *outcome;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

TEST(FrameSaver, WritesThePictureThatIsShown) {
  const TempFolder folder;
  FrameSaver saver;
  EXPECT_FALSE(saver.take_saved());
  const std::filesystem::path file = saver.next_file(folder / "new", Picture{});
  saver.save(small_frame(), file);
  EXPECT_TRUE(saver.busy());
  const SaveOutcome outcome = saved_by(saver);
  EXPECT_TRUE(outcome.done) << outcome.text;
  EXPECT_EQ(outcome.text, file.string());
  EXPECT_FALSE(saver.busy());
  EXPECT_FALSE(saver.take_saved()) << "an outcome is told once";
  const test::Picture picture = test::read_picture(file);
  ASSERT_EQ(picture.width, 2);
  EXPECT_EQ(picture.at(0, 0), (test::Picture::Pixel{0x10, 0x20, 0x30}));
  EXPECT_EQ(picture.at(1, 0), (test::Picture::Pixel{0xff, 0x80, 0x00}));
}

TEST(FrameSaver, ReplacesNoFile) {
  const TempFolder folder;
  const std::filesystem::path first = FrameSaver().next_file(folder.path(), Picture{});
  folder.write(first.filename().string(), "a picture of an earlier window");
  FrameSaver saver;
  const std::filesystem::path second = saver.next_file(folder.path(), Picture{});
  EXPECT_NE(second, first);
  EXPECT_NE(saver.next_file(folder.path(), Picture{}), second) << "a file may be on its way";
}

TEST(FrameSaver, TellsWhyNothingWasSaved) {
  const TempFolder folder;
  FrameSaver saver;
  saver.save(small_frame(), folder.write("file", "no folder") / "view.png");
  const SaveOutcome outcome = saved_by(saver);
  EXPECT_FALSE(outcome.done);
  EXPECT_NE(outcome.text.find("file"), std::string::npos) << outcome.text;
}

TEST(LivePictureFrame, HasSurfacesInsideThePicture) {
  const auto frame = small_frame();
  EXPECT_EQ(frame->surface_at({0, 0}).value_or(0), 7U);
  EXPECT_EQ(frame->surface_at({1, 0}).value_or(0), 9U);
  for (const glm::ivec2 outside : {glm::ivec2{-1, 0}, glm::ivec2{2, 0}, glm::ivec2{0, -1}, glm::ivec2{0, 1}})
    EXPECT_FALSE(frame->surface_at(outside));
}

}  // namespace
}  // namespace sunfleck
