#pragma once
// Converts between the scene's coordinates (X south, Y up, Z west, origin at the plot's north-east corner) and those of the
// user. Both are right-handed, in metres, and azimuths and headings are clockwise from north in both. In the user's own axes
// south_up_west, every conversion returns its argument unchanged.

#include "physics/canopy/plot.h"

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace sunfleck {

// Return the name as in scene files, and all names in the order of the enumeration.
[[nodiscard]] const char* axes_name(Axes axes);
[[nodiscard]] std::vector<std::string> axes_names();

// Returns the axes for the heads of files: "X south, Y up, Z west" or "x east, y north, z up".
[[nodiscard]] const char* axes_text(Axes axes);

// Returns the letter of the user's axis 0, 1 or 2 in messages: X, Y, Z or x, y, z.
[[nodiscard]] char axis_letter(Axes axes, int axis);

// Returns where the user's axis 0, 1 or 2 points: "south", "east", "up", ...
[[nodiscard]] const char* axis_direction(Axes axes, int axis);

// Returns the same in words: "towards the south", "up", ...
[[nodiscard]] std::string axis_heading(Axes axes, int axis);

// Returns the number of the user's axis that points up, 1 or 2.
[[nodiscard]] int up_axis(Axes axes);

// Returns the numbers of the user's two level axes, in their order.
[[nodiscard]] std::array<int, 2> level_axes(Axes axes);

// Convert a position from the user's coordinates and to them. East is size_z_m - Z, north is size_x_m - X.
[[nodiscard]] glm::dvec3 scene_position_m(const Plot& plot, const glm::dvec3& user_m);
[[nodiscard]] glm::dvec3 user_position_m(const Plot& plot, const glm::dvec3& scene_m);

// Convert a direction or a difference of positions.
[[nodiscard]] glm::dvec3 scene_direction(Axes axes, const glm::dvec3& user);
[[nodiscard]] glm::dvec3 user_direction(Axes axes, const glm::dvec3& scene);

// Convert a direction to the axes of files with y up, such as glTF, and from them: x south, z west for the user's axes
// south_up_west; x east, z south for east_north_up, which is how glTF and Blender turn x east, y north, z up.
[[nodiscard]] glm::dvec3 y_up_direction(Axes axes, const glm::dvec3& scene);
[[nodiscard]] glm::dvec3 scene_direction_of_y_up(Axes axes, const glm::dvec3& file);

// Returns sizes along X and Z as sizes along the user's level axes, in their order, or the other way round, since both ways
// exchange the two or leave them.
[[nodiscard]] glm::dvec2 along_level_axes(Axes axes, const glm::dvec2& sizes);

}  // namespace sunfleck
