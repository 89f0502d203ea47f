#include "pictures/charts/picture.h"

#include <cstddef>

namespace sunfleck {

std::vector<std::string> field_names() {
  return {"direct", "sky", "indirect", "total", "absorbed", "scattered"};
}

std::vector<std::string> chart_names() {
  return {"rank", "rank-interval", "rank-log", "hue", "map"};
}

std::vector<std::string> view_names() {
  return {"camera", "top", "side", "fisheye"};
}

std::string stem_of(const Picture& picture) {
  return chart_names()[static_cast<std::size_t>(picture.chart)] + "_" + field_names()[static_cast<std::size_t>(picture.field)];
}

std::vector<Picture> all_pictures() {
  std::vector<Picture> pictures;
  for (std::size_t chart = 0; chart < chart_names().size(); ++chart) {
    for (std::size_t field = 0; field < field_names().size(); ++field) {
      pictures.push_back({static_cast<ChartKind>(chart), static_cast<LightField>(field)});
    }
  }
  return pictures;
}

std::vector<Picture> usual_pictures(bool any_direct, bool any_indirect) {
  std::vector<Picture> pictures;
  for (const ChartKind chart : {ChartKind::rank, ChartKind::hue}) {
    for (const LightField field : {LightField::direct, LightField::indirect, LightField::total}) {
      if (field == LightField::direct ? any_direct : any_indirect) pictures.push_back({chart, field});
    }
  }
  return pictures;
}

}  // namespace sunfleck
