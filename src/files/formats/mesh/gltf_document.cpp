#include "files/formats/mesh/gltf_document.h"

#include "base/error.h"
#include "base/text_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>
#include <new>
#include <system_error>

namespace sunfleck {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

static_assert(std::endian::native == std::endian::little, "glTF numbers are read as stored in memory");

constexpr std::string_view write_again = "export the file again";
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

// These sections are skipped: they concern images and animation, and may be missing or broken. Buffers are read here.
constexpr std::array<std::string_view, 6> left_out{"animations", "cameras", "images", "samplers", "skins", "textures"};

// Returns the deepest nesting of lists and objects.
std::int64_t depth_of(std::string_view text) {
  std::int64_t depth = 0, deepest = 0;
  bool in_string = false;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const char c = text[at];
    if (in_string && c == '\\') ++at;
    if (c == '"') in_string = !in_string;
    if (in_string) continue;
    if (c == '[' || c == '{') deepest = std::max(deepest, ++depth);
    if (c == ']' || c == '}') --depth;
  }
  return deepest;
}

// Returns the library's message without the error name in front, [json.exception.parse_error.101].
std::string_view reason_of(const json::exception& problem) {
  const std::string_view words = problem.what();
  const std::size_t name = words.find("] ");
  return words.starts_with('[') && name != words.npos ? words.substr(name + 2) : words;
}

// Parses the JSON, then removes the skipped sections. The library's callbacks could skip them, but rescan a whole list at the
// end of each of its objects.
json parse_json(const MeshSource& source, std::string_view text) {
  constexpr int deepest = 100;  // tinygltf follows extras recursively
  if (depth_of(text) > deepest)
    refuse(source, 0, fmt::format("JSON nested more than {} deep", deepest), "glTF files need far less", write_again);
  try {
    json document = json::parse(text);
    if (!document.is_object()) refuse(source, 0, "not a JSON object", "a glTF file must be one", write_again);
    for (const std::string_view section : left_out) document.erase(std::string(section));
    return document;
  } catch (const json::exception& problem) {
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    if (first == text.npos || text[first] != '{')
      refuse(source, 0, "not a glTF file", "it begins neither with glTF (.glb) nor with { (.gltf)", write_again);
    refuse(source, 0, "malformed JSON", reason_of(problem), write_again);
  }
}

// Refuses optional values of a wrong type, which tinygltf ignores, and indices beyond 32 bits, which it truncates.
class ValueCheck {
 public:
  ValueCheck(const MeshSource& source, const json& object, std::string_view where)
      : source_(source), object_(object), where_(where) {
    if (!object.is_object()) refuse(source, 0, fmt::format("{} is not an object", where), "glTF 2.0 requires one", write_again);
  }

  void index(const char* key) const { check(key, is_index); }
  void offset(const char* key) const {
    check(key, [](const json& value) { return value.is_number_unsigned(); });
  }
  void indices(const char* key) const { check_list(key, is_index); }
  void numbers(const char* key) const {
    check_list(key, [](const json& value) { return value.is_number(); });
  }

 private:
  using Rule = bool (*)(const json&);

  static bool is_index(const json& value) {
    return value.is_number_unsigned() && value.get<std::uint64_t>() <= std::numeric_limits<int>::max();
  }

  void check(const char* key, Rule rule) const {
    if (const auto value = object_.find(key); value != object_.end() && !rule(*value)) refuse_value(key, *value);
  }

  void check_list(const char* key, Rule rule) const {
    const auto value = object_.find(key);
    if (value == object_.end()) return;
    if (!value->is_array() || !std::all_of(value->begin(), value->end(), rule)) refuse_value(key, *value);
  }

  void refuse_value(const char* key, const json& value) const {
    refuse(source_, 0, fmt::format("malformed glTF, {}: {} = {}", where_, key, in_quotes(value.dump())),
           "glTF 2.0 requires another type of value", write_again);
  }

  const MeshSource& source_;
  const json& object_;
  std::string where_;
};

void check_values(const MeshSource& source, const json& document) {
  ValueCheck(source, document, "the file").index("scene");
  const auto each = [&](const json& parent, const char* section, const auto& check) {
    const auto items = parent.find(section);
    if (items == parent.end()) return;
    if (!items->is_array()) refuse(source, 0, fmt::format("{} is not an array", section), "glTF 2.0 requires one", write_again);
    for (std::size_t i = 0; i < items->size(); ++i)
      check(ValueCheck(source, (*items)[i], fmt::format("{} {}", section, i)), (*items)[i]);
  };
  each(document, "scenes", [](const ValueCheck& scene, const json&) { scene.indices("nodes"); });
  each(document, "nodes", [](const ValueCheck& node, const json&) {
    node.index("mesh");
    node.indices("children");
    for (const char* key : {"matrix", "rotation", "scale", "translation"}) node.numbers(key);
  });
  each(document, "meshes", [&](const ValueCheck&, const json& mesh) {
    each(mesh, "primitives", [&](const ValueCheck& primitive, const json& described) {
      for (const char* key : {"indices", "material", "mode"}) primitive.index(key);
      if (const auto attributes = described.find("attributes"); attributes != described.end())
        ValueCheck(source, *attributes, "attributes").index("POSITION");
    });
  });
  each(document, "accessors", [](const ValueCheck& accessor, const json&) {
    accessor.index("bufferView");
    accessor.offset("byteOffset");
  });
  each(document, "bufferViews", [](const ValueCheck& view, const json&) {
    view.index("buffer");
    for (const char* key : {"byteOffset", "byteStride"}) view.offset(key);
  });
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
  const fs::path folder = fs::weakly_canonical(gltf.parent_path().empty() ? fs::path(".") : gltf.parent_path(), code);
  if (code) return false;
  const fs::path found = fs::weakly_canonical(file, code);
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
void read_buffers(const MeshSource& source, std::string_view binary, GltfDocument& document) {
  const json buffers = document.json.value("buffers", json::array());
  document.json.erase("buffers");
  if (!buffers.is_array()) refuse(source, 0, "buffers is not an array", "glTF 2.0 requires one", write_again);
  document.owned.reserve(buffers.size());  // keeps the views below valid
  std::uint64_t owned_bytes = 0;
  for (std::size_t i = 0; i < buffers.size(); ++i) {
    const json& buffer = buffers[i];
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

void refuse_extensions(const MeshSource& source, const tinygltf::Model& model) {
  constexpr std::array<std::string_view, 4> unread{"EXT_mesh_gpu_instancing", "EXT_meshopt_compression",
                                                   "KHR_draco_mesh_compression", "KHR_mesh_quantization"};
  const auto refuse_if_unread = [&](const std::string& name) {
    if (std::find(unread.begin(), unread.end(), name) != unread.end())
      refuse(source, 0, fmt::format("needs the extension {}", name), "it is not supported", "export the file without it");
  };
  for (const std::string& name : model.extensionsRequired) refuse_if_unread(name);
  // Instances are geometry even if the file declares them optional.
  for (const tinygltf::Node& node : model.nodes)
    for (const auto& [name, value] : node.extensions)
      if (name == unread.front()) refuse_if_unread(name);
}

}  // namespace

GltfDocument open_gltf(const MeshSource& source) {
  GlbChunks chunks{source.bytes, {}};
  if (source.bytes.starts_with("glTF") || source.bytes.starts_with("FTlg")) chunks = split_glb(source);
  GltfDocument document;
  document.json = parse_json(source, chunks.json);
  read_buffers(source, chunks.binary, document);
  check_values(source, document.json);

  std::string errors, warnings;
  bool loaded = false;
  try {
    const std::string text = document.json.dump();
    if (text.size() > std::numeric_limits<unsigned>::max())
      refuse(source, 0, "more than 4 GiB of JSON", "glTF allows no more", "export it as .glb");
    loaded = tinygltf::TinyGLTF().LoadASCIIFromString(&document.model, &errors, &warnings, text.c_str(),
                                                      static_cast<unsigned>(text.size()), "", tinygltf::REQUIRE_VERSION);
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const json::exception& problem) {
    errors = reason_of(problem);
  } catch (const std::exception& problem) {
    errors = problem.what();
  }
  // tinygltf also reports values of a wrong type, which it then leaves out.
  if (!loaded || !errors.empty())
    refuse(source, 0, "malformed glTF", errors.empty() ? "no reason given" : errors.substr(0, errors.find('\n')), write_again);
  if (!document.model.asset.version.starts_with("2."))
    refuse(source, 0, fmt::format("glTF version {}", in_quotes(document.model.asset.version)), "only 2.x is supported",
           "export it as glTF 2.0");
  refuse_extensions(source, document.model);
  return document;
}

}  // namespace sunfleck
