#pragma once
// Files in which the program keeps its own state in order to resume later: eight letters identify the kind of file, then follow
// a CBOR map (RFC 8949) and its checksum (CRC-32, little-endian). Also compares the settings stored in them.

#include <filesystem>
#include <iosfwd>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace sunfleck {

// Writes a file that begins with the eight letters of `mark`.
void seal(std::ostream& out, std::string_view mark, const nlohmann::json& content);

// Returns the map; nothing if it is another kind of file, its checksum is wrong, or maps and lists are nested more than two
// deep.
[[nodiscard]] std::optional<nlohmann::json> unsealed(std::string_view mark, std::string_view bytes);

// Returns a JSON object of plain values; null if the text is damaged or holds anything else.
[[nodiscard]] nlohmann::ordered_json parse_settings(const std::string& text);

// Throws Error (input), naming the first difference, unless the settings are equal. `noted` are those of `what` ("that day") in
// `result_folder`.
void expect_same_settings(const nlohmann::ordered_json& now, const nlohmann::ordered_json& noted, const std::string& what,
                          const std::filesystem::path& result_folder);

}  // namespace sunfleck
