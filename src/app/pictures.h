#pragma once
// From a result to its charts.

#include "app/engine.h"
#include "app/options.h"
#include "io/scene_reader.h"
#include "transport/counters.h"
#include "transport/result.h"
#include "view/camera.h"
#include "view/chart.h"
#include "view/colour_scale.h"
#include "view/image.h"

#include <cstddef>
#include <string>
#include <vector>

namespace sunfleck {

// The number of the band of that name, of the first for an empty one. Throws Error (input) if the scene has none such.
[[nodiscard]] std::size_t picture_band(const RadiationModel& model, const std::string& name);

// Which light a picture shows: the beam's first landings, all other light, or both.
enum class LightField { direct, indirect, total };

// The colour rank charts of irradiance in one band, of one view that is looked at once.
class RankCharts {
 public:
  // All must outlive it.
  RankCharts(const Scene& scene, const CounterLayout& layout, const RadiationResult& result, const RunOptions& options);

  // Looks at the scene; false if stopped.
  [[nodiscard]] bool look(const Engine& engine, const StopQuestion& stop);

  // After a look.
  [[nodiscard]] Image draw(LightField field) const;

 private:
  struct SurfaceValues {
    std::vector<double> irradiance_w_m2;  // [surface number]: both faces of the elements, then the soil's cells
    std::vector<double> area_m2;
  };
  [[nodiscard]] SurfaceValues surface_values(LightField field) const;
  [[nodiscard]] ChartText chart_text(LightField field, const RankScale& scale) const;

  const Scene& scene_;
  const CounterLayout& layout_;
  const RadiationResult& result_;
  std::size_t band_;
  Camera camera_;
  SurfaceImage seen_;
};

}  // namespace sunfleck
