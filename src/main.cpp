#include "app/commands.h"
#include "app/day.h"
#include "app/options.h"
#include "app/render.h"
#include "base/error.h"

#include <fmt/format.h>

#include <exception>
#include <new>
#include <variant>

namespace {

struct Dispatch {
  int operator()(const sunfleck::TextToPrint& text) const {
    fmt::print("{}", text.text);
    return 0;
  }
  int operator()(const sunfleck::RunOptions& options) const { return sunfleck::run(options); }
  int operator()(const sunfleck::DayOptions& options) const { return sunfleck::run_day(options); }
  int operator()(const sunfleck::RenderOptions& options) const { return sunfleck::render(options); }
  int operator()(const sunfleck::MaizeOptions& options) const { return sunfleck::write_maize(options); }
  int operator()(const sunfleck::InfoOptions& options) const { return sunfleck::show_info(options); }
};

}  // namespace

int main(int argc, char** argv) {
  try {
    return std::visit(Dispatch{}, sunfleck::parse_command_line(argc, argv));
  } catch (const sunfleck::Error& error) {
    fmt::print(stderr, "sunfleck: {}\n", error.what());
    return static_cast<int>(error.kind());
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "sunfleck: out of memory; give fewer triangles, or a machine with more memory\n");
  } catch (const std::exception& error) {
    fmt::print(stderr, "sunfleck: {}; this is a mistake of the program, please report it\n", error.what());
  }
  return 1;
}
