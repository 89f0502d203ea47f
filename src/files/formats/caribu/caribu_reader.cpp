#include "files/formats/caribu/caribu_reader.h"

#include "base/text_reader.h"
#include "files/formats/caribu/caribu_lines.h"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

namespace sunfleck {

namespace {

constexpr std::uintmax_t most_bytes = std::uintmax_t{1} << 20U;  // such files have a dozen lines
constexpr double sum_tolerance = 1e-12;                          // rounding of R + T as decimal fractions

class OptReader {
 public:
  OptReader(const std::filesystem::path& file, std::string_view bytes) : lines_(file, bytes) {}

  CaribuOptics read() {
    while (lines_.next()) {
      const std::string_view key = lines_.word();
      if (key == "n")
        read_count();
      else if (key == "s")
        read_soil();
      else if (key == "e")
        read_species();
      else
        lines_.refuse_here(fmt::format("line begins with {}", in_quotes(key)), "only n, s and e are supported", species_form);
    }
    if (!count_) lines_.refuse_file("the number of species is missing", "an .opt file needs it", count_form);
    if (!has_soil_) lines_.refuse_file("the soil is missing", "an .opt file needs its reflectance", soil_form);
    if (optics_.species.size() != *count_)
      lines_.refuse_file(fmt::format("{} species", optics_.species.size()), fmt::format("the line n says {}", *count_),
                         "correct that line, or add the missing species");
    return std::move(optics_);
  }

 private:
  static constexpr std::string_view count_form = "write: n COUNT";
  static constexpr std::string_view soil_form = "write: s d REFLECTANCE";
  static constexpr std::string_view species_form = "write: e d Rstem d Rup Tup d Rdown Tdown";

  void read_count() {
    if (count_) lines_.refuse_here("n is given twice", "a file has one number of species", "remove one of the lines");
    const std::string_view word = lines_.word();
    const std::optional<std::int64_t> count = parse_integer(word);
    if (!count || *count < 1 || *count > static_cast<std::int64_t>(most_species))
      lines_.refuse_here(fmt::format("number of species {}", in_quotes(word)),
                         fmt::format("must be a whole number in 1..{}", most_species), count_form);
    count_ = static_cast<std::size_t>(*count);
    lines_.end_of_line(count_form);
  }

  void read_soil() {
    if (has_soil_) lines_.refuse_here("s is given twice", "a file has one soil", "remove one of the lines");
    has_soil_ = true;
    optics_.soil_reflectance = read_face({"soil reflectance", ""}, soil_form).reflectance;
    lines_.end_of_line(soil_form);
  }

  void read_species() {
    if (optics_.species.size() == most_species)
      lines_.refuse_here("too many species", fmt::format("an .opt file may have at most {}", most_species), "remove this line");
    SpeciesOptics species;
    species.stem_reflectance = read_face({"Rstem", ""}, species_form).reflectance;
    species.upper = read_face({"Rup", "Tup"}, species_form);
    species.lower = read_face({"Rdown", "Tdown"}, species_form);
    optics_.species.push_back(species);
    lines_.end_of_line(species_form);
  }

  // Reads `d` with a reflectance, and with a transmittance if names[1] is not empty.
  FaceOptics read_face(const std::array<std::string_view, 2>& names, std::string_view form) {
    if (const std::string_view kind = lines_.word(); kind != "d")
      lines_.refuse_here(fmt::format("{} before {}", in_quotes(kind), names[0]), "must be d: surfaces are Lambertian", form);
    FaceOptics face;
    face.reflectance = read_share(names[0], form);
    if (names[1].empty()) return face;
    face.transmittance = read_share(names[1], form);
    const double sum = face.reflectance + face.transmittance;
    if (sum > 1.0 + sum_tolerance)
      lines_.refuse_here(fmt::format("{} + {} = {}", names[0], names[1], sum), "must be at most 1", "lower one of the two");
    return face;
  }

  double read_share(std::string_view name, std::string_view form) {
    const double value = lines_.number(name, form);
    if (!(value >= 0.0 && value <= 1.0))
      lines_.refuse_here(fmt::format("{} = {}", name, value), "must lie in 0..1", "give a share of the incident light");
    return value;
  }

  CaribuLines lines_;
  std::optional<std::size_t> count_;
  bool has_soil_ = false;
  CaribuOptics optics_;
};

}  // namespace

CaribuOptics read_opt(const std::filesystem::path& file, SourceFiles* files) {
  const std::string bytes = read_source(file, files, most_bytes);
  return OptReader(file, bytes).read();
}

CaribuDomain read_domain(const std::filesystem::path& file, SourceFiles* files) {
  constexpr std::array<std::string_view, 4> names{"xmin", "ymin", "xmax", "ymax"};
  constexpr std::string_view form = "write: xmin ymin on one line, xmax ymax on the next";
  const std::string bytes = read_source(file, files, most_bytes);
  CaribuLines lines(file, bytes);
  std::array<double, 4> values{};
  std::size_t count = 0;
  while (lines.next()) {
    while (lines.has_more()) {
      if (count == values.size()) lines.refuse_here("more than four numbers", "a domain is a rectangle", form);
      values[count] = lines.number(names[count], form);
      ++count;
    }
  }
  if (count < values.size()) lines.refuse_file(fmt::format("{} is missing", names[count]), "a domain has four numbers", form);
  const CaribuDomain domain{values[0], values[1], values[2], values[3]};
  for (const auto& [lo, hi, axis] : {std::tuple{domain.x_min, domain.x_max, 'x'}, {domain.y_min, domain.y_max, 'y'}}) {
    if (!(lo < hi))
      lines.refuse_file(fmt::format("{}min = {}, {}max = {}", axis, lo, axis, hi), "the second must be the larger", form);
  }
  return domain;
}

}  // namespace sunfleck
