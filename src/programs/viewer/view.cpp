#include "programs/viewer/view.h"

#include "base/error.h"
#include "base/file.h"
#include "base/log.h"
#include "base/threads.h"
#include "devices/tracers/engine.h"
#include "pictures/drawing/text.h"
#include "programs/cli/terminal.h"
#include "programs/viewer/viewer.h"
#include "programs/viewer/window.h"
#include "simulate/interrupt.h"

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
