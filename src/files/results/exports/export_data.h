#pragma once
// The input of the exporters: a finished run with the fields and colours of its triangles.

#include "files/results/tables/element_fields.h"
#include "files/results/tables/result_writer.h"
#include "physics/transport/model/model.h"
#include "physics/transport/model/result.h"

#include <array>
#include <cstdint>
#include <span>

namespace sunfleck {

// One colour in two encodings: vertex colours are linear in glTF and sRGB in PLY.
struct ElementColour {
  std::array<double, 3> linear{};  // red, green, blue, 0..1
  std::array<std::uint8_t, 3> srgb{};
};

struct ExportData {
  const RunRecord& record;
  const RadiationModel& model;
  const RadiationResult& result;
  const ElementFields& fields;
  std::span<const ElementColour> colours;  // [element], or empty
};

}  // namespace sunfleck
