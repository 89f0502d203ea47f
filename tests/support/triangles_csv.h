#pragma once

#include "files/results/tables/element_fields.h"
#include "files/results/tables/table_text.h"

#include <string>

namespace sunfleck {

// Returns the text of triangles.csv.
inline std::string triangles_csv(const RunRecord& record, const RadiationModel& model, const RadiationResult& result) {
  const ElementFields fields = make_element_fields(model, result);
  return csv_text(record, triangles_table(fields));
}

}  // namespace sunfleck
