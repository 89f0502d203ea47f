#include "files/formats/mesh/mesh_content.h"

#include "base/text_reader.h"

#include <array>
#include <fstream>

namespace sunfleck {

namespace {

bool is_text_stl(std::string_view bytes) {
  return bytes.starts_with("solid") && bytes.find("facet") != std::string_view::npos;
}

// Returns whether the first line that is no comment is one of an .obj.
bool is_obj(std::string_view bytes) {
  LineReader lines(bytes);
  while (lines.next()) {
    std::string_view rest = lines.line();
    const std::string_view key = next_word(rest);
    if (key.empty() || key.starts_with('#')) continue;
    if (key == "mtllib" || key == "o" || key == "g") return rest.find('=') == std::string_view::npos;
    return key == "v" && parse_number(next_word(rest)).has_value();
  }
  return false;
}

// Returns whether the first line that is no comment is one of a .can: `p 1 LABEL 3` and coordinates.
bool is_can(std::string_view bytes) {
  LineReader lines(bytes);
  while (lines.next()) {
    std::string_view rest = lines.line();
    const std::string_view key = next_word(rest);
    if (key.empty() || key.starts_with('#')) continue;
    return key == "p" && next_word(rest) == "1";
  }
  return false;
}

}  // namespace

std::optional<std::string> mesh_ending_of(std::string_view bytes) {
  if (bytes.starts_with("ply\n") || bytes.starts_with("ply\r\n")) return ".ply";
  if (bytes.starts_with("glTF")) return ".glb";
  if (trimmed(bytes).starts_with('<')) {
    if (bytes.find("<COLLADA") != std::string_view::npos) return ".dae";
    if (bytes.find("<opf") != std::string_view::npos) return ".opf";
    return std::nullopt;
  }
  if (is_text_stl(bytes)) return ".stl";
  if (is_obj(bytes)) return ".obj";
  if (is_can(bytes)) return ".can";
  return std::nullopt;
}

std::optional<std::string> mesh_ending_of_file(const std::filesystem::path& file) {
  constexpr std::size_t enough = 4096;
  std::array<char, enough> begin{};
  std::ifstream stream(file, std::ios::binary);
  stream.read(begin.data(), enough);
  return mesh_ending_of({begin.data(), static_cast<std::size_t>(stream.gcount())});
}

}  // namespace sunfleck
