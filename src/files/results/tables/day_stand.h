#pragma once
// What the tables of a day need to know of a stand, whatever its light; found once for all of them.

#include "files/results/tables/organ_kinds.h"
#include "physics/transport/model/model.h"
#include "physics/transport/model/plant_areas.h"

namespace sunfleck {

struct DayStand {
  explicit DayStand(const RadiationModel& model);

  const RadiationModel& model;  // must outlive the stand
  OrganKinds kinds;
  PlantAreas plants;
};

}  // namespace sunfleck
