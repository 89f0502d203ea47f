#include "programs/viewer/live_picture.h"

#include "base/error.h"
#include "base/file.h"
#include "base/stopwatch.h"
#include "pictures/drawing/chart.h"
#include "pictures/drawing/image_writer.h"

#include <algorithm>
#include <array>
#include <exception>
#include <new>
#include <utility>

namespace sunfleck {
namespace {

// Time a preview may take; with painting added, the picture still follows the hand that turns the camera.
constexpr double preview_s = 0.035;
// No preview is drawn if one sample per pixel takes no longer than this.
constexpr double soon_s = 0.06;
constexpr int coarsest_step = 12;  // pixels

// Enlarges a small picture: repeats each sample over the pixels of the large picture that it stands for.
SurfaceImage enlarged(const SurfaceImage& small, int width, int height) {
  SurfaceImage large{width, height, 1, {}, {}, {}, 0};
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  large.surface.reserve(pixels);
  large.depth_m.reserve(pixels);
  for (int row = 0; row < height; ++row) {
    const std::size_t from = static_cast<std::size_t>(row * small.height / height) * static_cast<std::size_t>(small.width);
    for (int column = 0; column < width; ++column) {
      const std::size_t sample = from + static_cast<std::size_t>(column * small.width / width);
      large.surface.push_back(small.surface[sample]);
      large.depth_m.push_back(small.depth_m[sample]);
      if (!small.neighbour.empty()) large.neighbour.push_back(small.neighbour[sample]);
    }
  }
  return large;
}

std::vector<std::uint32_t> words_of(const Image& image) {
  std::vector<std::uint32_t> words(image.pixels.size());
  std::transform(image.pixels.begin(), image.pixels.end(), words.begin(), [](const std::array<std::uint8_t, 3>& pixel) {
    return static_cast<std::uint32_t>(pixel[0]) << 16U | static_cast<std::uint32_t>(pixel[1]) << 8U | pixel[2];
  });
  return words;
}

}  // namespace

std::optional<std::uint32_t> LivePictureFrame::surface_at(glm::ivec2 pixel) const {
  if (pixel.x < 0 || pixel.y < 0 || pixel.x >= width || pixel.y >= height) return std::nullopt;
  return surface[static_cast<std::size_t>(pixel.y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(pixel.x)];
}

void write_frame(const LivePictureFrame& frame, const std::filesystem::path& file) {
  Image image{frame.width, frame.height, {}};
  image.pixels.reserve(frame.pixels.size());
  for (const std::uint32_t word : frame.pixels) {
    image.pixels.push_back({static_cast<std::uint8_t>(word >> 16U & 0xffU), static_cast<std::uint8_t>(word >> 8U & 0xffU),
                            static_cast<std::uint8_t>(word & 0xffU)});
  }
  write_png(image, file);
}

bool same_look(const PictureRequest& a, const PictureRequest& b) {
  return a.camera == b.camera && a.options.width == b.options.width && a.options.height == b.options.height &&
         a.options.samples == b.options.samples && a.options.repeat == b.options.repeat;
}

bool same_style(const PictureRequest& a, const PictureRequest& b) {
  return a.picture == b.picture && a.options.band == b.options.band && a.options.top_w_m2 == b.options.top_w_m2 &&
         a.picked == b.picked;
}

LivePicture::LivePicture(const LiveLight& light, const Tracing& tracing, std::function<void()> notify)
    : light_(light), tracing_(tracing), notify_(std::move(notify)), worker_([this] { work(); }) {}

LivePicture::~LivePicture() {
  {
    const std::lock_guard lock(mutex_);
    quitting_ = true;
  }
  order_.notify_all();
  worker_.join();
}

std::uint64_t LivePicture::ask(const PictureRequest& request) {
  std::uint64_t look = 0;
  {
    const std::lock_guard lock(mutex_);
    if (!request_ || !same_look(*request_, request)) ++look_;
    request_ = request;
    ++request_number_;
    look = look_;
  }
  order_.notify_all();
  return look;
}

void LivePicture::save(const PictureRequest& request, const std::filesystem::path& file) {
  {
    const std::lock_guard lock(mutex_);
    to_save_ = {request, file};
  }
  order_.notify_all();
}

std::optional<SaveOutcome> LivePicture::take_saved() {
  const std::lock_guard lock(mutex_);
  return std::exchange(saved_, std::nullopt);
}

void LivePicture::light_changed() {
  {
    const std::lock_guard lock(mutex_);
    ++light_number_;
  }
  order_.notify_all();
}

std::shared_ptr<const LivePictureFrame> LivePicture::frame() const {
  const std::lock_guard lock(mutex_);
  return frame_;
}

std::string LivePicture::problem() const {
  const std::lock_guard lock(mutex_);
  return problem_;
}

bool LivePicture::wait_for_work() {
  std::unique_lock lock(mutex_);
  order_.wait(lock, [this] {
    if (quitting_) return true;
    if (to_save_) return true;
    if (!request_) return false;
    const bool asked = drawn_request_ != request_number_ || drawn_light_ != light_number_;
    if (!problem_.empty()) return asked;  // the same picture would fail again
    const bool unfinished = sight_ && sight_->fineness != Fineness::full && !request_->moving && content_;
    return asked || !sight_ || sight_->look != look_ || unfinished;
  });
  return !quitting_;
}

void LivePicture::work() {
  while (wait_for_work()) {
    std::string problem;
    bool over = false;
    try {
      save_if_asked();
      draw_once();
    } catch (const std::bad_alloc&) {
      problem = "out of memory (allocation failed); make the window smaller, or use fewer samples";
    } catch (const std::exception& error) {
      problem = error.what();
      // A device that failed once would fail again: the window continues without new pictures and reports the error.
      over = true;
    }
    {
      const std::lock_guard lock(mutex_);
      problem_ = problem;
      quitting_ = quitting_ || over;
    }
    if (!problem.empty()) notify_();
  }
}

void LivePicture::draw_once() {
  PictureRequest request;
  std::uint64_t look = 0;
  {
    const std::lock_guard lock(mutex_);
    if (!request_) return;
    request = *request_;
    look = look_;
    drawn_request_ = request_number_;
    drawn_light_ = light_number_;
  }
  const bool fresh = !sight_ || sight_->look != look;
  const bool refine = !fresh && sight_->fineness != Fineness::full && !request.moving;
  if (fresh) {
    Sight next{request, look, {}, Fineness::preview, 0.0};
    const Fineness first = preview_step(request.options) > 1 ? Fineness::preview : Fineness::one_sample;
    if (!look_at(next, first, Haste::to_the_end)) return;
    sight_ = std::move(next);
  } else if (refine) {
    Sight next{request, look, {}, sight_->fineness, 0.0};
    const bool finest = sight_->fineness == Fineness::one_sample || request.options.samples == 1;
    if (!look_at(next, finest ? Fineness::full : Fineness::one_sample, Haste::give_up_for_next)) return;
    sight_ = std::move(next);
  }
  sight_->request = request;
  refresh_content(request);
  if (content_) paint(*sight_);
}

void LivePicture::save_if_asked() {
  std::optional<PictureToSave> order;
  {
    const std::lock_guard lock(mutex_);
    order = std::exchange(to_save_, std::nullopt);
  }
  if (!order) return;
  SaveOutcome outcome{true, order->file.string()};
  try {
    const Image image = whole_picture(order->request);
    make_folder(order->file.parent_path());
    write_png(image, order->file);
  } catch (const std::bad_alloc&) {
    outcome = {false, "out of memory (allocation failed); save a smaller picture"};
  } catch (const Error& error) {
    outcome = {false, error.what()};
  }
  {
    const std::lock_guard lock(mutex_);
    saved_ = outcome;
  }
  notify_();
}

Image LivePicture::whole_picture(const PictureRequest& request) {
  std::optional<ChartContent> chart;
  static_cast<void>(light_.with_result([&](const Scene& scene, const RadiationResult& result, const LightStamp&) {
    if (!surfaces_) surfaces_ = surface_colours(scene.model, tracing_.tree.layout);
    chart =
        chart_content({scene.title, scene.model, tracing_.tree.layout, result}, request.options, request.picture, *surfaces_);
  }));
  if (!chart) throw_failure("the picture", "there is no light to show yet", "wait for the first picture");
  const std::vector<shared::SeenSurface> samples = see(request.options, request.camera, {});
  return draw_chart(surface_image(samples, {0, request.options.height}, request.options), chart->colours, request.camera,
                    light_.geometry().model.plot, tracing_.tree.layout.layers.height_m, chart->text);
}

// Returns the distance in pixels between two samples of a preview; 1 if no preview is needed.
int LivePicture::preview_step(const PictureOptions& options) const {
  const double samples = static_cast<double>(options.width) * options.height;
  if (samples / samples_per_second_ <= soon_s) return 1;
  int step = 2;
  while (step < coarsest_step && samples / (step * step) / samples_per_second_ > preview_s) ++step;
  return step;
}

std::vector<shared::SeenSurface> LivePicture::see(const PictureOptions& options, const Camera& camera,
                                                  const StopQuestion& stop) {
  CanopyLook aim = picture_look(light_.geometry().model, tracing_.tree.layout, options, camera);
  if (viewer_) {
    viewer_->aim(std::move(aim));
  } else {
    viewer_ = tracing_.engine.viewer(std::move(aim));
  }
  std::vector<shared::SeenSurface> all;
  all.reserve(static_cast<std::size_t>(options.width) * static_cast<std::size_t>(options.height) *
              static_cast<std::size_t>(options.samples));
  // Bands are short enough to be seen within a preview's time, so that the next camera motion is noticed.
  const double row_s = static_cast<double>(options.width) * options.samples / samples_per_second_;
  const auto rows = static_cast<std::uint32_t>(std::clamp(preview_s / row_s, 1.0, static_cast<double>(options.height)));
  const auto height = static_cast<std::uint32_t>(options.height);
  for (std::uint32_t row = 0; row < height; row += rows) {
    const Stopwatch watch;
    const std::uint32_t count = std::min(rows, height - row);
    const std::vector<shared::SeenSurface> seen = viewer_->see(row, count, stop);
    if (seen.empty()) return {};
    const double speed = static_cast<double>(seen.size()) / std::max(1e-6, watch.seconds());
    samples_per_second_ += 0.3 * (speed - samples_per_second_);
    all.insert(all.end(), seen.begin(), seen.end());
  }
  return all;
}

bool LivePicture::look_at(Sight& sight, Fineness fineness, Haste haste) {
  const Stopwatch watch;
  PictureOptions options = sight.request.options;
  if (fineness != Fineness::full) options.samples = 1;
  if (fineness == Fineness::preview) {
    const int step = preview_step(options);
    options.width = std::max(1, options.width / step);
    options.height = std::max(1, options.height / step);
  }
  StopQuestion stop;
  if (haste == Haste::give_up_for_next) stop = [&] { return quitting_ || request_number_ != drawn_request_; };
  const std::vector<shared::SeenSurface> samples = see(options, sight.request.camera, stop);
  if (samples.empty()) return false;
  sight.seen = surface_image(samples, {0, options.height}, options);
  if (fineness == Fineness::preview)
    sight.seen = enlarged(sight.seen, sight.request.options.width, sight.request.options.height);
  sight.fineness = fineness;
  sight.look_s = watch.seconds();
  return true;
}

// While the light restarts there is no result, and the last content stays.
void LivePicture::refresh_content(const PictureRequest& request) {
  static_cast<void>(light_.with_result([&](const Scene& scene, const RadiationResult& result, const LightStamp& stamp) {
    if (content_ && content_->light.version == stamp.version && same_style(content_->request, request)) return;
    if (!surfaces_) surfaces_ = surface_colours(scene.model, tracing_.tree.layout);
    Content next{
        stamp,
        request,
        chart_content({scene.title, scene.model, tracing_.tree.layout, result}, request.options, request.picture, *surfaces_),
        {},
        {}};
    if (request.picked && request.picked->element < scene.model.canopy.size()) {
      const std::size_t band = picture_band(scene.model, request.options.band);
      next.organ = describe_organ(scene, result, request.picked->element, band);
      if (request.picked->what == Pick::What::triangle)
        next.picked = describe_element(scene, result, request.picked->element, band);
    }
    content_ = std::move(next);
  }));
}

void LivePicture::paint(const Sight& sight) {
  const Stopwatch watch;
  const Image image = draw_chart(sight.seen, content_->chart.colours, sight.request.camera, light_.geometry().model.plot,
                                 tracing_.tree.layout.layers.height_m, content_->chart.text);
  auto next = std::make_shared<LivePictureFrame>();
  next->pixels = words_of(image);
  next->width = image.width;
  next->height = image.height;
  next->surface.resize(image.pixels.size());
  for (std::size_t pixel = 0; pixel < image.pixels.size(); ++pixel) {
    next->surface[pixel] = sight.seen.surface[pixel * static_cast<std::size_t>(sight.seen.samples)];
  }
  next->fineness = sight.fineness;
  next->light = content_->light;
  next->look = sight.look;
  next->look_s = sight.look_s;
  next->paint_s = watch.seconds();
  next->organ = content_->organ;
  next->picked = content_->picked;
  if (next->organ) {
    next->pick = content_->request.picked;
    outline_pick(*next->pick, light_.geometry().model.canopy, next->surface, next->width, next->pixels);
  }
  {
    const std::lock_guard lock(mutex_);
    next->number = frame_ ? frame_->number + 1 : 1;
    frame_ = std::move(next);
  }
  notify_();
}

}  // namespace sunfleck
