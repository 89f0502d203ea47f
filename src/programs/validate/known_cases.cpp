#include "programs/validate/known_cases.h"

#include "base/check.h"
#include "base/error.h"
#include "base/text.h"
#include "programs/validate/beam_cases.h"
#include "programs/validate/canopy_cases.h"
#include "programs/validate/cavity_cases.h"
#include "programs/validate/device_cases.h"
#include "programs/validate/exchange_cases.h"
#include "programs/validate/light_cases.h"
#include "programs/validate/sun_cases.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <new>

namespace sunfleck {
namespace {

constexpr std::array groups = {CaseGroup{"sun position", 0, sun_position_cases},
                               CaseGroup{"sunrise and sunset", 0, sun_event_cases},
                               CaseGroup{"weather", 0, weather_cases},
                               CaseGroup{"sky integrals", 0, sky_integral_cases},
                               CaseGroup{"counters", 0, counter_cases},
                               CaseGroup{"device", 0, device_cases},
                               CaseGroup{"beam", 12, beam_cases},
                               CaseGroup{"wrap", 15, wrap_cases},
                               CaseGroup{"view factors", 8, view_factor_cases},
                               CaseGroup{"endless strips", 7, endless_strip_cases},
                               CaseGroup{"parallel plates", 0, parallel_plate_cases},
                               CaseGroup{"plates over soil", 30, plate_over_soil_cases},
                               CaseGroup{"furnace", 12, furnace_cases},
                               CaseGroup{"cavity", 6, cavity_cases},
                               CaseGroup{"sky light", 8, sky_light_cases},
                               CaseGroup{"random scene", 10, explicit_scene_cases},
                               CaseGroup{"Beer-Lambert", 8, random_leaf_cases},
                               CaseGroup{"two-stream", 9, two_stream_cases},
                               CaseGroup{"ledger", 0, ledger_cases}};

std::size_t estimates_of_the_table() {
  std::size_t count = 0;
  for (const CaseGroup& group : groups) count += group.estimates;
  return count;
}

// Returns the rows of one group; an exception it throws becomes a row.
std::vector<KnownAnswer> answers_of(const CaseGroup& group, CaseBench& bench) {
  std::string trouble;
  try {
    group.run(bench);
  } catch (const CaseInterrupted&) {
    (void)bench.take_rows(group.name);
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::device) throw;
    trouble = error.what();
  } catch (const std::exception& error) {
    trouble = error.what();
  }
  std::vector<KnownAnswer> rows = bench.take_rows(group.name);
  if (!trouble.empty()) {
    KnownAnswer row;
    row.name = fmt::format("{}: ended by an error", group.name);
    row.trouble = trouble;
    rows.push_back(row);
    return rows;
  }
  const auto estimates = std::count_if(rows.begin(), rows.end(), [](const KnownAnswer& row) { return row.is_estimate(); });
  ENSURE(static_cast<std::size_t>(estimates), ==, group.estimates);
  return rows;
}

}  // namespace

std::span<const CaseGroup> all_case_groups() {
  return groups;
}

std::vector<CaseGroup> choose_case_groups(const std::vector<std::string>& parts) {
  std::vector<bool> chosen(groups.size(), parts.empty());
  for (const std::string& part : parts) {
    bool found = false;
    for (std::size_t k = 0; k < groups.size(); ++k) {
      if (part.empty() || lower_case(groups[k].name).find(lower_case(part)) == std::string::npos) continue;
      chosen[k] = found = true;
    }
    if (found) continue;
    std::vector<const char*> names;
    for (const CaseGroup& group : groups) names.push_back(group.name);
    throw_input(fmt::format("--cases \"{}\"", part), "no group of cases contains this in its name",
                fmt::format("give part of one of: {}", fmt::join(names, ", ")));
  }
  std::vector<CaseGroup> result;
  for (std::size_t k = 0; k < groups.size(); ++k) {
    if (chosen[k]) result.push_back(groups[k]);
  }
  return result;
}

bool run_case_groups(std::span<const CaseGroup> chosen, CaseBench& bench,
                     const std::function<void(const JudgedAnswer&)>& report) {
  const std::size_t comparisons = estimates_of_the_table();
  for (const CaseGroup& group : chosen) {
    try {
      for (const KnownAnswer& answer : answers_of(group, bench)) report({answer, passes(answer, comparisons)});
    } catch (const CaseInterrupted&) {
      return false;
    }
    if (bench.stop() && bench.stop()()) return false;
  }
  return true;
}

}  // namespace sunfleck
