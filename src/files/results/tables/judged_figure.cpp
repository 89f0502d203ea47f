#include "files/results/tables/judged_figure.h"

#include "base/file.h"

#include <fmt/format.h>

namespace sunfleck {
namespace {

std::string place_name(const JudgedFigure& figure, const RadiationModel& model) {
  switch (figure.of) {
    case JudgedFigure::Of::vegetation:
      return "vegetation";
    case JudgedFigure::Of::soil:
      return model.soil ? "soil" : "the ground";
    case JudgedFigure::Of::organ: {
      const Organ& organ = model.canopy.organs[figure.organ];
      return fmt::format("{} {} of plant {}", printable(organ.name), organ.rank, organ.plant);
    }
    case JudgedFigure::Of::triangles:
      return "triangles, root mean square";
    case JudgedFigure::Of::sensor:
      return "sensor " + printable(model.sensors[figure.sensor].name);
  }
  return "";
}

}  // namespace

std::string figure_name(const JudgedFigure& figure, const RadiationModel& model) {
  const char* meets = figure.of == JudgedFigure::Of::sensor ? " at" : " absorbed by";
  const std::string light = figure.band ? model.bands[*figure.band].name + meets : "beam on";
  return fmt::format("{} {}", light, place_name(figure, model));
}

}  // namespace sunfleck
