#include "files/results/tables/day_stand.h"

namespace sunfleck {

DayStand::DayStand(const RadiationModel& of)
    : model(of), kinds(of), plants(of, Surfaces(of), BeamExposure(of, make_counter_layout(of), 1.0)) {}

}  // namespace sunfleck
