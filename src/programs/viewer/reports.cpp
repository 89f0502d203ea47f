#include "programs/viewer/reports.h"

#include "files/results/tables/summary_parts.h"

#include <algorithm>

namespace sunfleck {
namespace {

using nlohmann::json;

json face_fields(const PickedElement::Face& face) {
  return {{"irradiance", face.total_w_m2()},
          {"error", number_or_null(face.half_width_w_m2)},
          {"direct", face.direct_w_m2},
          {"sky", face.sky_w_m2},
          {"scattered", face.scattered_w_m2}};
}

}  // namespace

json converged_fields(const LightNews& news, std::size_t band) {
  const BandResult& light = news.bands.at(band);
  return {{"wish", news.result_request},
          {"seconds", news.seconds},
          {"rays", news.rays},
          {"spared_beams", news.spared_beams},
          {"direct_relative_error", number_or_null(news.direct_error.value_or(std::nan("")))},
          {"indirect_relative_error", number_or_null(news.indirect_error.value_or(std::nan("")))},
          {"band", light.name},
          {"incident", light.incident.value},
          {"absorbed_vegetation", light.absorbed_vegetation.value},
          {"absorbed_structure", light.absorbed_structure.value},
          {"absorbed_soil", light.absorbed_soil.value},
          {"reflected", light.reflected.value}};
}

json picked_fields(const LivePictureFrame& frame) {
  const PickedOrgan& organ = *frame.organ;
  json fields = {{"what", frame.picked ? "triangle" : "organ"},
                 {"plant", organ.plant},
                 {"organ", organ.organ},
                 {"rank", organ.rank},
                 {"area_m2", organ.area_m2},
                 {"triangles", organ.triangles},
                 {"sunlit", estimate_json(organ.sunlit_fraction)},
                 {"direct", estimate_json(organ.direct)},
                 {"indirect", estimate_json(organ.indirect)},
                 {"absorbed", estimate_json(organ.absorbed)}};
  if (!frame.picked) return fields;
  const PickedElement& picked = *frame.picked;
  fields["element"] = picked.element;
  fields["triangle_area_m2"] = picked.area_m2;
  fields["upper"] = face_fields(picked.upper);
  fields["lower"] = face_fields(picked.lower);
  fields["triangle_absorbed"] = picked.absorbed_w_m2;
  return fields;
}

json frame_fields(std::vector<double> seconds) {
  std::sort(seconds.begin(), seconds.end());
  return {{"frames", seconds.size()},
          {"frame_ms", 1e3 * seconds[seconds.size() / 2]},
          {"frame_ms_99", 1e3 * seconds[seconds.size() * 99 / 100]},
          {"frame_ms_worst", 1e3 * seconds.back()}};
}

}  // namespace sunfleck
