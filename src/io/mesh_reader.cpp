#include "io/mesh_reader.h"

#include "base/check.h"
#include "base/error.h"
#include "base/text.h"
#include "io/file.h"
#include "io/mesh_formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <new>
#include <span>
#include <stdexcept>
#include <utility>

namespace sunfleck {

namespace {

enum class MeshFormat { can, gltf, obj, ply, stl, unknown };

constexpr std::string_view blanks = " \t\f\v";
constexpr std::size_t longest_name = 200;
constexpr std::size_t most_vertices = std::size_t{1} << 28;  // 6 GiB of positions

MeshFormat format_of(const std::filesystem::path& file) {
  const std::string name = lower_case(file.filename().string());
  constexpr std::pair<std::string_view, MeshFormat> endings[] = {
      {".can", MeshFormat::can}, {".can.gz", MeshFormat::can}, {".glb", MeshFormat::gltf}, {".gltf", MeshFormat::gltf},
      {".obj", MeshFormat::obj}, {".ply", MeshFormat::ply},    {".stl", MeshFormat::stl}};
  for (const auto& [ending, format] : endings)
    if (name.ends_with(ending)) return format;
  return MeshFormat::unknown;
}

Mesh read_format(const MeshSource& source, MeshFormat format) {
  switch (format) {
    case MeshFormat::can:
      return read_can(source);
    case MeshFormat::gltf:
      return read_gltf(source);
    case MeshFormat::obj:
      return read_obj(source);
    case MeshFormat::ply:
      return read_ply(source);
    case MeshFormat::stl:
      return read_stl(source);
    case MeshFormat::unknown:
      break;
  }
  refuse(source, 0, "unknown kind of mesh", "the name must end in .glb, .gltf, .obj, .ply, .stl, .can or .can.gz",
         "convert it, or rename it to match its format");
}

// Converts to the scene's axes and metres. Elements are stored in single precision, so coordinates must be finite in that.
void place(const std::string& where, Mesh& mesh, UpAxis up, double scale) {
  for (glm::dvec3& v : mesh.vertices) {
    if (up == UpAxis::z) v = {-v.y, v.z, -v.x};
    v *= scale;
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    if (std::isnan(v.x + v.y + v.z) || largest > std::numeric_limits<float>::max())
      throw_input(fmt::format("{}: a vertex at ({}, {}, {}) m after scaling by {}", where, v.x, v.y, v.z, scale),
                  "it must be finite in single precision, i.e. below 3.4e38", "check its numbers and scale");
  }
}

// Returns the index of the first number that is out of range.
std::optional<std::size_t> first_beyond(std::span<const std::uint32_t> numbers, std::size_t count) {
  const auto found = std::find_if(numbers.begin(), numbers.end(), [&](std::uint32_t number) { return number >= count; });
  if (found == numbers.end()) return std::nullopt;
  return static_cast<std::size_t>(found - numbers.begin());
}

void check_numbers(const std::string& where, const char* what, std::span<const std::uint32_t> numbers, std::size_t triangles,
                   std::size_t count) {
  if (numbers.size() != triangles)
    throw_input(fmt::format("{}: {} {} numbers", where, numbers.size(), what), fmt::format("there are {} triangles", triangles),
                "give one for each triangle");
  const auto beyond = first_beyond(numbers, count);
  if (!beyond) return;
  throw_input(fmt::format("{}: {} number {} of triangle {}", where, what, numbers[*beyond], *beyond),
              fmt::format("there are {}, counted from 0", count), "correct the numbers");
}

void check_corners(const std::string& where, const Mesh& mesh) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const glm::uvec3& corners = mesh.triangles[t];
    const std::uint32_t largest = std::max({corners.x, corners.y, corners.z});
    if (largest < mesh.vertices.size()) continue;
    throw_input(fmt::format("{}: vertex number {} of triangle {}", where, largest, t),
                fmt::format("there are {}, counted from 0", mesh.vertices.size()), "correct the triangles");
  }
}

}  // namespace

bool is_mesh_file(const std::filesystem::path& file) {
  return format_of(file) != MeshFormat::unknown;
}

bool is_can_file(const std::filesystem::path& file) {
  return format_of(file) == MeshFormat::can;
}

Mesh read_mesh(const std::filesystem::path& file, const MeshImport& import, SourceFiles* files) {
  EXPECT(import.scale, >, 0.0);
  const MeshFormat format = format_of(file);
  MeshSource source{file, {}, import.optics, import.allow_outside, files};
  try {
    const std::string bytes = format == MeshFormat::unknown ? std::string() : read_source(file, files);
    source.bytes = without_mark(bytes);
    if (source.bytes.empty() && format != MeshFormat::unknown)
      refuse(source, 0, "the file is empty", "a mesh needs at least one triangle", "export it again");
    Mesh mesh = read_format(source, format);
    if (mesh.triangles.empty())
      refuse(source, 0, "no triangles found", "a mesh needs at least one", "check that surfaces were exported");
    place(printable(file.string()), mesh, import.up.value_or(format == MeshFormat::can ? UpAxis::z : UpAxis::y), import.scale);
    return mesh;
  } catch (const std::bad_alloc&) {
    throw_failure(fmt::format("{}: does not fit into memory", printable(file.string())), "out of memory", "use a smaller mesh");
  } catch (const std::length_error&) {
    throw_failure(fmt::format("{}: does not fit into memory", printable(file.string())), "out of memory", "use a smaller mesh");
  }
}

Mesh import_mesh(Mesh mesh, const std::string& place_of_mesh, const MeshImport& import) {
  EXPECT(import.scale, >, 0.0);
  if (mesh.triangles.empty())
    throw_input(place_of_mesh + ": no triangle", "a mesh needs at least one", "give some, or leave the mesh out");
  check_corners(place_of_mesh, mesh);
  check_numbers(place_of_mesh, "optics", mesh.optics_of, mesh.triangles.size(), mesh.optics_names.size());
  check_numbers(place_of_mesh, "organ", mesh.organ_of, mesh.triangles.size(), mesh.organs.size());
  if (!mesh.labels.empty() && mesh.labels.size() != mesh.triangles.size())
    throw_input(fmt::format("{}: {} labels", place_of_mesh, mesh.labels.size()),
                fmt::format("there are {} triangles", mesh.triangles.size()), "give one for each triangle, or none");
  place(place_of_mesh, mesh, import.up.value_or(UpAxis::y), import.scale);
  return mesh;
}

void refuse(const MeshSource& source, std::size_t line, std::string_view what, std::string_view why, std::string_view cure) {
  const std::string place = line == 0 ? source.file.string() : fmt::format("{}:{}", source.file.string(), line);
  throw_input(printable(fmt::format("{}: {}", place, what)), printable(why), cure);
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t longest = 40;
  return fmt::format("'{}'", printable(shortened(text, longest)));
}

std::optional<Organ> organ_from_name(std::string_view name) {
  constexpr std::string_view digits = "0123456789";
  constexpr std::string_view prefix = "plant";
  if (const std::size_t dot = name.rfind('.');
      dot != name.npos && dot + 1 < name.size() && name.find_first_not_of(digits, dot + 1) == name.npos)
    name = name.substr(0, dot);
  if (!name.starts_with(prefix)) return std::nullopt;
  name.remove_prefix(prefix.size());
  const std::size_t bar = name.find('_');
  if (bar == name.npos) return std::nullopt;
  const auto plant = parse_integer(name.substr(0, bar));
  if (!plant || name.find_first_not_of(digits) != bar || *plant > std::numeric_limits<std::uint32_t>::max())
    return std::nullopt;
  name.remove_prefix(bar + 1);
  const std::size_t last = name.find_last_not_of(digits);
  if (last == name.npos) return std::nullopt;
  Organ organ{static_cast<std::uint32_t>(*plant), std::string(name.substr(0, last + 1)), 0};
  if (last + 1 < name.size()) {
    if (last > 0 && name[last] == '_') organ.name.pop_back();
    const auto rank = parse_integer(name.substr(last + 1));
    if (!rank || *rank > std::numeric_limits<int>::max()) return std::nullopt;
    organ.rank = static_cast<int>(*rank);
  }
  return organ;
}

bool LineReader::next() {
  if (rest_.empty()) return false;
  const std::size_t end = rest_.find_first_of("\r\n");
  line_ = rest_.substr(0, end);
  if (end == rest_.npos)
    rest_ = {};
  else
    rest_.remove_prefix(rest_.substr(end).starts_with("\r\n") ? end + 2 : end + 1);
  ++number_;
  return true;
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == text.npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::string_view unquoted(std::string_view cell) {
  cell = trimmed(cell);
  return cell.size() >= 2 && cell.front() == '"' && cell.back() == '"' ? trimmed(cell.substr(1, cell.size() - 2)) : cell;
}

std::string_view next_word(std::string_view& rest) {
  std::size_t first = 0;
  while (first < rest.size() && blanks.find(rest[first]) != blanks.npos) ++first;
  std::size_t last = first;
  while (last < rest.size() && blanks.find(rest[last]) == blanks.npos) ++last;
  const std::string_view word = rest.substr(first, last - first);
  rest.remove_prefix(last);
  return word;
}

std::optional<double> parse_number(std::string_view word) {
  if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
  double value = 0.0;
  const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size() || word.empty()) return std::nullopt;
  // from_chars leaves the value unchanged both on underflow and on overflow; strtod distinguishes them.
  if (code == std::errc::result_out_of_range) value = std::strtod(std::string(word).c_str(), nullptr);
  if (code == std::errc::invalid_argument || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<std::int64_t> parse_integer(std::string_view word) {
  if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
  std::int64_t value = 0;
  const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size() || word.empty() || code != std::errc()) return std::nullopt;
  return value;
}

double coordinate(const MeshSource& source, std::size_t line, std::string_view& rest) {
  const std::string_view word = next_word(rest);
  if (word.empty()) refuse(source, line, "a coordinate is missing", "the line is too short", "export the file again");
  const std::optional<double> value = parse_number(word);
  if (!value) refuse(source, line, fmt::format("coordinate {}", in_quotes(word)), "not a finite number", "correct the number");
  return *value;
}

void MeshBuilder::reserve_vertices(std::size_t count) {
  const std::size_t wanted = mesh_.vertices.size() + count;
  if (count > most_vertices || wanted > most_vertices)
    refuse(source_, 0, fmt::format("more than {} vertices", most_vertices), "the limit for one file", "split the file");
  if (wanted > mesh_.vertices.capacity()) mesh_.vertices.reserve(std::max(wanted, 2 * mesh_.vertices.capacity()));
}

std::uint32_t MeshBuilder::add_vertex(const glm::dvec3& position) {
  if (mesh_.vertices.size() == mesh_.vertices.capacity()) reserve_vertices(1);
  mesh_.vertices.push_back(position);
  return static_cast<std::uint32_t>(mesh_.vertices.size() - 1);
}

std::uint32_t MeshBuilder::optics(std::string_view name) {
  if (last_optics_ < mesh_.optics_names.size() && mesh_.optics_names[last_optics_] == name) return last_optics_;
  if (const auto known = optics_.find(name); known != optics_.end()) return last_optics_ = known->second;
  check_name("material", name);
  last_optics_ = static_cast<std::uint32_t>(mesh_.optics_names.size());
  mesh_.optics_names.emplace_back(name);
  optics_.emplace(name, last_optics_);
  return last_optics_;
}

std::uint32_t MeshBuilder::default_optics(std::size_t line) {
  if (!source_.optics)
    refuse(source_, line, "triangles without a material", "the file names no material here",
           "add optics = \"NAME\" to this file's [[geometry]] in the scene");
  return optics(*source_.optics);
}

std::uint32_t MeshBuilder::organ(const Organ& organ) {
  if (last_organ_ < mesh_.organs.size() && mesh_.organs[last_organ_] == organ) return last_organ_;
  const auto [entry, is_new] =
      organs_.try_emplace({organ.plant, organ.name, organ.rank}, static_cast<std::uint32_t>(mesh_.organs.size()));
  if (is_new) {
    check_name("organ", organ.name);
    mesh_.organs.push_back(organ);
  }
  return last_organ_ = entry->second;
}

void MeshBuilder::check_name(std::string_view kind, std::string_view name) const {
  const auto bad = [&](std::string_view why, std::string_view cure) {
    refuse(source_, 0, fmt::format("{} {}", kind, in_quotes(name)), why, cure);
  };
  if (name.size() > longest_name) bad(fmt::format("a name may have at most {} bytes", longest_name), "shorten it");
  if (!is_utf8(name)) bad("it is not UTF-8", "save the file as UTF-8");
  if (printable(name) != name) bad("a name must be one line without control characters", "rename it");
}

std::uint32_t MeshBuilder::default_organ(std::uint32_t optics) {
  return organ({1, mesh_.optics_names[optics], 0});
}

void MeshBuilder::add_polygon(std::span<const std::uint32_t> corners, std::uint32_t optics, std::uint32_t organ,
                              std::optional<std::uint64_t> label) {
  DCHECK(corners.size(), >=, 3U);
  if (mesh_.triangles.size() + corners.size() > most_vertices)
    refuse(source_, 0, fmt::format("more than {} triangles", most_vertices), "the limit for one file", "split the file");
  for (std::size_t i = 2; i < corners.size(); ++i) {
    mesh_.triangles.emplace_back(corners[0], corners[i - 1], corners[i]);
    mesh_.optics_of.push_back(optics);
    mesh_.organ_of.push_back(organ);
    if (label) mesh_.labels.push_back(*label);
  }
}

}  // namespace sunfleck
