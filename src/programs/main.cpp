#include "programs/cli/commands.h"
#include "programs/cli/convert.h"
#include "programs/cli/day.h"
#include "programs/cli/info.h"
#include "programs/cli/new.h"
#include "programs/cli/options.h"
#include "programs/cli/process.h"
#include "programs/cli/render.h"
#include "programs/tradeoff/tradeoff.h"
#include "programs/validate/validate.h"
#ifdef SUNFLECK_VIEWER
#include "programs/viewer/view.h"
#else
#include "base/error.h"
#endif

#include <fmt/format.h>

#include <variant>

namespace {

int show_in_window([[maybe_unused]] const sunfleck::ViewOptions& options) {
#ifdef SUNFLECK_VIEWER
  return sunfleck::view(options);
#else
  sunfleck::throw_input("view", "this program was built without its window",
                        "use render, or build it with -DSUNFLECK_VIEWER=ON");
#endif
}

struct Dispatch {
  int operator()(const sunfleck::TextToPrint& text) const {
    fmt::print("{}", text.text);
    return 0;
  }
  int operator()(const sunfleck::RunOptions& options) const { return sunfleck::run(options); }
  int operator()(const sunfleck::DayOptions& options) const { return sunfleck::run_day(options); }
  int operator()(const sunfleck::RenderOptions& options) const { return sunfleck::render(options); }
  int operator()(const sunfleck::ViewOptions& options) const { return show_in_window(options); }
  int operator()(const sunfleck::ValidateOptions& options) const { return sunfleck::validate(options); }
  int operator()(const sunfleck::TradeoffOptions& options) const { return sunfleck::tradeoff(options); }
  int operator()(const sunfleck::MaizeOptions& options) const { return sunfleck::write_maize(options); }
  int operator()(const sunfleck::ConvertOptions& options) const { return sunfleck::convert(options); }
  int operator()(const sunfleck::NewOptions& options) const { return sunfleck::write_new_scene(options); }
  int operator()(const sunfleck::InfoOptions& options) const { return sunfleck::show_info(options); }
};

}  // namespace

int main(int argc, char** argv) {
  sunfleck::prepare_process();
  try {
    const sunfleck::Command command = sunfleck::parse_command_line(argc, argv);
    if (sunfleck::is_left_to_rank_0(command)) return 0;
    return sunfleck::finish_output(std::visit(Dispatch{}, command));
  } catch (...) {
    return sunfleck::report_exception();
  }
}
