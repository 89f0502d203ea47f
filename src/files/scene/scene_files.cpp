#include "files/scene/scene_files.h"

#include <algorithm>
#include <string>
#include <system_error>

namespace sunfleck {

namespace {

namespace fs = std::filesystem;

bool lies_in(const fs::path& file, const fs::path& folder) {
  const auto [in_folder, in_file] = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
  return in_folder == folder.end();
}

bool is_named(const fs::path& file, const SceneAccess& access) {
  return std::any_of(access.named.begin(), access.named.end(), [&](const fs::path& named) {
    std::error_code code;
    return fs::weakly_canonical(named, code) == file;
  });
}

}  // namespace

fs::path find_scene_file(const TomlTable& table, const fs::path& scene_file, const SceneAccess& access, std::string_view wanted,
                         std::string_view key) {
  if (table.has(key) && !table.is_text(key)) table.refuse(key, "it must be the name of a file, in quotes", wanted);
  const std::string name = *table.text(key);
  std::error_code code;
  const fs::path parent = scene_file.parent_path();
  const fs::path folder = fs::canonical(parent.empty() ? fs::path(".") : parent, code);
  if (code) table.refuse(key, "the scene's folder cannot be read: " + code.message(), "check its permissions");
  fs::path file = fs::weakly_canonical(folder / name, code);
  if (code) table.refuse(key, "its path cannot be resolved: " + code.message(), "correct the path");
  if (!access.allow_outside && !lies_in(file, folder) && !is_named(file, access)) {
    table.refuse(key, "it lies outside the scene's folder", "move it into that folder, or run with --allow-outside");
  }
  access.files->note(folder / name);
  const fs::file_status status = fs::status(file, code);
  if (status.type() == fs::file_type::not_found) {
    table.refuse_missing_file(key);
  }
  if (!fs::is_regular_file(status)) table.refuse(key, "it is not a regular file", wanted);
  return file;
}

}  // namespace sunfleck
