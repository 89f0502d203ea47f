#pragma once
// Draws the picture of a window in a separate thread, coarsely while the camera moves and finely once it rests.

#include "pictures/charts/pictures.h"
#include "programs/viewer/live_light.h"
#include "programs/viewer/picked.h"
#include "simulate/simulated_scene.h"

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace sunfleck {

struct PictureRequest {
  Camera camera;
  PictureOptions options;  // size, samples, repeat, band and upper end of the scale; the view is the camera's
  Picture picture;
  std::optional<Pick> picked;
  bool moving = false;  // the camera is about to change again
};

// Return whether two requests see the same surfaces, and whether they colour them alike.
[[nodiscard]] bool same_look(const PictureRequest& a, const PictureRequest& b);
[[nodiscard]] bool same_style(const PictureRequest& a, const PictureRequest& b);

enum class Fineness { preview, one_sample, full };

struct LivePictureFrame {
  std::uint64_t number = 0;           // increases with every frame
  std::vector<std::uint32_t> pixels;  // [row][column], 0x00RRGGBB
  int width = 0, height = 0;
  std::vector<std::uint32_t> surface;  // [row][column], seen by the first sample; or SurfaceImage::nothing
  Fineness fineness = Fineness::preview;
  LightStamp light;
  std::uint64_t look = 0;  // number of the request's camera and size
  double look_s = 0.0, paint_s = 0.0;
  std::optional<Pick> pick;             // what the next two describe
  std::optional<PickedOrgan> organ;     // if anything is picked
  std::optional<PickedElement> picked;  // if a triangle is picked

  // Returns the surface at a pixel; nothing outside the picture.
  [[nodiscard]] std::optional<std::uint32_t> surface_at(glm::ivec2 pixel) const;
};

// Writes the frame's picture as a PNG. Throws Error (failure).
void write_frame(const LivePictureFrame& frame, const std::filesystem::path& file);

class LivePicture {
 public:
  // All arguments must outlive the object. `notify` is called from the drawing thread when there is a new frame.
  LivePicture(const LiveLight& light, const Tracing& tracing, std::function<void()> notify);
  ~LivePicture();
  LivePicture(const LivePicture&) = delete;
  LivePicture& operator=(const LivePicture&) = delete;

  // Requests a picture. Returns the number of its look, which stays the same if camera, size, samples and copies did not
  // change.
  std::uint64_t ask(const PictureRequest& request);
  // Tells the drawing thread that the light has changed.
  void light_changed();

  // Requests a picture of any size in a file, with all its samples; its folder is created. Its outcome follows by take_saved.
  void save(const PictureRequest& request, const std::filesystem::path& file);
  // Returns the outcome of the last request to save, once.
  [[nodiscard]] std::optional<SaveOutcome> take_saved();

  // Returns the latest frame; null before the first one.
  [[nodiscard]] std::shared_ptr<const LivePictureFrame> frame() const;
  [[nodiscard]] std::string problem() const;

 private:
  // A view of the scene and how finely it has been drawn so far.
  struct Sight {
    PictureRequest request;
    std::uint64_t look = 0;
    SurfaceImage seen;
    Fineness fineness = Fineness::preview;
    double look_s = 0.0;
  };
  // Colours and text for one result and one request.
  struct Content {
    LightStamp light;
    PictureRequest request;
    ChartContent chart;
    std::optional<PickedOrgan> organ;
    std::optional<PickedElement> picked;
  };
  struct PictureToSave {
    PictureRequest request;
    std::filesystem::path file;
  };

  void work();
  [[nodiscard]] bool wait_for_work();
  void draw_once();
  void save_if_asked();
  [[nodiscard]] Image whole_picture(const PictureRequest& request);
  enum class Haste { to_the_end, give_up_for_next };
  [[nodiscard]] bool look_at(Sight& sight, Fineness fineness, Haste haste);
  [[nodiscard]] std::vector<shared::SeenSurface> see(const PictureOptions& options, const Camera& camera,
                                                     const StopQuestion& stop);
  [[nodiscard]] int preview_step(const PictureOptions& options) const;
  void refresh_content(const PictureRequest& request);
  void paint(const Sight& sight);

  const LiveLight& light_;
  const Tracing& tracing_;
  std::function<void()> notify_;

  std::atomic<bool> quitting_ = false;
  std::atomic<std::uint64_t> look_ = 0;
  std::atomic<std::uint64_t> request_number_ = 0;  // of the last request

  mutable std::mutex mutex_;  // guards the members up to problem_
  std::condition_variable order_;
  std::optional<PictureRequest> request_;
  std::optional<PictureToSave> to_save_;
  std::optional<SaveOutcome> saved_;
  std::uint64_t light_number_ = 0;
  std::shared_ptr<const LivePictureFrame> frame_;
  std::string problem_;

  // Used by the drawing thread only.
  std::unique_ptr<CanopyViewer> viewer_;
  std::optional<Sight> sight_;
  std::optional<Content> content_;
  std::optional<SurfaceColours> surfaces_;
  std::uint64_t drawn_request_ = 0, drawn_light_ = 0;  // numbers
  double samples_per_second_ = 1e6;

  std::thread worker_;
};

}  // namespace sunfleck
