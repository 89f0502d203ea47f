#pragma once
// A finished run in one file, pictures.cbor of the result folder: all that pictures are drawn from, so that `render` needs
// neither the scene's files nor a simulation.
//
// The file is CBOR (RFC 8949): a map of named numbers, texts and lists, and long arrays as byte strings, little-endian and
// deflated (zlib). `format` and `version` say what it is; a reader refuses other versions.

#include "io/result_writer.h"
#include "io/scene_reader.h"
#include "transport/result.h"

#include <cstdint>
#include <filesystem>
#include <string>

namespace sunfleck {

inline constexpr const char* result_store_file = "pictures.cbor";

// Of the scene: title, digest, model and camera; the model without the sky's kind, planes and sensors (`sky` is there if it has
// one). Of the result: all that counts landings and quanta by side and by cell, what turns them into W m-2, leaf area index,
// and the rays, packets, sky rays and relative errors of both passes. Files of earlier builds lack the sky rays: 0.
struct StoredResult {
  Scene scene;
  RadiationResult result;
  std::uint64_t seed = 1;
  bool complete = true;
};

// Written aside and renamed. Throws Error (failure).
void write_result_store(const std::filesystem::path& file, const RunRecord& record, const Scene& scene,
                        const RadiationResult& result);

// Checks every size, index and range, so that what it returns can be drawn. Throws Error (input).
[[nodiscard]] StoredResult read_result_store(const std::filesystem::path& file);

// The same from the bytes of a file of that name.
[[nodiscard]] StoredResult parse_result_store(const std::string& bytes, const std::filesystem::path& file);

}  // namespace sunfleck
