#pragma once
// A user's requests for a simulation as plain values: the same for the command line, the window and Python.

#include "base/text.h"
#include "pictures/charts/picture.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sunfleck {

// Returns whether a list of words, such as exports or images, holds one.
[[nodiscard]] inline bool holds(const std::vector<std::string>& words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

// CARIBU's files that accompany a mesh given instead of a scene file.
struct StandFiles {
  std::vector<std::string> optics;      // FILE or NAME=FILE, one per band
  std::filesystem::path light, domain;  // may be empty
  std::optional<double> scale;          // metres per unit of the mesh and the domain; default 1

  // Returns the first of these options that was given, in this order, for messages; empty if none was.
  [[nodiscard]] std::string first_given() const {
    if (!optics.empty()) return "--optics";
    if (!light.empty()) return "--light";
    if (!domain.empty()) return "--domain";
    return scale ? "--scale" : "";
  }
};

struct SceneRequest {
  std::filesystem::path scene;  // scene file, or a mesh that `stand` completes
  StandFiles stand;
  bool allow_outside = false;  // the scene may name files outside its folder
  bool mesh_alone = false;     // a mesh without CARIBU's files gets the scene that mesh_scene.h writes, instead of an error
};

// Returns a kind of device in lower case, and any other word, which is a number or part of a name, as it is.
[[nodiscard]] inline std::string device_word(const std::string& word) {
  const std::string lower = lower_case(word);
  return holds({"auto", "gpu", "lavapipe", "cpu"}, lower) ? lower : word;
}

struct DeviceRequest {
  std::string device = "auto";  // auto | gpu | lavapipe | cpu | INDEX | NAME
  int device_turn = 0;          // see DeviceChoice; set for MPI ranks
  int threads = 0;              // 0: one per core
};

// The amount of work of a simulation.
struct WorkRequest {
  std::optional<double> direct_error, indirect_error;  // replace the scene's bounds
  std::optional<double> grid_m;
  std::optional<int> passes;
  std::optional<double> max_seconds;
  std::optional<std::uint64_t> max_rays;
  std::optional<std::uint64_t> memory_bytes;  // for replicates in progress; see solve_settings and day_solve_settings
  std::uint64_t seed = 1;
  // Estimates the light of single triangles with its errors, which costs memory and time; for pictures and exports.
  bool triangle_light = false;
  bool resume = false;  // resumes an earlier run's work in the folder
};

// The contents of a result folder.
struct ResultRequest {
  std::filesystem::path output;                // empty: results/<stem of the scene>
  std::vector<std::string> exports;            // names of files/results/exports/exports.h
  std::filesystem::path measured;              // field data; may be empty
  std::vector<std::filesystem::path> compare;  // folders of earlier results
  std::vector<std::string> images{"all"};      // file stems, all or none
  std::optional<Picture> extra_picture;        // drawn in addition, where --chart or --field requests it
  PictureOptions pictures;
};

// The hours of a day. If there are several dates, all have the same local hours.
struct DayRequest {
  std::string from, to;  // HH:MM; empty: sunrise and sunset
  std::string date;      // YYYY-MM-DD; empty: the scene's own
  std::string to_date;   // empty: one date
  int step_min = 60;     // the last step ends at `to`
  // Largest number of consecutive steps of a date that are simulated together and share their packets; by default as many as
  // steps_in_memory of simulate/day_blocks.h returns.
  std::optional<int> steps_together;
};

}  // namespace sunfleck
