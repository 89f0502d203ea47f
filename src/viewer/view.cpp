#include "viewer/view.h"

#include "app/terminal.h"
#include "base/error.h"
#include "base/log.h"
#include "io/file.h"
#include "simulate/interrupt.h"
#include "tracers/engine.h"
#include "view/text.h"
#include "viewer/viewer.h"
#include "viewer/window.h"

namespace sunfleck {
int view(const ViewOptions& options) {
  start_log(options.run.quiet ? Verbosity::quiet : Verbosity::normal);
  exit_on_interrupts();
  set_software_threads(options.run.threads);
  const CpuThreads threads(options.run.threads);
  WindowSettings settings;
  settings.title = "sunfleck: " + printable(options.run.scene.filename().string());
  settings.width = options.run.pictures.width;
  settings.height = options.run.pictures.height;
  settings.validation = build_validation;
  settings.font = Typeface::file();
  Window window(settings);
  int status = exit_done;
  {
    Viewer viewer(options, window);
    watch_for_interrupts();
    status = viewer.run();
  }
  if (const auto& messages = window.validation_messages(); !messages.empty()) {
    throw_failure(messages.front(), "a message of the Vulkan validation layer about the window",
                  "report this message and the device");
  }
  return status;
}

}  // namespace sunfleck
