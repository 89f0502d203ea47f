#include "app/commands.h"
#include "app/convert.h"
#include "app/day.h"
#include "app/options.h"
#include "app/process.h"
#include "app/render.h"
#include "app/tradeoff.h"
#include "app/validate.h"
#include "viewer/view.h"

#include <fmt/format.h>

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
  int operator()(const sunfleck::ViewOptions& options) const { return sunfleck::view(options); }
  int operator()(const sunfleck::ValidateOptions& options) const { return sunfleck::validate(options); }
  int operator()(const sunfleck::TradeoffOptions& options) const { return sunfleck::tradeoff(options); }
  int operator()(const sunfleck::MaizeOptions& options) const { return sunfleck::write_maize(options); }
  int operator()(const sunfleck::ConvertOptions& options) const { return sunfleck::convert(options); }
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
