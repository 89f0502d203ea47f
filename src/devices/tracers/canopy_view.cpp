#include "devices/tracers/canopy_view.h"

#include "base/check.h"
#include "base/threads.h"
#include "devices/gpu/compute.h"
#include "devices/tracers/fan_walk.h"
#include "devices/tracers/pixel_blocks.h"
#include "physics/bvh/decode.h"
#include "shared/view.h"
#include "view.spirv.h"
#include "view_storage.spirv.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <span>
#include <utility>

namespace sunfleck {
namespace {

// The shaders read these structs in scalar block layout.
static_assert(offsetof(shared::ViewBlock, ground) == 64);
static_assert(offsetof(shared::ViewBlock, circle_centre) == 112);
static_assert(sizeof(shared::ViewBlock) == 128);
static_assert(sizeof(shared::ViewPush) == 16);
static_assert(sizeof(shared::SeenSurface) == 12);

// Number of samples between two checks whether to stop.
constexpr std::uint32_t software_samples_per_slice = 1U << 18U;
constexpr std::uint32_t hardware_samples_per_slice = 1U << 22U;

// Returns the boxes of the canopy and of the ground in the plot itself.
std::vector<Box> seen_boxes(const Bvh& bvh, const shared::GroundMap& ground) {
  std::vector<Box> boxes;
  for (int slot = 0; slot < 8 && !bvh.nodes.empty(); ++slot) {
    if (bvh.nodes[0].meta[static_cast<std::size_t>(slot)] != 0) boxes.push_back(child_box(bvh.nodes[0], slot));
  }
  if (ground.cells_x > 0) {
    boxes.push_back({{ground.plot_lo.x, ground.y, ground.plot_lo.y}, {ground.plot_hi.x, ground.y, ground.plot_hi.y}});
  }
  return boxes;
}

// Returns the smallest and largest depth of a box's corners; for a fisheye the smallest distance and infinity.
std::pair<double, double> depths(const shared::ViewBlock& view, const Box& box) {
  constexpr double endless = std::numeric_limits<double>::infinity();
  const glm::dvec3 lo = glm::dvec3(box.lo) - glm::dvec3(view.position);
  const glm::dvec3 hi = glm::dvec3(box.hi) - glm::dvec3(view.position);
  if (view.kind == shared::view_fisheye) return {glm::length(glm::max(glm::max(lo, -hi), 0.0)), endless};
  std::pair<double, double> result(endless, -endless);
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 at((corner & 1) != 0 ? hi.x : lo.x, (corner & 2) != 0 ? hi.y : lo.y, (corner & 4) != 0 ? hi.z : lo.z);
    const double depth = glm::dot(at, glm::dvec3(view.forward));
    result = {std::min(result.first, depth), std::max(result.second, depth)};
  }
  return result;
}

// Returns plot offsets to the south and to the west: the plot itself first, then ring by ring around it.
std::vector<glm::ivec2> copies_around(int repeat) {
  EXPECT(repeat % 2, ==, 1);
  EXPECT(repeat, <=, 9);
  std::vector<glm::ivec2> copies;
  for (int ring = 0; ring <= repeat / 2; ++ring) {
    for (int z = -ring; z <= ring; ++z) {
      for (int x = -ring; x <= ring; ++x) {
        if (std::max(std::abs(x), std::abs(z)) == ring) copies.emplace_back(x, z);
      }
    }
  }
  return copies;
}

// Returns true if a copy displaced by `away` is nearer to the camera than the plot, seen from above.
bool stands_before_plot(const shared::ViewBlock& view, glm::dvec2 away) {
  if (view.kind == shared::view_fisheye) return false;
  const double farther = away.x * view.forward.x + away.y * view.forward.z;
  return farther < -0x1p-20 * glm::length(away);
}

// Returns a view per copy: the plot itself first, then the copies that are not behind the camera. The camera is displaced in
// the opposite direction instead of the copy; its rays begin shortly before the nearest depth of canopy and ground.
std::vector<shared::ViewBlock> views_of_copies(const Bvh& bvh, const CanopyLook& look) {
  const std::vector<Box> boxes = seen_boxes(bvh, look.view.ground);
  std::vector<shared::ViewBlock> views;
  for (const glm::ivec2& copy : copies_around(look.copies.repeat)) {
    shared::ViewBlock view = look.view;
    const glm::dvec2 away = glm::dvec2(copy) * look.copies.period_m;
    if (look.copies.which == SeenCopies::Which::not_before_plot && stands_before_plot(view, away)) continue;
    view.position = glm::dvec3(view.position) - glm::dvec3(away.x, 0.0, away.y);
    double nearest = std::numeric_limits<double>::infinity();
    double farthest = -nearest;
    for (const Box& box : boxes) {
      const auto [from, to] = depths(view, box);
      nearest = std::min(nearest, from);
      farthest = std::max(farthest, to);
    }
    if (!views.empty() && farthest <= 0.0) continue;
    view.start = boxes.empty() ? 0.0F : static_cast<float>(std::max(0.0, nearest * (1.0 - 0x1p-10)));
    views.push_back(view);
  }
  return views;
}

// Returns the direction in the equidistant projection: the angle to `forward` is proportional to the distance from the circle's
// centre. Zero outside the circle. Computed here for all devices, because their sine and cosine may differ.
glm::vec3 fisheye_direction(const shared::ViewBlock& view, glm::vec2 at) {
  const double across = (double{at.x} - view.circle_centre.x) * view.per_radius.x;
  const double up = (double{view.circle_centre.y} - at.y) * view.per_radius.y;
  const double share = std::sqrt(across * across + up * up);
  if (share > 1.0) return glm::vec3(0.0F);
  const double angle = 0.5 * std::numbers::pi * share;
  const double sine_per_share = share > 0.0 ? std::sin(angle) / share : 0.5 * std::numbers::pi;
  return std::cos(angle) * glm::dvec3(view.forward) +
         sine_per_share * (across * glm::dvec3(view.right) + up * glm::dvec3(view.up));
}

// The samples of a slice, counted from the first sample of a row.
struct SampleGrid {
  const shared::ViewBlock& view;
  const std::vector<glm::vec2>& offsets;
  std::uint32_t first_row = 0;
  float per_width = shared::exact_reciprocal(static_cast<float>(view.width));
  float per_height = shared::exact_reciprocal(static_cast<float>(view.height));

  [[nodiscard]] glm::vec2 at(std::uint32_t number) const {
    return shared::sample_point(view, first_row, number, offsets[number % view.samples], per_width, per_height);
  }
};

// Samples near each other, whose rays are followed together.
class NeighbouringSamples {
 public:
  NeighbouringSamples(const SampleGrid& grid, std::span<const std::uint32_t> numbers, std::span<shared::SeenSurface> seen)
      : seen_(seen) {
    for (const std::uint32_t number : numbers) {
      seen[number] = {shared::seen_nothing, 0.0F, 0};
      const glm::vec2 at = grid.at(number);
      const glm::vec3 direction = grid.view.kind == shared::view_fisheye ? fisheye_direction(grid.view, at)
                                                                         : shared::view_direction(grid.view, at.x, at.y);
      if (direction == glm::vec3(0.0F)) continue;
      fan_.along[fan_.rays] = shared::make_ray({}, direction);
      ways_[fan_.rays++] = {at, number, 0.0F, 0.0F};
    }
  }

  // Looks at a copy of the plot.
  void look_at(const Bvh& bvh, const shared::ViewBlock& view, std::uint32_t copy) {
    for (std::uint32_t k = 0; k < fan_.rays; ++k) {
      Way& way = ways_[k];
      shared::Ray& ray = fan_.along[k];
      ray.origin = shared::view_origin(view, shared::view_position(view, way.at.x, way.at.y), ray.direction);
      way.ground_t = shared::seen_ground(ray, view.ground);
      way.slack = shared::ground_slack(ray, view.ground);
      fan_.limits[k] = shared::kept_limit(view, seen_[way.sample], way.slack, shared::ground_limit(way.ground_t, way.slack));
    }
    nearest_hits(bvh, fan_, Images::originals, hits_);
    for (std::uint32_t k = 0; k < fan_.rays; ++k) {
      const shared::SeenSurface found = found_by(k, view, copy);
      shared::SeenSurface& kept = seen_[ways_[k].sample];
      if (shared::replaces(view, found, kept, ways_[k].slack)) kept = found;
    }
  }

 private:
  struct Way {
    glm::vec2 at;
    std::uint32_t sample;
    float ground_t, slack;
  };

  [[nodiscard]] shared::SeenSurface found_by(std::uint32_t k, const shared::ViewBlock& view, std::uint32_t copy) const {
    const CpuHit& hit = hits_[k];
    if (hit.found) return {2 * hit.element + hit.lower, shared::view_depth(view, hit.t), copy};
    const float ground_t = ways_[k].ground_t;
    if (!(ground_t > 0.0F)) return {shared::seen_nothing, 0.0F, copy};
    return {2 * view.elements + shared::soil_cell(view.ground, shared::ground_point(fan_.along[k], ground_t)),
            shared::view_depth(view, ground_t), copy};
  }

  std::span<shared::SeenSurface> seen_;
  RayFan fan_;
  std::array<Way, rays_per_bundle> ways_;
  BundleHits hits_;
};

// Sees the samples of these numbers, at most a bundle.
void see_samples(const Bvh& bvh, const std::vector<shared::ViewBlock>& views, const SampleGrid& grid,
                 std::span<const std::uint32_t> numbers, std::span<shared::SeenSurface> seen) {
  NeighbouringSamples samples(grid, numbers, seen);
  for (std::uint32_t copy = 0; copy < views.size(); ++copy) samples.look_at(bvh, views[copy], copy);
}

// Base class of both viewers.
class LookingViewer : public CanopyViewer {
 protected:
  LookingViewer(const Bvh& bvh, CanopyLook look) : bvh_(bvh) { take(std::move(look)); }

  void take(CanopyLook look) {
    EXPECT(look.offsets.size(), ==, std::size_t{look.view.samples});
    views_ = views_of_copies(bvh_, look);
    offsets_ = std::move(look.offsets);
  }

  [[nodiscard]] std::uint32_t sample_count(std::uint32_t first_row, std::uint32_t rows) const {
    EXPECT(std::uint64_t{first_row} + rows, <=, std::uint64_t{views_[0].height});
    const std::uint64_t samples = std::uint64_t{views_[0].width} * rows * views_[0].samples;
    EXPECT(samples, <, std::uint64_t{1} << 32U);
    return static_cast<std::uint32_t>(samples);
  }

  [[nodiscard]] const Bvh& bvh() const { return bvh_; }
  [[nodiscard]] const std::vector<glm::vec2>& offsets() const { return offsets_; }
  [[nodiscard]] const std::vector<shared::ViewBlock>& views() const { return views_; }

 private:
  const Bvh& bvh_;
  std::vector<glm::vec2> offsets_;
  std::vector<shared::ViewBlock> views_;  // one view per copy
};

class CpuViewer final : public LookingViewer {
 public:
  CpuViewer(const Bvh& bvh, CanopyLook look) : LookingViewer(bvh, std::move(look)) {}

  void aim(CanopyLook look) override { take(std::move(look)); }

  std::vector<shared::SeenSurface> see(std::uint32_t first_row, std::uint32_t rows, const StopQuestion& stop) override {
    const std::uint32_t samples = sample_count(first_row, rows);
    const SampleGrid grid{views()[0], offsets(), first_row};
    std::vector<shared::SeenSurface> seen(samples);
    const PixelBlocks blocks(views()[0], rows);
    const std::uint32_t blocks_per_slice = std::max(1U, software_samples_per_slice / blocks.samples_in_block());
    for (std::uint32_t first = 0; first < blocks.count();) {
      if (stop && stop()) return {};
      const std::uint32_t end = first + std::min(blocks_per_slice, blocks.count() - first);
      oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::uint32_t>(first, end, 32), [&](const auto& range) {
        for (std::uint32_t block = range.begin(); block < range.end(); ++block) {
          blocks.for_bundles(block,
                             [&](std::span<const std::uint32_t> numbers) { see_samples(bvh(), views(), grid, numbers, seen); });
        }
      });
      first = end;
    }
    return seen;
  }
};

ShaderCode view_shader(const GpuTree& tree) {
  std::vector<BufferUse> uses(6, BufferUse::storage);
  uses[0] = uses[1] = tree.use;
  return {"view", tree.variant(view_spirv, view_storage_spirv), std::move(uses), sizeof(shared::ViewPush), shared::group_size};
}

class GpuViewer final : public LookingViewer {
 public:
  GpuViewer(const GpuContext& context, const GpuTree& tree, const Bvh& bvh, CanopyLook look)
      : LookingViewer(bvh, std::move(look)),
        context_(context),
        tree_(tree),
        pipeline_(context, view_shader(tree), {0, 0, 0, tree.has_copies ? 1U : 0U}) {
    prepare();
  }

  void aim(CanopyLook look) override {
    take(std::move(look));
    prepare();
  }

  std::vector<shared::SeenSurface> see(std::uint32_t first_row, std::uint32_t rows, const StopQuestion& stop) override {
    const std::uint32_t samples = sample_count(first_row, rows);
    const SampleGrid grid{views()[0], offsets(), first_row};
    std::vector<shared::SeenSurface> seen(samples);
    for (std::uint32_t first = 0; first < samples;) {
      const std::uint32_t count = std::min(slice_, samples - first);
      if (is_fisheye()) upload_directions(grid, first, count);
      for (std::uint32_t copy = 0; copy < views().size(); ++copy) {
        if (stop && stop()) return {};
        run({first, count, first_row, copy});
      }
      download(context_, slice_seen_, std::as_writable_bytes(std::span(seen).subspan(first, count)));
      for (std::uint32_t number = first; number < first + count; ++number) {
        if (seen[number].surface != shared::seen_unfinished) continue;
        see_samples(bvh(), views(), grid, std::span(&number, 1), seen);
      }
      first += count;
    }
    return seen;
  }

 private:
  // Reuses the buffers of an earlier look that are large enough.
  void prepare() {
    slice_ = samples_per_slice();
    blocks_ = create_filled_buffer(context_, BufferUse::storage, std::as_bytes(std::span(views())), "the cameras");
    places_ = create_filled_buffer(context_, BufferUse::storage, std::as_bytes(std::span(offsets())), "the places of samples");
    make_room(directions_, is_fisheye() ? slice_ * sizeof(glm::vec3) : 0, "the directions of a fisheye");
    make_room(slice_seen_, slice_ * sizeof(shared::SeenSurface), "the surfaces of a picture");
  }

  void make_room(GpuBuffer& buffer, std::size_t bytes, const char* what) {
    if (buffer.handles && buffer.bytes >= bytes) return;
    buffer = create_buffer(context_, BufferUse::storage, bytes, what);
  }

  [[nodiscard]] bool is_fisheye() const { return views()[0].kind == shared::view_fisheye; }

  [[nodiscard]] std::uint32_t samples_per_slice() const {
    const std::uint64_t all = std::uint64_t{views()[0].width} * views()[0].height * views()[0].samples;
    const std::uint32_t most = context_.description().software ? software_samples_per_slice : hardware_samples_per_slice;
    return static_cast<std::uint32_t>(std::min<std::uint64_t>(all, most));
  }

  void upload_directions(const SampleGrid& grid, std::uint32_t first, std::uint32_t count) {
    host_directions_.resize(count);
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::uint32_t>(0, count, 4096), [&](const auto& range) {
      for (std::uint32_t i = range.begin(); i < range.end(); ++i) {
        host_directions_[i] = fisheye_direction(views()[0], grid.at(first + i));
      }
    });
    upload(context_, directions_, std::as_bytes(std::span(host_directions_)));
  }

  void run(const shared::ViewPush& push) {
    const GpuBuffer* const buffers[] = {&tree_.nodes, &tree_.triangles, &blocks_, &places_, &directions_, &slice_seen_};
    pipeline_.run(push.count, bytes_of(push), buffers);
  }

  const GpuContext& context_;
  const GpuTree& tree_;
  std::uint32_t slice_ = 0;
  ComputePipeline pipeline_;
  GpuBuffer blocks_, places_, directions_, slice_seen_;
  std::vector<glm::vec3> host_directions_;
};

}  // namespace

std::unique_ptr<CanopyViewer> view_with_gpu(const GpuContext& context, const GpuTree& tree, const Bvh& bvh, CanopyLook look) {
  return std::make_unique<GpuViewer>(context, tree, bvh, std::move(look));
}

std::unique_ptr<CanopyViewer> view_with_cpu(const Bvh& bvh, CanopyLook look) {
  return std::make_unique<CpuViewer>(bvh, std::move(look));
}

std::uint32_t samples_at_once(const TracerDevice& device) {
  constexpr std::uint32_t on_gpu = 1U << 20U;
  constexpr std::uint32_t in_cache = 1U << 16U;
  constexpr std::uint32_t for_a_thread = 1U << 14U;
  if (!device.software) return on_gpu;
  const auto threads = static_cast<std::uint32_t>(std::min<std::size_t>(64, threads_allowed()));
  return std::max(in_cache, threads * for_a_thread);
}

std::vector<glm::vec2> sample_offsets(int count) {
  constexpr double plastic = 1.32471795724474602596;
  std::vector<glm::vec2> offsets;
  for (int k = 0; k < count; ++k) {
    double whole = 0.0;
    offsets.emplace_back(static_cast<float>(std::modf(0.5 + k / plastic, &whole)),
                         static_cast<float>(std::modf(0.5 + k / (plastic * plastic), &whole)));
  }
  return offsets;
}

}  // namespace sunfleck
