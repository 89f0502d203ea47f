#pragma once
// Reads broken files and checks how they are refused.

#include "support/error_text.h"
#include "support/temp_folder.h"

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace sunfleck {

struct Broken {
  const char* what;
  const char* name;
  std::string bytes;
  const char* place;  // after the file's name
  const char* words;  // part of the message
};

// Expects each file to be refused in one line that begins with the place.
inline void expect_refused(const std::vector<Broken>& files, const std::function<void(const std::filesystem::path&)>& read) {
  const TempFolder folder;
  for (const Broken& broken : files) {
    SCOPED_TRACE(broken.what);
    const std::filesystem::path file = folder.write(broken.name, broken.bytes);
    const std::string message = refusal_of([&] { read(file); });
    EXPECT_TRUE(message.starts_with(file.string() + broken.place)) << message;
    EXPECT_NE(message.find(broken.words), std::string::npos) << message;
    expect_three_parts(message);
  }
}

// Returns `text` with the first `from` replaced.
inline std::string swapped(std::string text, std::string_view from, std::string_view to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

}  // namespace sunfleck
