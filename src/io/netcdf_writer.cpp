#include "io/export_formats.h"
#include "io/netcdf_file.h"

#include <fmt/format.h>

#include <functional>

namespace sunfleck {
namespace {

constexpr int whole_file = -1;

// Returns a flag meaning; CF 1.8, section 3.5 restricts these words to letters, digits and _ - . + @.
std::string flag_word(const std::string& name) {
  std::string word = name;
  for (char& c : word) {
    const bool allowed = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                         std::string_view("_-.+@").find(c) != std::string_view::npos;
    if (!allowed) c = '_';
  }
  return word.empty() ? "_" : word;
}

class ResultsWriter {
 public:
  explicit ResultsWriter(const ExportData& data)
      : data_(data), triangle_(file_.dimension("triangle", data.fields.size())), vertex_(file_.dimension("vertex", 3)) {}

  std::string take() {
    add_record();
    add_places();
    for (const std::vector<LightValues>& band : data_.fields.light) {
      for (const LightValues& column : band) add_light(column);
    }
    add_bands();
    add_profile();
    return file_.take();
  }

 private:
  void add_record() {
    const RunRecord& record = data_.record;
    file_.attribute(whole_file, "Conventions", "CF-1.8");
    file_.attribute(whole_file, "source", fmt::format("sunfleck {}", clean_text(record.version)));
    file_.attribute(whole_file, "history", fmt::format("sunfleck run {}", clean_text(record.scene_file)));
    for (const RecordEntry& entry : record_entries(record, data_.model)) {
      file_.attribute(whole_file, entry.key, entry.value);
    }
  }

  template <class T>
  int describe(const std::string& name, const std::vector<int>& dimensions, std::string_view units, std::string_view meaning) {
    const int number = file_.variable<T>(name, dimensions);
    file_.attribute(number, "long_name", meaning);
    file_.attribute(number, "units", units);
    return number;
  }

  template <class T>
  int add(const std::string& name, const std::vector<int>& dimensions, std::string_view units, std::string_view meaning,
          const std::vector<T>& values) {
    const int number = describe<T>(name, dimensions, units, meaning);
    file_.put(number, std::span<const T>(values));
    return number;
  }
  template <class T>
  int add(const PlaceColumn& column, const std::vector<T>& values) {
    return add(column.name, {triangle_}, column.units, column.meaning, values);
  }

  void add_flags(const PlaceColumn& column, const std::vector<std::int32_t>& values, const std::vector<std::string>& names) {
    const int number = file_.variable<std::int32_t>(column.name, {triangle_});
    file_.attribute(number, "long_name", column.meaning);
    std::vector<std::int32_t> flags;
    std::string meanings;
    for (const std::string& name : names) {
      if (!flags.empty()) meanings += ' ';
      meanings += flag_word(name);
      flags.push_back(static_cast<std::int32_t>(flags.size()));
    }
    if (!flags.empty()) {
      file_.attribute(number, "flag_values", flags);
      file_.attribute(number, "flag_meanings", meanings);
    }
    file_.put(number, std::span<const std::int32_t>(values));
    const std::string name = std::string(column.name) + "_name";
    std::vector<std::string> cleaned;
    for (const std::string& text : names) cleaned.push_back(clean_text(text));
    file_.names(name, file_.dimension(std::string(column.name) + "_kind", names.size()), cleaned,
                fmt::format("name of each value of {}", column.name));
  }

  void add_places() {
    const ElementFields& fields = data_.fields;
    std::vector<std::int64_t> numbers;
    for (std::size_t e = 0; e < fields.size(); ++e) numbers.push_back(static_cast<std::int64_t>(e));
    add(triangle_column, numbers);
    add(plant_column, std::vector<std::int64_t>(fields.plant.begin(), fields.plant.end()));
    add(rank_column, fields.rank);
    add_flags(organ_column, fields.organ, fields.organ_names);
    add_flags(optics_column, fields.optics, fields.optics_names);
    add(area_column, fields.area_m2);
    constexpr std::array axes = {"x", "y", "z"};
    constexpr std::array directions = {"towards the south", "up", "towards the west"};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      add(axes[axis], {triangle_}, "m", fmt::format("centroid, {}", directions[axis]), fields.centroid_m[axis]);
      std::vector<double> corners;
      for (std::size_t e = 0; e < fields.size(); ++e) {
        for (std::size_t k = 0; k < 3; ++k) corners.push_back(corner_m(data_.model.canopy, e, k)[static_cast<int>(axis)]);
      }
      add(fmt::format("corner_{}", axes[axis]), {triangle_, vertex_}, "m",
          fmt::format("corners, counter-clockwise seen from the upper face, {}", directions[axis]), corners);
    }
  }

  void add_light(const LightValues& column) {
    const int number = describe<double>(column.name, {triangle_}, light_units, meaning(column.column));
    file_.attribute(number, "coordinates", "x y z");
    if (column.column == LightColumn::absorbed) {
      std::string error = column.name;
      error.replace(error.size() - std::string_view("absorbed").size(), std::string::npos, ending(LightColumn::error));
      file_.attribute(number, "ancillary_variables", error);
    }
    file_.put(number, std::span<const double>(column.values));
  }

  // Adds a value for each band, W m-2 of ground, and its half-width if it has one.
  void add_balance(const char* name, std::string_view meaning, const std::function<Estimate(const BandResult&)>& term,
                   bool with_error) {
    std::vector<double> values, errors;
    for (const BandResult& band : data_.result.bands) {
      values.push_back(term(band).value);
      errors.push_back(term(band).half_width);
    }
    const int number = add(name, {band_}, light_units, fmt::format("{} per ground area", meaning), values);
    file_.attribute(number, "coordinates", "band_name");
    if (!with_error) return;
    add(fmt::format("{}_error", name), {band_}, light_units, fmt::format("half-width of the confidence interval of {}", name),
        errors);
  }

  void add_bands() {
    std::vector<std::string> names;
    for (const Waveband& band : data_.model.bands) names.push_back(clean_text(band.name));
    band_ = file_.dimension("band", names.size());
    file_.names("band_name", band_, names, "waveband");
    add_balance(
        "incident", "incident flux", [](const BandResult& b) { return Estimate{b.incident}; }, false);
    add_balance(
        "absorbed_vegetation", "flux absorbed by vegetation", [](const BandResult& b) { return b.absorbed_vegetation; }, true);
    add_balance(
        "absorbed_soil", "flux absorbed by soil", [](const BandResult& b) { return b.absorbed_soil; }, true);
    add_balance(
        "reflected", "flux that leaves upwards", [](const BandResult& b) { return b.reflected; }, true);
    add_balance(
        "transmitted", "flux that leaves downwards", [](const BandResult& b) { return b.transmitted; }, true);
    add_balance(
        "unshot", "flux not followed to its end", [](const BandResult& b) { return Estimate{b.unshot}; }, false);
    add("plot_area_m2", {}, "m2", "area of the plot", std::vector{data_.model.plot.area_m2()});
    add("leaf_area_index", {}, "1", "one-sided leaf area per ground area", std::vector{data_.result.leaf_area_index});
  }

  // Adds a value for each plane of the profile.
  void add_plane_values(const std::string& name, std::string_view units, std::string_view meaning,
                        const std::function<Estimate(const LayerResult&)>& term) {
    std::vector<double> values, errors;
    for (const LayerResult& layer : data_.result.layers) {
      values.push_back(term(layer).value);
      errors.push_back(term(layer).half_width);
    }
    add(name, {plane_}, units, meaning, values);
    add(name + "_error", {plane_}, units, fmt::format("half-width of the confidence interval of {}", name), errors);
  }

  void add_profile() {
    if (data_.result.layers.empty()) return;
    plane_ = file_.dimension("plane_height", data_.result.layers.size());
    std::vector<double> heights;
    for (const LayerResult& layer : data_.result.layers) heights.push_back(layer.height_m);
    const int number = add("plane_height", {plane_}, "m", "height of the horizontal plane", heights);
    file_.attribute(number, "positive", "up");
    file_.attribute(number, "axis", "Z");
    add_plane_values("sunfleck_ratio", "1", "share of the plane that the direct beam reaches",
                     [](const LayerResult& l) { return l.sunfleck_ratio; });
    for (std::size_t b = 0; b < data_.model.bands.size(); ++b) {
      const std::string& band = data_.model.bands[b].name;
      add_plane_values(band + "_down", light_units, "flux through the plane, downwards",
                       [b](const LayerResult& l) { return l.down[b]; });
      add_plane_values(band + "_up", light_units, "flux through the plane, upwards",
                       [b](const LayerResult& l) { return l.up[b]; });
    }
  }

  const ExportData& data_;
  NetcdfFile file_{"results.nc"};
  int triangle_, vertex_;
  int band_ = -1, plane_ = -1;
};

}  // namespace

std::string netcdf_bytes(const ExportData& data) {
  return ResultsWriter(data).take();
}

}  // namespace sunfleck
