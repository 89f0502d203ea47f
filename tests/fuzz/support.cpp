#include "fuzz/support.h"

#include "base/error.h"
#include "support/mesh_files.h"
#include "support/scene_text.h"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>

namespace sunfleck::fuzz {

namespace {

namespace fs = std::filesystem;

class Folder {
 public:
  Folder() : path_(fs::temp_directory_path() / ("sunfleck_fuzz_" + std::to_string(::getpid()))) {
    fs::create_directories(path_);
    save("plates.obj", plates_obj);
    save("station.csv", station_csv);
    save("sky.light", "0.75 0 0 -1\n0.25 0.5 0.5 -0.7\n");
    save("square.glb", glb(gltf_document(), gltf_binary()));
    save("square.bin", gltf_binary());
  }
  ~Folder() {
    std::error_code code;
    fs::remove_all(path_, code);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  [[nodiscard]] const fs::path& path() const { return path_; }
  void save(const std::string& name, std::string_view bytes) const { std::ofstream(path_ / name, std::ios::binary) << bytes; }

 private:
  fs::path path_;
};

const Folder& the_folder() {
  static const Folder folder;
  return folder;
}

bool has_three_parts(std::string_view message) {
  const std::size_t why = message.find(" ("), cure = message.rfind("); ");
  const bool parts = why != message.npos && cure != message.npos && why > 0 && cure > why + 2 && cure + 3 < message.size();
  return parts && message.find_first_of(std::string_view("\n\r\t\x1b\0", 5)) == message.npos;
}

}  // namespace

void promise(bool kept, std::string_view what) {
  if (kept) return;
  std::fprintf(stderr, "promise broken: %.*s\n", static_cast<int>(what.size()), what.data());
  std::abort();
}

void read_or_refuse(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& error) {
    promise(error.kind() == ErrorKind::input && has_three_parts(error.what()), error.what());
  }
}

const fs::path& folder() {
  return the_folder().path();
}

fs::path write(const std::string& name, std::string_view bytes) {
  the_folder().save(name, bytes);
  return folder() / name;
}

}  // namespace sunfleck::fuzz
