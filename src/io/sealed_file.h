#pragma once
// What the program keeps for itself, to go on with later: a CBOR map (RFC 8949) behind eight letters, which say what it is, and
// a check sum (CRC-32, little-endian) of the map. And the settings it was made with.

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace sunfleck {

// The bytes of a file; `mark` are its eight letters.
[[nodiscard]] std::string sealed(std::string_view mark, const nlohmann::json& content);

// The map. None if it is another kind of file, its sum is wrong, or maps and lists lie deeper than one in the other.
[[nodiscard]] std::optional<nlohmann::json> unsealed(std::string_view mark, std::string_view bytes);

// A JSON object of plain values; null if the text is damaged or holds more than those.
[[nodiscard]] nlohmann::ordered_json parse_settings(const std::string& text);

// Throws Error (input), naming the first one that differs, unless both are the same. `what` was made with `noted` ("that day")
// in `result_folder`.
void expect_same_settings(const nlohmann::ordered_json& now, const nlohmann::ordered_json& noted, const std::string& what,
                          const std::filesystem::path& result_folder);

}  // namespace sunfleck
