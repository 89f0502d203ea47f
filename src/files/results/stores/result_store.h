#pragma once
// Stores a finished run in one file, pictures.cbor of the result folder. It holds everything needed to draw pictures, so that
// `render` needs neither the scene's files nor a simulation.
//
// The file is CBOR (RFC 8949): a map of named numbers, texts and lists, with long arrays as base/packed_array.h describes.
// `format` and `version` identify it; the reader refuses versions that it does not know.

#include "files/results/tables/result_writer.h"
#include "files/scene/scene_reader.h"
#include "physics/transport/model/result.h"

#include <cstdint>
#include <filesystem>
#include <string>

namespace sunfleck {

inline constexpr const char* result_store_file = "pictures.cbor";

// Content of the file. `scene` has the title, digest, model and camera; its model lacks the kind of sky, the planes and the
// sensors (`sky` is set if the scene has one). `result` has all counts of landings and quanta by side and by cell, their
// conversion to W m-2, the leaf area index, and the rays, packets, sky rays and relative errors of both passes.
struct StoredResult {
  Scene scene;
  RadiationResult result;
  std::uint64_t seed = 1;
  bool complete = true;
};

// Writes the file aside and renames it. Throws Error (failure).
void write_result_store(const std::filesystem::path& file, const RunRecord& record, const Scene& scene,
                        const RadiationResult& result);

// Reads the file and checks every size, index and range, so that the result can be drawn safely. Throws Error (input).
[[nodiscard]] StoredResult read_result_store(const std::filesystem::path& file);

// Does the same with the bytes of a file of that name.
[[nodiscard]] StoredResult parse_result_store(const std::string& bytes, const std::filesystem::path& file);

}  // namespace sunfleck
