// Checks the sizes and offsets that the shaders' scalar block layout gives the shared structs.

#include "bvh/bvh.h"
#include "shared/layout.h"
#include "shared/view_layout.h"

#include <cstddef>

namespace sunfleck::shared {

static_assert(sizeof(BeamBlock) == 140);
static_assert(offsetof(BeamBlock, edge_u) == 16);
static_assert(offsetof(BeamBlock, direction) == 48);
static_assert(offsetof(BeamBlock, key) == 64);
static_assert(offsetof(BeamBlock, ground) == 88);
static_assert(offsetof(GroundMap, cells_x) == 24);
static_assert(sizeof(GroundMap) == 40);
static_assert(offsetof(BeamBlock, layer_base_y) == 128);
static_assert(sizeof(BeamPush) == 12);
static_assert(sizeof(PausedRay) == 24);
static_assert(offsetof(PacketBlock, ground) == 16);
static_assert(sizeof(PacketBlock) == 60);
static_assert(sizeof(Packet) == 32);
static_assert(sizeof(Landing) == 16);
static_assert(sizeof(PacketPush) == 12);
static_assert(sizeof(PausedPacket) == 28);
static_assert(offsetof(ViewBlock, ground) == 64);
static_assert(offsetof(ViewBlock, circle_centre) == 112);
static_assert(sizeof(ViewBlock) == 128);
static_assert(sizeof(ViewPush) == 16);
static_assert(sizeof(SeenSurface) == 12);
static_assert(sizeof(BvhNode) == 5 * 16);
static_assert(sizeof(BvhTriangle) == 3 * 16);

}  // namespace sunfleck::shared
