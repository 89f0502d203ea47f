#include "files/results/tables/tradeoff_table.h"

#include "base/units.h"
#include "files/results/tables/summary_parts.h"
#include "files/results/tables/table_text.h"
#include "physics/transport/model/statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace sunfleck {
namespace {

using nlohmann::ordered_json;

const char* series_name(TradeoffSeries series) {
  constexpr std::array names{"grid", "packets", "error", "mesh"};
  return names[static_cast<std::size_t>(series)];
}

const char* light_name(TradeoffSeries series) {
  constexpr std::array names{"direct", "indirect", "absorbed", "absorbed"};
  return names[static_cast<std::size_t>(series)];
}

ordered_json by_quantity(const std::array<double, 4>& values) {
  ordered_json json = ordered_json::object();
  for (const Quantity quantity : quantities)
    json[quantity_name(quantity)] = number_or_null(values[static_cast<std::size_t>(quantity)]);
  return json;
}

// Returns the laws that were fitted to a series, or nothing if there is none.
std::string laws_line(const TradeoffReport& report, TradeoffSeries series) {
  std::string laws;
  for (const TradeoffFit& fit : report.fits) {
    if (fit.series != series) continue;
    const PowerLaw& law = fit.of_rays;
    laws += fmt::format("{} {} {:.4g} {:.3f} {:.2g}", laws.empty() ? "" : ",", quantity_name(fit.quantity), law.factor,
                        law.exponent, law.half_width(report.record.accuracy.confidence));
  }
  if (laws.empty()) return laws;
  return fmt::format("# error of {} light = factor * rays^slope; factor, slope and half-width of the slope:{}\n",
                     light_name(series), laws);
}

std::string head(const TradeoffReport& report) {
  std::string text = table_head(report.record, "Speed against accuracy: runs of several seeds against a long reference",
                                "seconds: s, simulation alone; rays: beam and sky rays and packets; the errors: relative; "
                                "covered: share");
  text += fmt::format("# device {}; {} seeds a setting, up to four times as many where grids or packets are cheap\n",
                      report.record.device.name, report.seeds);
  text +=
      "# setting: grid, --grid in m with --passes 8, judged by the sun's direct light; packets, of the first round of each of "
      "8 replicates, by all other light; error, --error, and mesh, share of the triangles kept, by what is absorbed\n"
      "# true_relative_error: root mean square over canopy (vegetation, soil), layers, organs (from a tenth of the mean "
      "organ's flux on) or triangles (area-weighted) of the difference to the reference relative to the value (layers and "
      "canopy: at least 1 % of the incident flux; triangles: mean); reported_relative_error: the same of the half-widths; "
      "covered: share of the values that they reach; organs are those of vegetation\n";
  for (std::size_t i = 0; i < report.reference_rays.size(); ++i) {
    if (report.reference_rays[i] == 0) continue;
    text += fmt::format("# reference of {} light: {} rays and packets, its own error", light_name(all_series[i]),
                        report.reference_rays[i]);
    for (const Quantity quantity : quantities) {
      const double error = report.reference_error[i][static_cast<std::size_t>(quantity)];
      if (std::isfinite(error)) text += fmt::format(", {} {:.2g}", quantity_name(quantity), error);
    }
    text += '\n';
  }
  text += laws_line(report, TradeoffSeries::grids) + laws_line(report, TradeoffSeries::packets);
  if (report.recommendation) text += fmt::format("# {}\n", recommendation_line(*report.recommendation));
  if (!report.record.complete) text += "# incomplete: stopped before all settings were measured\n";
  return text;
}

ordered_json law_json(const PowerLaw& law, double confidence) {
  return {{"slope", number_or_null(law.exponent)}, {"slope_error", number_or_null(law.half_width(confidence))}};
}

ordered_json recommendation_json(const Recommendation& recommendation) {
  return {{"asked_relative_error", recommendation.requested_error},
          {"quantity", quantity_name(recommendation.quantity)},
          {"error", recommendation.bound},
          {"seconds", number_or_null(recommendation.seconds)},
          {"expected_relative_error", number_or_null(recommendation.expected)},
          {"margin", number_or_null(recommendation.margin)},
          {"extrapolated", recommendation.extrapolated}};
}

ordered_json level_json(const TradeoffLevel& level) {
  return {{"setting", setting_name(level)},
          {"light", light_name(level.series)},
          {"seeds", level.runs.size()},
          {"rays", number_or_null(mean_rays(level))},
          {"seconds", number_or_null(median_seconds(level))},
          {"true_relative_error", by_quantity(level.error)}};
}

}  // namespace

const char* quantity_name(Quantity quantity) {
  constexpr std::array names{"canopy", "layer", "organ", "triangle"};
  return names[static_cast<std::size_t>(quantity)];
}

double PowerLaw::half_width(double confidence) const {
  return points > 2 ? t_quantile(confidence, points - 1) * standard_error : no_value;
}

std::string setting_name(const TradeoffLevel& level) {
  return fmt::format("{} {:.6g}", series_name(level.series), level.value);
}

double median_seconds(const TradeoffLevel& level) {
  if (level.runs.empty()) return no_value;
  std::vector<double> seconds;
  for (const TradeoffRun& run : level.runs) seconds.push_back(run.seconds);
  std::sort(seconds.begin(), seconds.end());
  const std::size_t half = seconds.size() / 2;
  return seconds.size() % 2 == 1 ? seconds[half] : 0.5 * (seconds[half - 1] + seconds[half]);
}

double mean_rays(const TradeoffLevel& level) {
  double sum = 0.0;
  for (const TradeoffRun& run : level.runs) sum += static_cast<double>(run.rays);
  return level.runs.empty() ? no_value : sum / static_cast<double>(level.runs.size());
}

std::string tradeoff_csv(const TradeoffReport& report) {
  std::string text = head(report);
  text +=
      "setting,seed,seconds,rays,quantity,true_relative_error,reported_relative_error,covered,largest_relative_error,light\n";
  for (const TradeoffLevel& level : report.levels) {
    for (const TradeoffRun& run : level.runs) {
      for (const Quantity quantity : quantities) {
        const QuantityError& error = run.errors[static_cast<std::size_t>(quantity)];
        if (std::isnan(error.true_error)) continue;
        std::string row =
            fmt::format("{},{},{:.4g},{},{}", setting_name(level), run.seed, run.seconds, run.rays, quantity_name(quantity));
        for (const double value : {error.true_error, error.reported, error.covered, error.largest}) append_number(row, value);
        text += fmt::format("{},{}\n", row, light_name(level.series));
      }
    }
  }
  return text;
}

std::string tradeoff_json(const TradeoffReport& report) {
  const RunRecord& record = report.record;
  ordered_json json{{"sunfleck", record.version},
                    {"scene", record.scene_file},
                    {"scene_digest", record.scene_digest},
                    {"complete", record.complete},
                    {"seed", record.seed},
                    {"seeds", report.seeds},
                    {"confidence", record.accuracy.confidence},
                    {"of", error_target_name(record.accuracy.of)},
                    {"device", {{"kind", record.device.kind}, {"name", record.device.name}, {"driver", record.device.driver}}}};
  json["recommendation"] = report.recommendation ? recommendation_json(*report.recommendation) : ordered_json(nullptr);
  json["slopes"] = ordered_json::array();
  for (const TradeoffFit& fit : report.fits) {
    json["slopes"].push_back({{"light", light_name(fit.series)},
                              {"quantity", quantity_name(fit.quantity)},
                              {"rays", law_json(fit.of_rays, record.accuracy.confidence)},
                              {"seconds", law_json(fit.of_seconds, record.accuracy.confidence)}});
  }
  json["reference"] = ordered_json::array();
  for (std::size_t i = 0; i < report.reference_rays.size(); ++i) {
    if (report.reference_rays[i] == 0) continue;
    json["reference"].push_back({{"light", light_name(all_series[i])},
                                 {"rays", report.reference_rays[i]},
                                 {"relative_error", by_quantity(report.reference_error[i])}});
  }
  json["settings"] = ordered_json::array();
  for (const TradeoffLevel& level : report.levels) json["settings"].push_back(level_json(level));
  json["seconds"] = report.total_seconds;
  return json.dump(2) + "\n";
}

std::string recommendation_line(const Recommendation& recommendation) {
  const double seconds = recommendation.seconds;
  const std::string time = seconds < 9.95   ? fmt::format("{:.2g} s", seconds)
                           : seconds < 120  ? fmt::format("{:.0f} s", seconds)
                           : seconds < 7200 ? fmt::format("{:.0f} min", seconds / 60.0)
                                            : fmt::format("{:.0f} h", seconds / 3600.0);
  return fmt::format("for {:g} % per {}: --error {:g}, about {} on this device{}", 100.0 * recommendation.requested_error,
                     quantity_name(recommendation.quantity), recommendation.bound, time,
                     recommendation.extrapolated ? " (beyond the bounds measured)" : "");
}

}  // namespace sunfleck
