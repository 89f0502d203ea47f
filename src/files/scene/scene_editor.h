#pragma once
// Changes the text of a scene file: what a user of a window can change, so that the scene can be saved as shown.

#include "files/scene/scene_reader.h"
#include "physics/transport/model/accuracy.h"
#include "physics/transport/model/model.h"

#include <toml++/impl/forward_declarations.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sunfleck {

// As the scene file has it: whole seconds and degrees.
struct SunTime {
  UtcTime time;
  int offset_minutes = 0;  // local time minus UTC
  double latitude_deg = 0.0, longitude_deg = 0.0;
};

// Holds the keys and values of a scene's text; comments are lost. The scene must have been read from that text.
class SceneEditor {
 public:
  explicit SceneEditor(const Scene& scene);

  // Calls `new_name` with every text but titles and names of parts, and replaces it by what it returns, if anything.
  void rename_files(const std::function<std::optional<std::string>(const std::string&)>& new_name);

  void set_title(const std::string& title);
  void set_accuracy(const Accuracy& accuracy);

  // Set the sun by time and place or by its angles, or take it away.
  void set_sun_moment(const SunTime& moment);
  void set_sun_angles_deg(double elevation, double azimuth);
  void remove_sun();

  // Gives all bands and the sky the model's light in W m-2, in place of the weather and of other units. A sky of listed directions, which
  // only a file can hold, stays as it was.
  void set_light(const RadiationModel& model);

  // Give a surface or the soil the model's reflectance and transmittance, by band, in place of spectra. `soil` exists in the model.
  void set_optics(const RadiationModel& model, std::size_t optics);
  void set_soil(const RadiationModel& model);

  // Returns the text, without a line break at its end.
  [[nodiscard]] std::string text() const;

 private:
  std::shared_ptr<toml::table> root_;
};

}  // namespace sunfleck
