#pragma once
// Writes the events of a window as lines of JSON to standard output, for logs and for programs that drive the window.

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace sunfleck {

enum class EventLines { off, on };

class Events {
 public:
  explicit Events(EventLines lines) : lines_(lines) {}

  // Writes {"event": NAME, ...fields} on a separate line at once.
  void tell(const std::string& name, const nlohmann::json& fields) const;
  [[nodiscard]] bool wanted() const { return lines_ == EventLines::on; }

 private:
  EventLines lines_;
};

}  // namespace sunfleck
