// Tests when a known answer passes, the closed forms behind the answers, and the tables that report them.
#include "base/error.h"

#include "base/units.h"
#include "physics/transport/model/statistics.h"
#include "programs/validate/known/exchange_scenes.h"
#include "programs/validate/known/known_formulas.h"
#include "programs/validate/known_cases.h"
#include "programs/validate/validate_report.h"
#include "support/error_text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace sunfleck {
namespace {

KnownAnswer estimate(double got, double expected, double standard_error) {
  KnownAnswer answer;
  answer.name = "group: what";
  answer.expected = expected;
  answer.got = got;
  answer.standard_error = standard_error;
  answer.replicates = 32;
  answer.largest_error = 0.01;
  return answer;
}

TEST(Verdict, IsStudentsForTheWholeTable) {
  // One comparison at 0.1 %: two-sided quantile of Student's t with 31 degrees of freedom.
  EXPECT_NEAR(table_quantile(1, 32), 3.633, 0.001);
  const double each = 1.0 - std::pow(0.999, 1.0 / 100.0);
  EXPECT_NEAR(table_quantile(100, 32), t_quantile(1.0 - each, 32), 1e-9);
  EXPECT_GT(table_quantile(100, 16), table_quantile(100, 32));
  const double limit = table_quantile(100, 32) * 0.001 + 1e-6;
  EXPECT_TRUE(passes(estimate(0.5 + 0.999 * limit, 0.5, 0.001), 100));
  EXPECT_FALSE(passes(estimate(0.5 + 1.001 * limit, 0.5, 0.001), 100));
  EXPECT_FALSE(passes(estimate(0.5 - 1.001 * limit, 0.5, 0.001), 100));
}

TEST(Verdict, WithoutErrorAsksForTheValueItself) {
  EXPECT_TRUE(passes(estimate(0.5 + 0.9e-6, 0.5, 0.0), 100));
  EXPECT_FALSE(passes(estimate(0.5 + 1.1e-6, 0.5, 0.0), 100));
  KnownAnswer exact = estimate(3.0, 3.0, 0.0);
  exact.replicates = 0;
  exact.tolerance = 0.0;
  EXPECT_TRUE(passes(exact, 100));
  exact.got = std::nextafter(3.0, 4.0);
  EXPECT_FALSE(passes(exact, 100));
  EXPECT_FALSE(exact.z().has_value());
}

TEST(Verdict, RefusesWideErrorsNoNumbersAndTrouble) {
  EXPECT_FALSE(passes(estimate(0.5, 0.5, 0.02), 100));
  EXPECT_FALSE(passes(estimate(std::nan(""), 0.5, 0.001), 100));
  EXPECT_FALSE(passes(estimate(0.5, 0.5, std::nan("")), 100));
  KnownAnswer trouble = estimate(0.5, 0.5, 0.001);
  trouble.trouble = "ended";
  EXPECT_FALSE(passes(trouble, 100));
}

TEST(KnownFormulas, PlatesOverSoil) {
  EXPECT_NEAR(light_on_plates(1, par_plates).reflected, 0.12054990, 5e-9);
  EXPECT_NEAR(light_on_plates(1, par_plates).up[0], 0.00916497, 5e-9);
  EXPECT_NEAR(light_on_plates(2, par_plates).on_soil, 0.00371980, 5e-9);
  EXPECT_NEAR(absorbed_by_plate(light_on_plates(2, par_plates), par_plates, 1), 0.05037971, 5e-9);
  EXPECT_NEAR(light_on_plates(1, nir_plates).reflected, 0.49450549, 5e-9);
  EXPECT_NEAR(light_on_plates(2, nir_plates).on_soil, 0.28621908, 5e-9);
  EXPECT_NEAR(absorbed_by_plate(light_on_plates(2, nir_plates), nir_plates, 0), 0.12862191, 5e-9);
}

TEST(KnownFormulas, LevelCanopies) {
  const LevelCanopyLight par = light_in_level_canopy(3.0, {0.12, 0.06}, 0.15);
  EXPECT_NEAR(par.reflected, 0.064413, 5e-7);
  EXPECT_NEAR(par.on_soil, 0.061335, 5e-7);
  EXPECT_NEAR(par.leaves, 0.883452, 5e-7);
  const LevelCanopyLight nir = light_in_level_canopy(1.0, {0.45, 0.45}, 0.20);
  EXPECT_NEAR(nir.reflected, 0.366096, 5e-7);
  EXPECT_NEAR(nir.leaves, 0.106938, 5e-7);
  EXPECT_NEAR(light_in_level_canopy(5.0, {0.5, 0.5}, 0.0).reflected, 2.5 / 3.5, 1e-9);
  EXPECT_NEAR(light_in_level_canopy(2.0, {0.0, 0.3}, 0.0).on_soil, std::exp(-1.4), 1e-12);
}

TEST(KnownFormulas, BlindsAndShiftedStrips) {
  EXPECT_NEAR(passed_by_blind(0.8, 0.0, 40.0 * degree, 1.0), 0.2, 1e-12);
  EXPECT_NEAR(passed_by_blind(0.8, 30.0 * degree, 40.0 * degree, 1.0), 0.78388111, 5e-9);
  EXPECT_EQ(passed_by_blind(0.8, 30.0 * degree, 40.0 * degree, -1.0), 0.0);
  EXPECT_NEAR(overlap_after_shift(0.5, 0.5, 1.0, 0.0), 0.5, 1e-12);
  EXPECT_NEAR(overlap_after_shift(0.5, 0.5, 1.0, 0.75), 0.25, 1e-12);
  EXPECT_NEAR(overlap_after_shift(0.5, 0.5, 1.0, -16.75), 0.25, 1e-12);
}

TEST(CaseGroups, AreChosenByPartsOfTheirNames) {
  EXPECT_EQ(choose_case_groups({}).size(), all_case_groups().size());
  const auto chosen = choose_case_groups({"FURN", "sun "});
  ASSERT_EQ(chosen.size(), 2U);
  EXPECT_STREQ(chosen[0].name, "sun position");
  EXPECT_STREQ(chosen[1].name, "furnace");
  for (const char* wrong : {"nonsense", ""}) {
    expect_refusal([&] { (void)choose_case_groups({"furnace", wrong}); }, "furnace");
  }
}

CaseBench bench_without_device() {
  return {{}, {}, true};
}

TEST(CaseGroups, GoOnAfterOneThatFails) {
  const std::array groups = {CaseGroup{"breaks", 1,
                                       [](CaseBench& bench) {
                                         bench.compare("first", {0.5, 0.001}, 0.5, {.largest_error = 1.0});
                                         throw_failure("the ledger of band PAR", "5 quanta are missing", "report it");
                                       }},
                             CaseGroup{"holds", 0, [](CaseBench& bench) { bench.equal("two", 2.0, 2.0); }}};
  CaseBench bench = bench_without_device();
  std::vector<JudgedAnswer> got;
  EXPECT_TRUE(run_case_groups(groups, bench, [&](const JudgedAnswer& judged) { got.push_back(judged); }));
  ASSERT_EQ(got.size(), 3U);
  EXPECT_EQ(got[0].answer.name, "breaks: first");
  EXPECT_TRUE(got[0].passed);
  EXPECT_FALSE(got[1].passed);
  EXPECT_EQ(got[1].answer.trouble, "the ledger of band PAR (5 quanta are missing); report it");
  EXPECT_TRUE(got[2].passed);
}

TEST(CaseGroups, EndWhereTheDeviceIsMissingOrTheUserWants) {
  CaseBench bench = bench_without_device();
  const auto ignore = [](const JudgedAnswer&) {};
  const std::array lost = {CaseGroup{"lost", 0, [](CaseBench&) { throw_device("device 9", "gone", "plug it in"); }}};
  EXPECT_THROW((void)run_case_groups(lost, bench, ignore), Error);
  const std::array stopped = {CaseGroup{"stopped", 0, [](CaseBench&) { throw CaseInterrupted(); }}};
  EXPECT_FALSE(run_case_groups(stopped, bench, ignore));
  const std::array miscounted = {CaseGroup{"miscounted", 2, [](CaseBench&) {}}};
  EXPECT_THROW((void)run_case_groups(miscounted, bench, ignore), std::logic_error);
}

TEST(ValidateReport, TablesSayTheSame) {
  KnownAnswer broken;
  broken.name = "furnace: ended by an error";
  broken.trouble = "a | b (c); d";
  const std::vector<JudgedAnswer> answers = {
      {estimate(0.51, 0.5, 0.005), true}, {estimate(0.9, 0.5, 0.005), false}, {broken, false}};
  const ValidationRecord record{"1.2.3", "abc", {"cpu", "CPU path", "", true}, true, 12.0};
  EXPECT_EQ(count_failed(answers), 2U);
  const auto json = nlohmann::json::parse(validation_json(record, answers));
  EXPECT_EQ(json["passed"], 1);
  EXPECT_EQ(json["failed"], 2);
  EXPECT_EQ(json["complete"], true);
  ASSERT_EQ(json["cases"].size(), 3U);
  EXPECT_EQ(json["cases"][0]["case"], "group: what");
  EXPECT_EQ(json["cases"][0]["expected"], 0.5);
  EXPECT_EQ(json["cases"][0]["got"], 0.51);
  EXPECT_EQ(json["cases"][0]["standard_error"], 0.005);
  EXPECT_NEAR(json["cases"][0]["z"].get<double>(), 2.0, 1e-9);
  EXPECT_EQ(json["cases"][0]["verdict"], "pass");
  EXPECT_EQ(json["cases"][1]["verdict"], "fail");
  EXPECT_TRUE(json["cases"][2]["got"].is_null() && json["cases"][2]["z"].is_null());
  EXPECT_EQ(json["cases"][2]["remark"], broken.trouble);
  const std::string markdown = validation_markdown(record, answers);
  EXPECT_NE(markdown.find("| case | expected | got | standard_error | z | verdict |"), std::string::npos);
  EXPECT_NE(markdown.find("| group: what | 0.5 | 0.51 | 5.0e-03 | +2.00 | pass |"), std::string::npos) << markdown;
  EXPECT_NE(markdown.find("(a \\| b (c); d)"), std::string::npos) << markdown;
  EXPECT_NE(answer_line(answers[1]).find("FAIL"), std::string::npos);
  EXPECT_EQ(answer_line(answers[1]).find('\n'), std::string::npos);
}

}  // namespace
}  // namespace sunfleck
