#include "programs/viewer/viewer.h"

#include "base/error.h"
#include "base/log.h"
#include "files/formats/mesh/mesh_reader.h"
#include "programs/cli/terminal.h"
#include "programs/viewer/compass.h"
#include "programs/viewer/panel.h"
#include "programs/viewer/reports.h"
#include "simulate/day_blocks.h"
#include "simulate/interrupt.h"
#include "simulate/scene_source.h"

#include <imgui.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <exception>
#include <new>
#include <utility>

namespace sunfleck {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// Longest time between two frames: while something changes without input, and while nothing does.
constexpr double longest_wait_active_s = 0.03;
constexpr double longest_wait_idle_s = 0.25;
constexpr double message_s = 8.0;
constexpr std::uint32_t background = 0x00e8ecf0;

}  // namespace

Viewer::Viewer(const ViewOptions& options, Window& window)
    : options_(options), window_(window), events_(options.run.json ? EventLines::on : EventLines::off), loader_(options_) {
  state_.options = options.run.pictures;
  state_.picture = options.picture;
  state_.own_range = options.run.pictures.top_w_m2.has_value();
  state_.range_top_w_m2 = options.run.pictures.top_w_m2.value_or(state_.range_top_w_m2);
  state_.message = "Loading …";
  if (window_.begin_frame(0.0)) {
    const glm::vec2 size(window_.size_px());
    draw_message(state_, 0.0F, size.x, size.y);
    window_.end_frame({}, true, background);
  }
  state_.message.clear();
  enter(loader_.load(options.run.scene));
}

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
  state_.plot_text = session_->plot_text;
  state_.bands = session_->bands;
  state_.optics_names = session_->optics;
  if (state_.band() == 0) state_.options.band.clear();
  state_.fixed_beam = session_->light.has_fixed_beam();
  told_assumed_.reset();
  state_.picked.reset();
  state_.playing = false;
  if (another || !asked_picture_) choose_view(another ? ViewKind::camera : options_.run.pictures.view);
  asked_light_ = state_.light;
  asked_played_ = false;
  asked_light_at_s_ = now_s();
  light_number_ = 1;
  told_first_ = told_done_ = 0;
  asked_picture_.reset();
  shown_frame_ = 0;
  save_told_ = true;
  camera_fit_.forget();
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
  if (!loader_.begin(file)) return;
  say_to_user(fmt::format("Loading {} …", file.filename().string()), false);
}

void Viewer::finish_loading() {
  if (!loader_.is_ready()) return;
  try {
    enter(loader_.take());
    if (session_->warnings.empty()) say_to_user("Loaded.", false);
  } catch (const std::bad_alloc&) {
    say_to_user("out of memory (the scene does not fit); load a smaller one", true);
  } catch (const std::exception& error) {
    say_to_user(error.what(), true);
  }
  loader_.watch_files_of(session_->file);
  if (const std::optional<fs::path> next = loader_.take_next()) load(*next);
}

void Viewer::take_dropped_files() {
  for (const fs::path& file : window_.take_dropped_files()) {
    if (can_show(file)) {
      load(file);
    } else {
      say_to_user(fmt::format("{} (neither a scene nor a mesh); drop a scene, .toml, or a mesh, {}",
                              printable(file.filename().string()), readable_meshes),
                  true);
    }
  }
}

int Viewer::run() {
  while (window_.is_open() && !interrupted()) frame();
  tell_end();
  return interrupted() ? exit_interrupted : exit_done;
}

bool Viewer::at_work() const {
  const LightNews& news = state_.news;
  const bool light = news.problem.empty() && (!news.complete || news.result_request != light_number_);
  const bool picture = !state_.frame || state_.frame->fineness != Fineness::full || state_.frame->light.version != news.version;
  return light || picture || state_.playing || loader_.is_loading() || hands_.busy(now_s());
}

PictureFrame Viewer::picture_frame() const {
  const glm::ivec2 size = window_.size_px();
  const float left =
      state_.panel ? std::min(panel_width * static_cast<float>(window_.scale()), 0.6F * static_cast<float>(size.x)) : 0.0F;
  return {std::floor(left), static_cast<float>(size.x) - std::floor(left), static_cast<float>(size.y), session_->box.lo_m,
          session_->box.hi_m};
}

void Viewer::frame() {
  const bool drawn = window_.begin_frame(at_work() ? longest_wait_active_s : longest_wait_idle_s);
  const Clock::time_point start = Clock::now();
  finish_loading();
  take_dropped_files();
  if (loader_.have_files_changed(now_s())) load(session_->file);
  take_news();
  take_picture();
  if (!drawn) return;
  const PictureFrame place = picture_frame();
  if (now_s() > message_until_s_) {
    state_.message_is_problem = !state_.news.problem.empty();
    state_.message = state_.news.problem;
  }
  PanelOrders orders;
  if (state_.panel) orders = draw_panel(state_, place.left_px, place.height_px);
  if (state_.panel) {
    const CompassPlace compass = compass_place(place.left_px, place.width_px, place.height_px);
    draw_compass(compass, state_.hand.camera, state_.news.sun);
    state_.controls["compass"] = {compass.centre_px.x - compass.radius_px, compass.centre_px.y - compass.radius_px,
                                  compass.centre_px.x + compass.radius_px, compass.centre_px.y + compass.radius_px};
  }
  draw_selected(state_, place.left_px, place.height_px);
  draw_message(state_, place.left_px, place.width_px, place.height_px);
  if (const auto clicked = hands_.steer(state_, place, now_s())) pick(*clicked);
  take_keys();
  obey(orders);
  play();
  camera_fit_.place(state_, *session_, picture_frame());
  ask_for_light();
  ask_for_picture();
  tell_controls();
  WindowPicture picture;
  if (state_.frame) {
    const int left = static_cast<int>(picture_frame().left_px);
    picture = {state_.frame->pixels, state_.frame->width, state_.frame->height, {left, 0}};
  }
  window_.end_frame(picture, std::exchange(new_pixels_, false), background);
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  frame_times_s_.push_back(seconds);
  state_.frame_ms = 1e3 * seconds;
}

void Viewer::take_news() {
  const std::uint64_t version = state_.news.version;
  state_.news = session_->light.news();
  const LightNews& news = state_.news;
  if (news.version != version) session_->picture.light_changed();
  if (news.saved && !save_told_) {
    save_told_ = true;
    say_to_user(news.saved->text, !news.saved->done);
    if (news.saved->done) events_.tell("saved", {{"folder", save_folder().string()}});
  }
  if (news.request == light_number_) tell_problem(told_problems_[0], news.problem);
  tell_problem(told_problems_[1], session_->picture.problem());
  for (const std::optional<SaveOutcome>& outcome : {frame_saver_.take_saved(), session_->picture.take_saved()})
    if (outcome) tell_saved(*outcome);
  tell_assumed_light();
}

void Viewer::tell_saved(const SaveOutcome& outcome) {
  say_to_user((outcome.done ? "Saved " : "") + outcome.text, !outcome.done);
  if (outcome.done) events_.tell("saved", {{"file", outcome.text}});
}

void Viewer::tell_assumed_light() {
  const std::optional<double> assumed = state_.news.assumed_diffuse_share;
  if (std::exchange(told_assumed_, assumed) == assumed || !assumed) return;
  say_to_user(fmt::format("The scene gives its bands no `diffuse` light, so the sky gets {:.0f} % of each band's irradiance; "
                          "Own irradiance changes that.",
                          100.0 * *assumed),
              false);
  events_.tell("assumed_diffuse", {{"share", *assumed}});
}

// Reports each problem once while it lasts.
void Viewer::tell_problem(std::string& told, const std::string& problem) {
  if (problem == told) return;
  told = problem;
  if (!problem.empty()) say_to_user(problem, true);
}

void Viewer::take_picture() {
  const auto frame = session_->picture.frame();
  // The frame waits until the news it belongs to has arrived, possibly in the next iteration.
  if (!frame || frame->number == shown_frame_ || frame->light.version > state_.news.version) return;
  shown_frame_ = frame->number;
  state_.frame = frame;
  new_pixels_ = true;
  const double since_s = now_s() - asked_light_at_s_;
  if (frame->light.request == light_number_ && frame->fineness != Fineness::preview && told_first_ != light_number_) {
    told_first_ = light_number_;
    events_.tell("first_picture", {{"wish", light_number_}, {"seconds", since_s}});
  }
  if (frame->light.request == light_number_ && frame->fineness == Fineness::full && frame->light.complete) {
    if (told_done_ != light_number_) {
      told_done_ = light_number_;
      events_.tell("converged", converged_fields(state_.news, state_.band()));
    }
    events_.tell("picture",
                 {{"look", frame->look}, {"wish", frame->light.request}, {"width", frame->width}, {"height", frame->height}});
  }
  if (picked_told_ || !is_picked_shown(state_)) return;
  picked_told_ = true;
  events_.tell("picked", picked_fields(*frame));
}

void Viewer::take_keys() {
  constexpr int escape = 27;
  PanelOrders orders;
  for (const KeyPress& press : window_.take_key_presses()) {
    if (press.control) {
      if (press.key == 'Q') window_.close();
      continue;
    }
    orders.fit = orders.fit || press.key == 'F';
    orders.save_picture = orders.save_picture || press.key == 'P';
    if (press.key >= '1' && press.key <= '4') orders.view = static_cast<ViewKind>(press.key - '1');
    if (press.key == 'H') state_.panel = !state_.panel;
    if (press.key == ' ' && state_.light.sun.by_clock) state_.playing = !state_.playing;
    if (press.key == escape) state_.picked.reset();
  }
  obey(orders);
}

void Viewer::choose_view(ViewKind view) {
  state_.options.view = view;
  state_.camera_as_given = true;
  camera_fit_.forget();
}

void Viewer::obey(const PanelOrders& orders) {
  if (orders.view) choose_view(*orders.view);
  if (orders.fit) {
    const PictureFrame place = picture_frame();
    fit(state_.hand, place.lo_m, place.hi_m);
    state_.camera_as_given = false;
  }
  if (orders.copy_camera) {
    const std::string toml = camera_toml(state_.hand, session_->light.geometry().model.plot);
    if (!toml.empty()) window_.set_clipboard(toml);
    say_to_user(toml.empty() ? "A scene file cannot hold this view; use render --view." : "Camera copied.", false);
    if (!toml.empty()) events_.tell("camera_copied", {{"toml", toml}});
  }
  if (orders.reset_light) {
    state_.light = session_->light_of_scene;
    state_.playing = false;
  }
  if (orders.save_picture) save_picture();
  if (orders.save_result && !state_.news.saving) {
    state_.playing = false;  // a moment of a played day is not what `run` computes
    save_told_ = false;
    session_->light.save(save_folder());
    say_to_user(fmt::format("Saving in {} …", save_folder().string()), false);
  }
}

// The default is a folder next to what `run` writes into results/<scene>, so that nothing there is replaced.
fs::path Viewer::save_folder() const {
  return options_.run.output.empty() ? fs::path("results") / (scene_stem(session_->file) + "_view") : options_.run.output;
}

void Viewer::save_picture() {
  if (frame_saver_.busy() || !state_.frame) return;
  const fs::path file = frame_saver_.next_file(save_folder(), state_.picture);
  if (state_.own_size) {
    session_->picture.save(picture_to_save(state_, *session_), file);
  } else {
    frame_saver_.save(state_.frame, file);
  }
}

void Viewer::pick(glm::ivec2 pixel) {
  if (!state_.frame || shown_frame_ == 0) return;  // otherwise it shows the previous scene
  const LivePictureFrame& frame = *state_.frame;
  const std::optional<Pick> earlier = std::exchange(state_.picked, std::nullopt);
  picked_told_ = false;
  const std::optional<std::uint32_t> surface = frame.surface_at(pixel);
  if (!surface) return;
  const Canopy& canopy = session_->light.geometry().model.canopy;
  const std::uint32_t element = *surface / 2;
  if (element >= canopy.size()) return;
  const bool again = earlier && canopy.organ_of[earlier->element] == canopy.organ_of[element];
  state_.picked = Pick{element, again ? Pick::What::triangle : Pick::What::organ};
}

// Moves the time from sunrise to sunset, over and over.
void Viewer::play() {
  SunRequest& sun = state_.light.sun;
  if (!state_.playing || !sun.by_clock) return;
  const bool refused = state_.news.request == light_number_ && !state_.news.problem.empty();
  if ((told_first_ != light_number_ && !refused) || now_s() - asked_light_at_s_ < played_moment_s) return;
  try {
    sun.hour = next_played_hour(sun, state_.play_step_min);
  } catch (const Error& error) {
    say_to_user(error.what(), true);
    state_.playing = false;
  }
}

void Viewer::ask_for_light() {
  const bool has_paused = asked_played_ && !state_.playing;
  if (state_.light == *asked_light_ && !has_paused) return;
  std::string because = first_difference(*asked_light_, state_.light);
  if (because.empty()) because = "pause";
  asked_light_ = state_.light;
  asked_played_ = state_.playing;
  asked_light_at_s_ = now_s();
  std::vector<LightRequest> ahead;
  if (state_.playing) ahead = moments_after(state_.light, state_.play_step_min, 2 * std::size_t{usual_steps_together} - 1);
  light_number_ = session_->light.ask(state_.light, std::move(ahead));
  events_.tell("restarted", {{"wish", light_number_}, {"because", because}});
}

void Viewer::ask_for_picture() {
  PictureRequest request{state_.hand.camera, state_.options, state_.picture, state_.picked, hands_.busy(now_s())};
  if (asked_picture_ && same_look(*asked_picture_, request) && same_style(*asked_picture_, request) &&
      asked_picture_->moving == request.moving) {
    return;
  }
  asked_picture_ = request;
  static_cast<void>(session_->picture.ask(request));
}

void Viewer::say_to_user(const std::string& message, bool problem) {
  if (problem && message != state_.message) {
    warn(message);
    events_.tell("problem", {{"text", message}});
  }
  state_.message = message;
  state_.message_is_problem = problem;
  message_until_s_ = now_s() + message_s;
}

void Viewer::tell_controls() {
  if (!events_.wanted()) return;
  const PictureFrame place = picture_frame();
  const json controls = {{"picture", {place.left_px, 0, place.width_px, place.height_px}},
                         {"controls", std::exchange(state_.controls, {})}};
  const std::string text = controls.dump();
  if (text == told_controls_) return;
  told_controls_ = text;
  events_.tell("controls", controls);
}

void Viewer::tell_end() {
  if (frame_times_s_.empty()) return;
  events_.tell("closed", frame_fields(frame_times_s_));
}

}  // namespace sunfleck
