#include "programs/validate/validate.h"

#include "base/error.h"
#include "base/file.h"
#include "base/folder_lock.h"
#include "base/log.h"
#include "base/stopwatch.h"
#include "base/threads.h"
#include "base/version.h"
#include "devices/tracers/cpu_tracer.h"
#include "devices/tracers/engine.h"
#include "devices/tracers/trace_domain.h"
#include "devices/tracers/vulkan_tracer.h"
#include "programs/cli/terminal.h"
#include "programs/validate/known_cases.h"
#include "programs/validate/validate_report.h"
#include "simulate/interrupt.h"

#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <vector>

namespace sunfleck {
namespace {

struct OwnTree {
  GpuTree tree;
};

// A tracer that owns its tree on the device.
class DeviceTracer final : OwnTree, public VulkanTracer {
 public:
  DeviceTracer(const GpuContext& context, const Bvh& bvh, TraceDomain domain, std::size_t counter_words)
      : OwnTree{GpuTree(context, bvh, preferred_use(context, bvh))}, VulkanTracer(context, bvh, tree, domain, counter_words) {}
};

TracerMaker tracer_maker(const GpuContext* context) {
  return [context](const Bvh& bvh, TraceDomain domain, std::size_t counter_words) -> std::unique_ptr<Tracer> {
    if (context == nullptr) return std::make_unique<CpuTracer>(bvh, domain);
    return std::make_unique<DeviceTracer>(*context, bvh, domain, counter_words);
  };
}

TracerDevice device_of(const GpuContext* context) {
  if (context == nullptr) return CpuTracer(Bvh{}, {}).device();
  const DeviceDescription& device = context->description();
  return {"vulkan", device.name, device.driver, device.software};
}

void write_tables(const std::filesystem::path& folder, const ValidationRecord& record,
                  const std::vector<JudgedAnswer>& answers) {
  write_file(folder / "validate.md", validation_markdown(record, answers));
  write_file(folder / "validate.json", validation_json(record, answers));
}

// Prints the table on standard output, row by row, as it grows.
class TablePrinter {
 public:
  explicit TablePrinter(const ValidateOptions& options) : all_(!options.quiet && !options.json), failures_(!options.json) {
    if (all_) print(answer_heading());
  }
  void add(const JudgedAnswer& judged) const {
    if (all_ || (failures_ && !judged.passed)) print(answer_line(judged));
  }
  void end(const std::string& summary, bool failed) const {
    if (all_ || (failures_ && failed)) print(summary);
  }

 private:
  static void print(const std::string& line) {
    fmt::print("{}\n", line);
    std::fflush(stdout);
  }

  bool all_, failures_;
};

void check_layer(const GpuContext* context) {
  if (context == nullptr || context->validation_messages().empty()) return;
  throw_failure(context->validation_messages().front(),
                fmt::format("{} messages of the Vulkan validation layer", context->validation_messages().size()),
                "report this message and the device");
}

}  // namespace

int validate(const ValidateOptions& options) {
  start_log(options.quiet || options.json ? Verbosity::quiet : Verbosity::normal);
  exit_on_interrupts();
  Stopwatch watch;
  const std::vector<CaseGroup> groups = choose_case_groups(options.cases);
  const std::filesystem::path folder = options.output.empty() ? "results/validate" : options.output;

  set_software_threads(options.threads);
  const CpuThreads threads(options.threads);
  const std::unique_ptr<GpuContext> context = open_device(options.device);
  FolderLock lock(folder);
  lock.make_folder();
  ValidationRecord record{version(), commit(), device_of(context.get()), false};
  watch_for_interrupts();
  // The files are written once before the work, so that an unwritable folder is noticed at once.
  write_tables(folder, record, {});
  say(device_line(record.device));

  CaseBench bench(tracer_maker(context.get()), interrupted, context == nullptr);
  std::vector<JudgedAnswer> answers;
  const TablePrinter printer(options);
  record.complete = run_case_groups(groups, bench, [&](const JudgedAnswer& judged) {
    answers.push_back(judged);
    printer.add(judged);
  });
  check_layer(context.get());
  record.seconds = watch.lap();

  write_tables(folder, record, answers);
  if (options.json) fmt::print("{}", validation_json(record, answers));
  const bool failed = count_failed(answers) > 0;
  printer.end(answer_summary(record, answers), failed);
  if (!record.complete) return exit_interrupted;
  return failed ? exit_failed : exit_done;
}

}  // namespace sunfleck
