#include "files/formats/mesh/gltf_document.h"

#include "base/text_reader.h"
#include "files/formats/mesh/gltf_library.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>
#include <system_error>
#include <type_traits>
#include <utility>

namespace sunfleck {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

static_assert(std::endian::native == std::endian::little, "glTF numbers are read as stored in memory");

// Limits all buffers together to 2^28 positions and their indices.
constexpr std::uint64_t most_buffer_bytes = std::uint64_t{8} << 30U;

struct GlbChunks {
  std::string_view json, binary;
};

std::uint32_t word_at(std::string_view bytes, std::size_t offset) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + offset, sizeof word);
  return word;
}

// Splits a GLB file (glTF 2.0, section 4.4): magic, version, length; then chunks of length, type, bytes. JSON comes first; BIN,
// if any, second.
GlbChunks split_glb(const MeshSource& source) {
  constexpr std::size_t header = 12, chunk_header = 8;
  constexpr std::uint32_t json_chunk = 0x4E4F534A, binary_chunk = 0x004E4942;
  std::string_view rest = source.bytes;
  if (rest.size() < header + chunk_header)
    refuse(source, 0, fmt::format("only {} bytes", rest.size()), "a GLB file has at least 20", write_again);
  constexpr std::uint32_t swapped_two = 0x02000000;
  if (word_at(rest, 4) == swapped_two)
    refuse(source, 0, "its numbers are big-endian", "a GLB file is little-endian", "save it with little-endian numbers");
  if (word_at(rest, 4) != 2)
    refuse(source, 0, fmt::format("GLB version {}", word_at(rest, 4)), "only version 2 is supported", "export it as glTF 2.0");
  if (word_at(rest, 8) != rest.size())
    refuse(source, 0, fmt::format("{} bytes", rest.size()), fmt::format("its header says {}", word_at(rest, 8)), write_again);
  rest.remove_prefix(header);
  GlbChunks chunks;
  for (int number = 0; !rest.empty(); ++number) {
    const std::size_t length = rest.size() < chunk_header ? rest.size() : word_at(rest, 0);
    if (rest.size() < chunk_header || length > rest.size() - chunk_header)
      refuse(source, 0, fmt::format("GLB chunk {} of {} bytes", number, length),
             fmt::format("only {} bytes remain", rest.size()), write_again);
    const std::string_view content = rest.substr(chunk_header, length);
    const std::uint32_t type = word_at(rest, 4);
    if (number == 0 && type != json_chunk)
      refuse(source, 0, "the first GLB chunk is not JSON", "glTF 2.0 requires it first", write_again);
    if (number == 0) chunks.json = content;
    if (number == 1 && type == binary_chunk) chunks.binary = content;
    rest.remove_prefix(chunk_header + length);
  }
  return chunks;
}

// Returns the library's message without the error name in front, [json.exception.parse_error.101], and most of a long token.
std::string reason_of(const json::exception& problem) {
  constexpr std::size_t most = 200;
  std::string words = problem.what();
  const std::size_t name = words.find("] ");
  if (words.starts_with('[') && name != words.npos) words.erase(0, name + 2);
  if (words.size() > most) words = words.substr(0, most) + "...";
  return words;
}

json parse_json(const MeshSource& source, std::string_view text) {
  constexpr int deepest = 100;  // nlohmann copies and prints values recursively
  const auto expect_shallow = [&](int depth, json::parse_event_t event, json&) {
    const bool opens = event == json::parse_event_t::object_start || event == json::parse_event_t::array_start;
    if (opens && depth >= deepest)
      refuse(source, 0, fmt::format("JSON nested more than {} deep", deepest), "glTF files need far less", write_again);
    return true;
  };
  try {
    return json::parse(text, expect_shallow);
  } catch (const json::exception& problem) {
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    if (first == text.npos || text[first] != '{')
      refuse(source, 0, "not a glTF file", "it begins neither with glTF (.glb) nor with { (.gltf)", write_again);
    refuse(source, 0, "malformed JSON", reason_of(problem), write_again);
  }
}

template <class T>
bool has_type(const json& value) {
  if constexpr (std::is_same_v<T, int>)
    return value.is_number_unsigned() && value.get<std::uint64_t>() <= std::numeric_limits<int>::max();
  else if constexpr (std::is_same_v<T, std::size_t>)
    return value.is_number_unsigned();
  else if constexpr (std::is_same_v<T, double>)
    return value.is_number();
  else if constexpr (std::is_same_v<T, std::string>)
    return value.is_string();
  else
    return value.is_array() && std::all_of(value.begin(), value.end(), has_type<typename T::value_type>);
}

std::string percent_decoded(std::string_view uri) {
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    constexpr std::string_view digits = "0123456789abcdefABCDEF";
    const std::string_view code = uri[i] == '%' ? uri.substr(i + 1, 2) : std::string_view();
    if (code.size() == 2 && code.find_first_not_of(digits) == code.npos) {
      text += static_cast<char>(std::stoi(std::string(code), nullptr, 16));
      i += 2;
    } else {
      text += uri[i];
    }
  }
  return text;
}

// Returns whether a path is inside the glTF file's folder after following symbolic links.
bool lies_in_folder_of(const fs::path& gltf, const fs::path& file) {
  std::error_code code;
  const fs::path folder = fs::weakly_canonical(fs::absolute(gltf).parent_path(), code);
  if (code) return false;
  const fs::path found = fs::weakly_canonical(fs::absolute(file), code);  // a relative path without a file would stay relative
  return !code && std::mismatch(folder.begin(), folder.end(), found.begin(), found.end()).first == folder.end();
}

std::string read_buffer(const MeshSource& source, const std::string& uri) {
  if (uri.starts_with("data:")) {
    std::vector<unsigned char> bytes;
    std::string kind;
    if (!tinygltf::DecodeDataURI(&bytes, kind, uri, 0, false))
      refuse(source, 0, fmt::format("buffer {}", in_quotes(uri)), "not valid base64 data", write_again);
    return {bytes.begin(), bytes.end()};
  }
  const std::string decoded = percent_decoded(uri);
  if (decoded.find("://") != decoded.npos || decoded.find('\0') != decoded.npos)
    refuse(source, 0, fmt::format("buffer {}", in_quotes(uri)), "must name a file", "export it as .glb");
  const fs::path file = source.file.parent_path() / decoded;
  if (!source.allow_outside && !lies_in_folder_of(source.file, file))
    refuse(source, 0, fmt::format("buffer {}", in_quotes(uri)), "must lie in the glTF file's folder",
           "move it there, export it as .glb, or run with --allow-outside");
  return read_source(file, source.files, most_buffer_bytes);
}

// Reads the buffers. A buffer may be longer than its byteLength (GLB pads to 4 bytes), but not shorter.
void read_buffers(const MeshSource& source, std::string_view binary, const GltfObject& file, GltfDocument& document) {
  const std::size_t count = file.count("buffers");
  document.owned.reserve(count);  // keeps the views below valid
  std::uint64_t owned_bytes = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const json& buffer = (*file.find("buffers"))[i];
    if (!buffer.is_object() || !buffer.contains("byteLength") || !buffer["byteLength"].is_number_unsigned())
      refuse(source, 0, fmt::format("buffer {} has no byteLength", i), "it must be a whole number", write_again);
    std::string_view bytes = binary;
    if (buffer.contains("uri") && buffer["uri"].is_string()) {
      bytes = document.owned.emplace_back(read_buffer(source, buffer["uri"].get_ref<const std::string&>()));
      owned_bytes += bytes.size();
      if (owned_bytes > most_buffer_bytes)
        refuse(source, 0, fmt::format("buffers of more than {} bytes", most_buffer_bytes), "the limit for one file",
               "split the file");
    } else if (i > 0 || binary.empty()) {
      refuse(source, 0, fmt::format("buffer {} has no content", i), "it has no uri and there is no GLB chunk for it",
             write_again);
    }
    const auto length = buffer["byteLength"].get<std::uint64_t>();
    if (length > bytes.size())
      refuse(source, 0, fmt::format("buffer {} of {} bytes", i, length), fmt::format("only {} are present", bytes.size()),
             write_again);
    document.buffers.push_back(bytes.substr(0, length));
  }
}

}  // namespace

GltfObject::GltfObject(const MeshSource& source, const json& object, std::string place)
    : source_(source), object_(object), place_(std::move(place)) {
  if (!object.is_object()) refuse(source, 0, fmt::format("{} is not an object", place_), "glTF 2.0 requires one", write_again);
}

const json* GltfObject::find(const char* key) const {
  const auto value = object_.find(key);
  return value == object_.end() ? nullptr : &*value;
}

GltfObject GltfObject::inside(const char* key) const {
  static const json empty = json::object();
  const json* value = find(key);
  return {source_, value == nullptr ? empty : *value, key};
}

template <class T>
T GltfObject::get(const char* key, T if_missing) const {
  const json* value = find(key);
  if (value == nullptr) return if_missing;
  if (!has_type<T>(*value))
    refuse(source_, 0, fmt::format("malformed glTF, {}: {} = {}", place_, key, in_quotes(value->dump())),
           "glTF 2.0 requires another type of value", write_again);
  return value->get<T>();
}

template int GltfObject::get(const char*, int) const;
template std::size_t GltfObject::get(const char*, std::size_t) const;
template std::string GltfObject::get(const char*, std::string) const;
template std::vector<int> GltfObject::get(const char*, std::vector<int>) const;
template std::vector<double> GltfObject::get(const char*, std::vector<double>) const;
template std::vector<std::string> GltfObject::get(const char*, std::vector<std::string>) const;

std::size_t GltfObject::count(const char* list) const {
  const json* items = find(list);
  if (items == nullptr) return 0;
  if (!items->is_array()) refuse(source_, 0, fmt::format("{} is not an array", list), "glTF 2.0 requires one", write_again);
  return items->size();
}

GltfObject GltfObject::item(const char* list, int index, std::string_view what) const {
  const std::size_t items = count(list);
  if (index < 0 || static_cast<std::size_t>(index) >= items)
    refuse(source_, 0, fmt::format("{} {}", what, index), fmt::format("the file has {}", items), write_again);
  return {source_, (*find(list))[static_cast<std::size_t>(index)], fmt::format("{} {}", what, index)};
}

GltfDocument open_gltf(const MeshSource& source) {
  GlbChunks chunks{source.bytes, {}};
  if (source.bytes.starts_with("glTF") || source.bytes.starts_with("FTlg")) chunks = split_glb(source);
  GltfDocument document{parse_json(source, chunks.json), {}, {}};
  const GltfObject file(source, document.json, "the file");
  const auto version = file.inside("asset").get<std::string>("version");
  if (version.empty()) refuse(source, 0, "malformed glTF", "asset.version is missing", write_again);
  if (!version.starts_with("2."))
    refuse(source, 0, fmt::format("glTF version {}", in_quotes(version)), "only 2.x is supported", "export it as glTF 2.0");
  read_buffers(source, chunks.binary, file, document);
  document.json.erase("buffers");  // they may hold megabytes of text
  return document;
}

}  // namespace sunfleck
