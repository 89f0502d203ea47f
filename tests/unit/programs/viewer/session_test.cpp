#include "programs/viewer/session.h"

#include <gtest/gtest.h>

namespace sunfleck {
namespace {

TEST(DroppedFile, ScenesAndMeshesCanBeShown) {
  for (const char* file : {"stand.toml", "stand.TOML", "plant.obj", "plant.PLY", "a/b.can.gz", "plant.glb", "plant.dae"})
    EXPECT_TRUE(can_show(file)) << file;
  for (const char* file : {"plant.txt", "toml", "plant.blend", "picture.png", "results"}) EXPECT_FALSE(can_show(file)) << file;
}

}  // namespace
}  // namespace sunfleck
