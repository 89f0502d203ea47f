#pragma once
// Collects the files that could not be written at the end of a run. The other results are kept.

#include "base/error.h"

#include <new>
#include <string>
#include <utility>
#include <vector>

namespace sunfleck {

class UnwrittenFiles {
 public:
  // Does `work`. If it fails or memory runs out, `name` counts as not written.
  template <class Work>
  void attempt(const std::string& name, Work&& work) {
    try {
      std::forward<Work>(work)();
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::failure) throw;
      note(name, error.what());
    } catch (const std::bad_alloc&) {
      note(name, three_part_message(name + ": cannot be written", "out of memory", "leave it out, or free some memory"));
    }
  }

  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }

  // Throws Error (failure) if any file was not written, with the first reason and the number of other files. `cure` is added as
  // further advice.
  void throw_if_any(const std::string& cure = {}) const;

 private:
  void note(const std::string& name, const std::string& why);

  std::vector<std::string> names_;
  std::string first_;
};

}  // namespace sunfleck
