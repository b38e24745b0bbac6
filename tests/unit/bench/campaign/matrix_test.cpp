// Tests which response to a fault is reported, depending on the flags of the target and the checks of the
// flight.
#include "bench/bindings/canhil.hpp"
#include "bench/campaign/matrix/response.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <set>

#include "bench/campaign/matrix/matrix.hpp"
#include "bench/campaign/matrix/minimise.hpp"
#include "bench/drive/contract.hpp"
#include "bench/estimators/transfer_alignment/answers.hpp"
#include "bench/faults/kinds.hpp"
#include "bench/world/motion/rest.hpp"
#include "dbc/files/text_file.hpp"
#include "tests/unit/bench/edited.hpp"

namespace canhil::campaign::matrix {
namespace {

using checks::Outcome;
using drive::Ending;
using testing::ElementsAre;
using testing::HasSubstr;
using Kind = Response::Kind;

constexpr std::int64_t second_us = 1'000'000, duration_us = 20 * second_us;

// A flight of 20 s in which all checks pass, although there is a fault from 8 to 10 s. The tests set what the
// target reports.
class Flown : public testing::Test {
 protected:
  Flown() {
    scenario_.binding = bindings::canhil();
    scenario_.duration_us = duration_us;
    scenario_.faults.push_back({.name = "it", .from_us = 8 * second_us, .to_us = 10 * second_us});
    run_.faults.push_back({.name = "it",
                           .kind = "bias",
                           .count = 1,
                           .windows = {{.from_us = 8 * second_us, .to_us = 10 * second_us}}});
    run_.ending = {.kind = Ending::Kind::completed, .t_us = duration_us, .detail = ""};
    for (std::int64_t t_us = 100'000; t_us <= duration_us; t_us += 100'000)
      run_.seen.of<estimators::TransferAnswers>().filter.push_back({.cause_us = t_us});
    judged("honest", Outcome::pass);
    judged("answering", Outcome::pass);
  }
  void judged(const std::string& kind, Outcome outcome) {
    run_.verdict.checks.push_back({.name = kind,
                                   .kind = kind,
                                   .requirement = "",
                                   .outcome = outcome,
                                   .measured = "so",
                                   .expected = ""});
  }
  void degraded(double from_s, double to_s) {
    test::Edited edited(run_.seen.of<estimators::TransferAnswers>().filter);
    for (auto& answer : edited) {
      const double t_s = 1e-6 * static_cast<double>(answer.cause_us);
      if (t_s > from_s - 0.01 && t_s < to_s + 0.01) answer.degraded = true;
    }
  }
  [[nodiscard]] Response response() const { return response_of(scenario_, run_, &before_); }

  scenario::Scenario scenario_;
  drive::Run run_{.verdict = {},
                  .ending = {},
                  .seen = {},
                  .truth = {{.start = {}, .motion = world::Rest{}}, duration_us, 10'000},
                  .options = {}};
  Undisturbed before_;
};

TEST_F(Flown, ToleratedWhereNothingIsSaidAndNothingFails) {
  EXPECT_EQ(response().kind, Kind::tolerated);
  EXPECT_EQ(to_text(response()), "tolerated");
}

TEST_F(Flown, DetectedAndRecovered) {
  degraded(8.3, 10.5);
  EXPECT_EQ(to_text(response()), "detected in 0.300 s (degraded in an answer), recovered in 0.500 s");
  degraded(8.3, 9);
  before_.signs = checks::signs_in(run_.seen, {});
  degraded(8.3, 20);
  EXPECT_THAT(to_text(response()), HasSubstr("not recovered"));
}

TEST_F(Flown, WhatIsSaidWithoutAFaultTooIsNoResponse) {
  degraded(8.3, 20);
  before_.signs = {{.name = "degraded", .by = "an answer", .t_us = {}}};
  for (std::int64_t t_us = 8 * second_us; t_us <= duration_us; t_us += 100'000)
    before_.signs.front().t_us.push_back(t_us);
  EXPECT_EQ(response().kind, Kind::tolerated);
}

TEST_F(Flown, ViolatedByTheCheckThatFails) {
  degraded(8.3, 9);
  judged("counts_match", Outcome::fail);
  EXPECT_EQ(response().kind, Kind::violated);
  EXPECT_EQ(response().check, "counts_match");
  before_.failed = {"counts_match"};
  EXPECT_EQ(response().kind, Kind::detected) << "it fails without a fault too";
}

TEST_F(Flown, NotMeasuredIsNoPass) {
  judged("honest", Outcome::not_measured);
  EXPECT_EQ(response().kind, Kind::not_measured);
}

TEST_F(Flown, EndedWithItsReasonIsADetection) {
  run_.ending = {.kind = Ending::Kind::target_fault,
                 .t_us = 8'500'000,
                 .detail = "the target reported a fault of its transfer_alignment, its errors: input_silent"};
  EXPECT_EQ(to_text(response()), "ended in 0.500 s: input_silent");
}

TEST_F(Flown, SilenceOfTheTargetIsAViolation) {
  run_.ending = {.kind = Ending::Kind::target_silent, .t_us = 9 * second_us, .detail = "no StepDone"};
  EXPECT_EQ(response().kind, Kind::violated);
  EXPECT_EQ(response().check, flight_itself);
}

TEST(CellRunInJson, IsReadBack) {
  for (const Kind kind : {Kind::tolerated, Kind::detected, Kind::ended, Kind::violated, Kind::not_measured}) {
    const CellRun run{.faults = {"{ kind = \"lost\" }"},
                      .response = {.kind = kind, .detected_s = 0.5, .by = "a mark", .why = "so"},
                      .replay = "violation-1.toml"};
    const auto json = json_of(run);
    const CellRun back = cell_run_in(json);
    EXPECT_EQ(back.response.kind, kind);
    EXPECT_EQ(json_of(back), json);
  }
  EXPECT_THROW(cell_run_in({{"faults", {}}, {"response", "liked"}}), nlohmann::json::exception);
}

FaultText fault(const std::string& kind, const std::string& from_s, const std::string& to_s) {
  FaultText made;
  made.set("kind", "\"" + kind + "\"");
  made.set("from_s", from_s);
  made.set("to_s", to_s);
  made.set("every", "1");
  return made;
}

TEST(Minimise, LeavesTheFaultTheWindowAndTheFlightThatAreNeeded) {
  // The violation needs a flight of at least 6.4 s and the fault `changed`, which must be active at 5.20 s
  // and affect at least every eighth frame.
  const Shows shows = [](const std::vector<FaultText>& faults, std::int64_t flown_us) {
    if (flown_us != 0 && flown_us < 6'400'000) return false;
    return std::ranges::any_of(faults, [](const FaultText& one) {
      return one.find("kind")->value == "\"changed\"" && std::stod(one.find("from_s")->value) <= 5.2 &&
             std::stod(one.find("to_s")->value) >= 5.2 && std::stoi(one.find("every")->value) <= 8;
    });
  };
  const Minimised least = minimise(
      {fault("lost", "3", "9"), fault("changed", "4", "8"), fault("repeated", "5", "6")}, duration_us, shows);
  ASSERT_EQ(least.faults.size(), 1U);
  EXPECT_EQ(least.duration_us, 6'400'000);
  EXPECT_EQ(least.faults.front().in_line(),
            R"({ kind = "changed", from_s = 5.200, to_s = 5.200, every = 8 })");
}

TEST(Minimise, KeepsWhatShowsInNoFlightThatGoesToItsEnd) {
  const std::vector<FaultText> faults{fault("lost", "3", "9")};
  const Minimised least =
      minimise(faults, 5 * second_us, [](const std::vector<FaultText>&, std::int64_t) { return false; });
  EXPECT_EQ(least.faults, faults);
  EXPECT_EQ(least.duration_us, 0);
}

Column column_of(const std::string& name) {
  const std::string file = fmt::format("{}/bench/flights/{}.toml", SOURCE_DIR, name);
  return {.name = name,
          .file = file,
          .folder = SOURCE_DIR "/bench/flights",
          .text = read_text_file(file, "a scenario", 1'000'000).value(),
          .scenario = drive::read_scenario(file).value()};
}

TEST(ScenarioText, IsTheScenarioWithOtherFaultsAndOneCheck) {
  Column column = column_of("los_quick");
  column.settings.push_back({.key = "seeker.latency_ms", .value = "2.0", .elements = {}});
  FaultText lost = fault("lost", "1", "2");
  lost.set("messages", "[\"SeekerAngles\"]");
  const auto in_memory = scenario_of(column, 2, {lost}, 5 * second_us);
  ASSERT_TRUE(in_memory) << in_memory.error().message;
  const std::string text = text_of(column, 2, {lost}, 5 * second_us, "honest", "# why\n");
  EXPECT_THAT(text, testing::StartsWith("# why\n"));
  const auto kept = drive::parse_scenario(text, column.file);
  ASSERT_TRUE(kept) << kept.error().message;
  for (const scenario::Scenario* one : {&*in_memory, &*kept}) {
    EXPECT_EQ(one->seed, column.scenario.seed + 2);
    EXPECT_EQ(one->duration_us, 5 * second_us);
    EXPECT_EQ(one->node("seeker")->latency_us(), 2000) << "values of the variant stay";
    ASSERT_EQ(one->faults.size(), 1U);
    EXPECT_EQ(one->faults.front().from_us, second_us);
  }
  ASSERT_EQ(kept->checks.size(), 1U);
  EXPECT_EQ(kept->checks.front().kind, "honest");
  EXPECT_EQ(in_memory->checks.size(), judged_by.size());
}

TEST(ScenarioText, HasTheChecksOfTheCampaignIfOneOfThemIsViolated) {
  Column column = column_of("los_quick");
  column.checks = {R"({ kind = "answers", name = "mine", answers_at_least = 1 })"};
  EXPECT_EQ(scenario_of(column, 0, {})->checks.size(), judged_by.size() + 1);
  EXPECT_THAT(text_of(column, 0, {}, 0, "mine", ""), HasSubstr("thermal_noise_radpm2 = 1e-10\n"));
  const auto kept = drive::parse_scenario(text_of(column, 0, {}, 0, "mine", ""), column.file);
  ASSERT_TRUE(kept) << kept.error().message;
  ASSERT_EQ(kept->checks.size(), 1U);
  EXPECT_EQ(kept->checks.front().name, "mine");
  EXPECT_TRUE(kept->faults.empty());
}

// Every shipped scenario flies the same from its edited text in another folder.
TEST(ScenarioText, OfEachScenarioIsReadInAnotherFolder) {
  for (const auto& entry : std::filesystem::directory_iterator(SOURCE_DIR "/bench/flights")) {
    if (entry.path().extension() != ".toml") continue;
    const Column column = column_of(entry.path().stem().string());
    const auto kept = drive::parse_scenario(text_of(column, 0, {}, 0, "answering", ""), "elsewhere/x.toml");
    ASSERT_TRUE(kept) << column.file << ": " << kept.error().message;
    EXPECT_EQ(kept->duration_us, column.scenario.duration_us);
    EXPECT_EQ(kept->nodes.size(), column.scenario.nodes.size());
  }
}

std::vector<Column> columns(std::initializer_list<const char*> names) {
  std::vector<Column> all;
  for (const char* name : names) all.push_back(column_of(name));
  return all;
}

TEST(Matrix, DependsOnItsSeedAlone) {
  const auto made = [](std::uint64_t seed) {
    return drawn_matrix(columns({"los_quick", "wind_quick"}), seed).value();
  };
  const Matrix one = made(7), same = made(7), other = made(8);
  ASSERT_EQ(one.cells.size(), same.cells.size());
  std::size_t different = 0;
  for (const Cell& cell : one.cells) {
    for (const std::uint64_t run : {0U, 1U}) {
      const auto faults = one.faults_of(cell, run);
      EXPECT_EQ(faults, same.faults_of(cell, run));
      EXPECT_EQ(faults.empty(), cell.row == 0);
      different += faults == other.faults_of(cell, run) ? 0 : 1;
      const auto scenario = scenario_of(one.columns[cell.column], run, faults);
      EXPECT_TRUE(scenario) << scenario.error().message;
    }
  }
  EXPECT_GT(different, one.cells.size());
  EXPECT_EQ(one.rows.front().name(), no_fault);
}

// The drawn matrix contains the faults that work in virtual time on a bus without a bit rate and that have an
// effect.
TEST(Matrix, HasEachKindOnEachNode) {
  const Matrix matrix =
      drawn_matrix(
          columns({"transfer_alignment_quick", "inflight_quick", "inflight_gps", "los_quick", "wind_quick"}),
          1)
          .value();
  std::set<std::string> without_cells, kinds;
  for (std::size_t row = 0; row < matrix.rows.size(); ++row) {
    const bool flown = std::ranges::find(matrix.cells, row, &Cell::row) != matrix.cells.end();
    if (!flown) without_cells.insert(matrix.rows[row].name());
    kinds.insert(matrix.rows[row].fault);
  }
  EXPECT_THAT(without_cells, ElementsAre("invalid fins")) << "fins have no flag";
  std::set<std::string> left_out;
  for (const faults::Listed& one : faults::listed_kinds()) {
    if (!kinds.contains(std::string(one.kind.name))) left_out.emplace(one.kind.name);
  }
  EXPECT_THAT(left_out, ElementsAre("bus_off", "error_frame", "error_passive", "interface_down", "paused",
                                    "restarted", "slowed", "too_long"));
}

}  // namespace
}  // namespace canhil::campaign::matrix
