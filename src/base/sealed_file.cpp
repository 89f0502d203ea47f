#include "base/sealed_file.h"

#include "base/check.h"
#include "base/error.h"
#include "base/file.h"
#include "base/packed_array.h"

#include <fmt/format.h>
#include <zlib.h>

#include <cstdint>
#include <cstring>
#include <ostream>
#include <stdexcept>
#include <streambuf>

namespace sunfleck {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr std::size_t deepest = 2;  // nesting depth of lists and maps
constexpr std::size_t mark_bytes = 8;
constexpr std::size_t head_bytes = mark_bytes + sizeof(std::uint32_t);

// Takes the checksum of what a stream writes, and keeps nothing of it.
class CheckSum : public std::streambuf {
 public:
  [[nodiscard]] std::uint32_t value() const { return static_cast<std::uint32_t>(sum_); }

 protected:
  int_type overflow(int_type byte) override {
    const char letter = traits_type::to_char_type(byte);
    xsputn(&letter, 1);
    return traits_type::not_eof(byte);
  }

  std::streamsize xsputn(const char* bytes, std::streamsize count) override {
    if (count == 0) return 0;  // an empty array may lie nowhere, for which crc32_z returns its initial value
    sum_ = crc32_z(sum_, reinterpret_cast<const Bytef*>(bytes), static_cast<std::size_t>(count));
    return count;
  }

 private:
  unsigned long sum_ = 0;
};

std::string value_text(const ordered_json& settings, const std::string& key) {
  return settings.contains(key) ? printable(settings[key].dump()) : "not given";
}

// Returns what users call a setting.
std::string setting_name(const std::string& key) {
  if (key == "of_triangles" || key == "triangles") return "the light of triangles for --export and --images";
  return printable(key);
}

}  // namespace

void seal(std::ostream& out, std::string_view mark, const json& content) {
  EXPECT(mark.size(), ==, mark_bytes);
  CheckSum check_sum;
  std::ostream counted(&check_sum);
  json::to_cbor(content, counted);
  const std::uint32_t sum = check_sum.value();
  out.write(mark.data(), mark_bytes);
  out.write(reinterpret_cast<const char*>(&sum), sizeof sum);
  json::to_cbor(content, out);
}

std::optional<json> unsealed(std::string_view mark, std::string_view bytes) {
  if (bytes.size() < head_bytes || bytes.substr(0, mark_bytes) != mark) return std::nullopt;
  const std::string_view content = bytes.substr(head_bytes);
  std::uint32_t sum = 0;
  std::memcpy(&sum, bytes.data() + mark_bytes, sizeof sum);
  CheckSum check_sum;
  check_sum.sputn(content.data(), static_cast<std::streamsize>(content.size()));
  if (sum != check_sum.value()) return std::nullopt;
  try {
    return read_cbor(content, deepest);
  } catch (const json::exception&) {
    return std::nullopt;
  } catch (const std::runtime_error&) {
    return std::nullopt;
  }
}

ordered_json parse_settings(const std::string& text) {
  bool plain = true;
  const auto keep = [&](int depth, ordered_json::parse_event_t, ordered_json&) {
    plain = plain && depth < 2;
    return plain;
  };
  ordered_json settings = ordered_json::parse(text, keep, false);
  return plain && settings.is_object() ? std::move(settings) : ordered_json();
}

void expect_same_settings(const ordered_json& now, const ordered_json& noted, const std::string& what,
                          const std::filesystem::path& result_folder) {
  for (const ordered_json* settings : {&now, &noted}) {
    for (const auto& [key, value] : settings->items()) {
      if (now.contains(key) && noted.contains(key) && now[key] == noted[key]) continue;
      if (key == "scene_digest") {
        throw_input(fmt::format("--resume {}", printable(result_folder.string())),
                    fmt::format("the scene, or a file that it names, has changed since {}", what),
                    "restore the scene, or omit --resume to start again");
      }
      throw_input(fmt::format("--resume {}", printable(result_folder.string())),
                  fmt::format("{} has other settings: {} was {}, now {}", what, setting_name(key), value_text(noted, key),
                              value_text(now, key)),
                  "use the same settings, or omit --resume to start again");
    }
  }
}

}  // namespace sunfleck
