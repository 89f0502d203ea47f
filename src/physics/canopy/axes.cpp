#include "physics/canopy/axes.h"

namespace sunfleck {

namespace {

constexpr std::array<std::array<const char*, 3>, 2> directions = {{{"south", "up", "west"}, {"east", "north", "up"}}};

// Returns the plot's south-west corner.
glm::dvec3 south_west_m(const Plot& plot) {
  return {plot.size_x_m, 0.0, plot.size_z_m};
}

}  // namespace

const char* axes_name(Axes axes) {
  return axes == Axes::south_up_west ? "south-up-west" : "east-north-up";
}

std::vector<std::string> axes_names() {
  return {axes_name(Axes::south_up_west), axes_name(Axes::east_north_up)};
}

const char* axes_text(Axes axes) {
  return axes == Axes::south_up_west ? "X south, Y up, Z west" : "x east, y north, z up";
}

char axis_letter(Axes axes, int axis) {
  return (axes == Axes::south_up_west ? "XYZ" : "xyz")[axis];
}

const char* axis_direction(Axes axes, int axis) {
  return directions.at(static_cast<std::size_t>(axes)).at(static_cast<std::size_t>(axis));
}

std::string axis_heading(Axes axes, int axis) {
  return axis == up_axis(axes) ? "up" : std::string("towards the ") + axis_direction(axes, axis);
}

int up_axis(Axes axes) {
  return axes == Axes::south_up_west ? 1 : 2;
}

std::array<int, 2> level_axes(Axes axes) {
  return axes == Axes::south_up_west ? std::array{0, 2} : std::array{0, 1};
}

glm::dvec3 scene_position_m(const Plot& plot, const glm::dvec3& user_m) {
  if (plot.axes == Axes::south_up_west) return user_m;
  return south_west_m(plot) + scene_direction(plot.axes, user_m);
}

glm::dvec3 user_position_m(const Plot& plot, const glm::dvec3& scene_m) {
  if (plot.axes == Axes::south_up_west) return scene_m;
  return user_direction(plot.axes, scene_m - south_west_m(plot));
}

// Differences from 0.0 instead of signs, because -0 would be written to tables.
glm::dvec3 scene_direction(Axes axes, const glm::dvec3& user) {
  if (axes == Axes::south_up_west) return user;
  return {0.0 - user.y, user.z, 0.0 - user.x};
}

glm::dvec3 user_direction(Axes axes, const glm::dvec3& scene) {
  if (axes == Axes::south_up_west) return scene;
  return {0.0 - scene.z, 0.0 - scene.x, scene.y};
}

glm::dvec3 y_up_direction(Axes axes, const glm::dvec3& scene) {
  if (axes == Axes::south_up_west) return scene;
  return {0.0 - scene.z, scene.y, scene.x};
}

glm::dvec3 scene_direction_of_y_up(Axes axes, const glm::dvec3& file) {
  if (axes == Axes::south_up_west) return file;
  return {file.z, file.y, 0.0 - file.x};
}

glm::dvec2 along_level_axes(Axes axes, const glm::dvec2& sizes) {
  return axes == Axes::south_up_west ? sizes : glm::dvec2(sizes.y, sizes.x);
}

}  // namespace sunfleck
