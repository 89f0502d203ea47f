#include "programs/viewer/live_picture.h"

#include "base/error.h"
#include "support/box_views.h"
#include "support/live_scene.h"

#include <gtest/gtest.h>

namespace sunfleck {
namespace {

// Provides finished light and a picture of it.
class LivePictures : public testing::Test {
 protected:
  LivePictures() : live_(test::write_live_scene(folder_)), light_(live_.simulation, live_.options, [] {}) {
    request_.options.width = 160;
    request_.options.height = 120;
    request_.options.samples = 4;
    request_.camera = picture_camera(live_.scene, live_.simulation.layout(), request_.options);
    EXPECT_TRUE(test::wait_for([&] { return light_.news().complete; }));
    picture_.emplace(light_, live_.simulation.tracing(), [] {});
  }

  std::shared_ptr<const LivePictureFrame> finished(std::uint64_t look) {
    EXPECT_TRUE(test::wait_for([&] {
      const auto frame = picture_->frame();
      return frame && frame->look == look && frame->fineness == Fineness::full;
    }));
    return picture_->frame();
  }

  TempFolder folder_;
  test::LiveScene live_;
  LiveLight light_;
  PictureRequest request_;
  std::optional<LivePicture> picture_;
};

TEST_F(LivePictures, EndAsRenderDrawsThem) {
  for (const Picture picture : {Picture{ChartKind::rank, LightField::total}, Picture{ChartKind::hue, LightField::scattered},
                                Picture{ChartKind::map, LightField::sky}}) {
    request_.picture = picture;
    const std::uint64_t look = picture_->ask(request_);
    Image expected;
    ASSERT_TRUE(light_.with_result([&](const Scene& scene, const RadiationResult& result, const LightStamp&) {
      const Drawing drawing{scene, live_.simulation.layout(), result, live_.simulation.tracing().engine};
      EXPECT_TRUE(draw_charts(drawing, request_.options, std::span(&picture, 1), {},
                              [&](std::size_t, const Image& image) { expected = image; }));
    }));
    const auto same = [&] {
      const auto frame = picture_->frame();
      if (!frame || frame->look != look || frame->pixels.size() != expected.pixels.size()) return false;
      for (std::size_t i = 0; i < expected.pixels.size(); ++i) {
        const auto& pixel = expected.pixels[i];
        if (frame->pixels[i] != (std::uint32_t{pixel[0]} << 16U | std::uint32_t{pixel[1]} << 8U | pixel[2])) return false;
      }
      return frame->fineness == Fineness::full;
    };
    EXPECT_TRUE(test::wait_for(same)) << stem_of(picture);
  }
}

TEST_F(LivePictures, AMovedCameraIsAnotherLookAndOtherColoursAreNot) {
  const std::uint64_t first = picture_->ask(request_);
  (void)finished(first);
  request_.picture.chart = ChartKind::map;
  EXPECT_EQ(picture_->ask(request_), first);
  request_.camera.position_m.x += 0.1;
  const std::uint64_t second = picture_->ask(request_);
  EXPECT_NE(second, first);
  EXPECT_EQ(finished(second)->look, second);
  EXPECT_EQ(light_.news().request, 1U) << "a moved camera simulates nothing";
}

TEST_F(LivePictures, TellWhatEachPixelSeesAndWhatIsPicked) {
  request_.camera = top_view({0, 0, 0}, {1, 1, 1}, 160.0 / 120.0);
  const auto frame = finished(picture_->ask(request_));
  const auto at = project(request_.camera, {0.45, 0.45, 0.45});
  ASSERT_TRUE(at);
  const auto pixel = static_cast<std::size_t>(at->at.y * 120) * 160 + static_cast<std::size_t>(at->at.x * 160);
  const std::uint32_t element = frame->surface[pixel] / 2;
  ASSERT_LT(element, 3U);
  request_.picked = Pick{element, Pick::What::triangle};
  static_cast<void>(picture_->ask(request_));
  ASSERT_TRUE(test::wait_for([&] { return picture_->frame()->picked.has_value(); }));
  const PickedElement picked = *picture_->frame()->picked;
  const PickedOrgan organ = *picture_->frame()->organ;
  EXPECT_EQ(organ.organ, "leaf");
  EXPECT_EQ(organ.plant, 1);
  EXPECT_EQ(organ.rank, 1);
  EXPECT_EQ(organ.triangles, 2U);
  EXPECT_NEAR(picked.area_m2, area_m2(live_.scene.model.canopy.corners[element]), 1e-12);
  EXPECT_GT(picked.upper.direct_w_m2 + picked.lower.direct_w_m2, 0.0);
  EXPECT_GT(picked.upper.half_width_w_m2, 0.0);
  const double absorbed = (picked.upper.total_w_m2() + picked.lower.total_w_m2()) * (1.0 - 0.12 - 0.06);
  EXPECT_NEAR(picked.absorbed_w_m2, absorbed, 1e-9 * absorbed);
}

TEST_F(LivePictures, AreSavedAsShown) {
  const auto frame = finished(picture_->ask(request_));
  write_frame(*frame, folder_ / "shown.png");
  EXPECT_GT(std::filesystem::file_size(folder_ / "shown.png"), 1000U);
  EXPECT_THROW(write_frame(*frame, folder_ / "no" / "folder.png"), Error);
}

}  // namespace
}  // namespace sunfleck
