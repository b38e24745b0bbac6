// Tests which response to a fault is reported, depending on the flags of the target and the checks of the
// flight.
#include "bench/fault_matrix/response.hpp"
#include "bench/bindings/canhil.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <set>

#include "bench/drive/contract.hpp"
#include "bench/estimators/transfer_alignment/answers.hpp"
#include "bench/fault_matrix/minimise.hpp"
#include "bench/fault_matrix/plan.hpp"
#include "bench/faults/kinds.hpp"
#include "bench/world/motion/rest.hpp"
#include "dbc/files/text_file.hpp"
#include "tests/unit/bench/edited.hpp"

namespace canhil::fault_matrix {
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

TEST(ResponseNames, AreReadBack) {
  for (const Kind kind : {Kind::tolerated, Kind::detected, Kind::ended, Kind::violated, Kind::not_measured})
    EXPECT_EQ(kind_named(name(kind)), kind);
  EXPECT_FALSE(kind_named("liked"));
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

TEST(ScenarioText, IsTheScenarioWithOtherFaultsAndOneCheck) {
  const std::string file = SOURCE_DIR "/bench/flights/los_quick.toml";
  const auto column = read_column(file);
  ASSERT_TRUE(column) << column.error().message;
  FaultText lost = fault("lost", "1", "2");
  lost.set("messages", "[\"SeekerAngles\"]");
  const auto in_memory = scenario_of(*column, 2, {lost}, 5 * second_us);
  ASSERT_TRUE(in_memory) << in_memory.error().message;
  const auto kept =
      drive::parse_scenario(text_of(*column, 2, {lost}, 5 * second_us, "honest", "# why\n"), file);
  ASSERT_TRUE(kept) << kept.error().message;
  for (const scenario::Scenario* one : {&*in_memory, &*kept}) {
    EXPECT_EQ(one->seed, column->scenario.seed + 2);
    EXPECT_EQ(one->duration_us, 5 * second_us);
    ASSERT_EQ(one->faults.size(), 1U);
    EXPECT_EQ(one->faults.front().from_us, second_us);
  }
  ASSERT_EQ(kept->checks.size(), 1U);
  EXPECT_EQ(kept->checks.front().kind, "honest");
  EXPECT_EQ(in_memory->checks.size(), judged_by.size());
  EXPECT_THAT(text_of(*column, 0, {}, 0, "honest", ""), HasSubstr("# towards the missile"))
      << "comments stay";
}

TEST(ScenarioText, LosesTablesWithBracketsAndComments) {
  EXPECT_EQ(
      without_tables("a = 1\n[[check]] # one\nb = [\n  [1, 2],\n]\n[[fault]]\nc = 1\n[check.d]\n[x]\ny = 2\n",
                     {"check"}),
      "a = 1\n[[fault]]\nc = 1\n[x]\ny = 2\n");
}

TEST(Plan, DependsOnItsSeedAlone) {
  const auto columns = [] {
    std::vector<Column> all;
    for (const char* name : {"los_quick", "wind_quick"})
      all.push_back(*read_column(fmt::format("{}/bench/flights/{}.toml", SOURCE_DIR, name)));
    return all;
  };
  const Plan one = made_plan(columns(), 7, 2), same = made_plan(columns(), 7, 2),
             other = made_plan(columns(), 8, 2);
  ASSERT_EQ(one.cells.size(), same.cells.size());
  std::size_t different = 0;
  for (std::size_t i = 0; i < one.cells.size(); ++i) {
    EXPECT_EQ(one.cells[i].faults, same.cells[i].faults);
    different += one.cells[i].faults == other.cells[i].faults ? 0 : 1;
    const auto scenario =
        scenario_of(one.columns[one.cells[i].column], one.cells[i].run, one.cells[i].faults);
    EXPECT_TRUE(scenario) << scenario.error().message;
  }
  EXPECT_GT(different, one.cells.size() / 2);
  EXPECT_EQ(one.rows.front().name(), no_fault);
}

// The default plan contains the faults that work in virtual time on a bus without a bit rate and that have an
// effect.
TEST(Plan, HasEachKindOnEachNode) {
  std::vector<Column> columns;
  for (const char* name :
       {"transfer_alignment_quick", "inflight_quick", "inflight_gps", "los_quick", "wind_quick"})
    columns.push_back(*read_column(fmt::format("{}/bench/flights/{}.toml", SOURCE_DIR, name)));
  const Plan plan = made_plan(std::move(columns), 1, 1);
  std::set<std::string> without_cells, kinds;
  for (std::size_t row = 0; row < plan.rows.size(); ++row) {
    const bool flown = std::ranges::find(plan.cells, row, &Cell::row) != plan.cells.end();
    if (!flown) without_cells.insert(plan.rows[row].name());
    kinds.insert(plan.rows[row].fault);
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
}  // namespace canhil::fault_matrix
