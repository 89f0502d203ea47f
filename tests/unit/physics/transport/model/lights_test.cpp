#include "physics/transport/model/lights.h"

#include "support/light_mix.h"

#include <gtest/gtest.h>

#include <vector>

namespace sunfleck {
namespace {

TEST(Lights, AreBrightByTheFluxOfTheirBeamAndSky) {
  std::vector<RadiationModel> lights(4, test::light_mix());
  const auto set = [](RadiationModel& light, double direct_w_m2, double diffuse_w_m2) {
    for (Waveband& band : light.bands) {
      band.direct_w_m2 = direct_w_m2;
      band.diffuse_w_m2 = diffuse_w_m2;
    }
  };
  set(lights[0], 300.0, 100.0);
  set(lights[1], 0.0, 4.0);
  set(lights[2], 1.0, 2.9);
  set(lights[3], 1000.0, 4.5);
  lights[3].sun.reset();  // its beam does not count
  EXPECT_EQ(bright_lights(lights, 0.01), (std::vector<bool>{true, true, false, true}));
  EXPECT_TRUE(any_beam(lights));
  EXPECT_FALSE(any_beam({&lights[3], 1}));
}

}  // namespace
}  // namespace sunfleck
