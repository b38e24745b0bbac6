#include "bench/report/program_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "bench/checks/kinds/program.hpp"
#include "bench/checks/result_json.hpp"
#include "bench/processes/command.hpp"
#include "bench/processes/dialogue.hpp"
#include "bench/report/run_reports.hpp"
#include "dbc/files/output_file.hpp"
#include "dbc/files/temporary_folder.hpp"
#include "dbc/text/escape.hpp"

namespace canhil::report {
namespace {

using Json = nlohmann::ordered_json;
using checks::CheckResult;
using checks::Outcome;
using checks::Program;
using std::chrono::steady_clock;
using namespace std::chrono_literals;

// What a program wrote to its standard output until it ended. Error, one phrase.
Result<std::string> output_of(const Program& program, std::vector<std::string> words,
                              const std::atomic<bool>& stop) {
  constexpr std::size_t most_bytes = std::size_t{16} << 20U;
  const auto deadline = steady_clock::now() + std::chrono::microseconds(program.within_us);
  const std::string file = processes::program_path(words.front(), program.folder);
  auto dialogue = processes::Dialogue::start(file, std::move(words), {.folder = program.folder});
  if (!dialogue) return failure(fmt::format("cannot be started ({})", dialogue.error().message));
  dialogue->close_input();
  std::string output;
  bool open = true;
  while (true) {
    if (stop) return failure("was interrupted");
    if (steady_clock::now() >= deadline)
      return failure(fmt::format("did not end within {:g} s", 1e-6 * static_cast<double>(program.within_us)));
    if (open) {
      using enum processes::Dialogue::Outcome;
      open = dialogue->receive(output, std::min(deadline, steady_clock::now() + 100ms), 65'536) != closed;
      if (output.size() > most_bytes) return failure("wrote more than 16 MiB");
      continue;
    }
    if (const auto end = dialogue->process()->ended()) {
      if (end->exited_with_0()) return output;
      return failure(processes::to_text(*end));
    }
    std::this_thread::sleep_for(2ms);
  }
}

// The judgements of a program. Error, one phrase: what it wrote is something else.
Result<std::vector<CheckResult>> judgements_in(const std::string& output, const CheckResult& check) {
  const Json all = Json::parse(output, nullptr, false);
  if (!all.is_array()) return failure("wrote no JSON array of judgements");
  std::vector<CheckResult> results;
  for (const Json& one : all) {
    const auto wrong = [&](std::string_view what) {
      return failure(fmt::format("wrote judgement {}: {}", results.size() + 1, what));
    };
    if (!one.is_object()) return wrong("is no object");
    try {
      const std::string id = one.value("id", ""), outcome = one.value("outcome", "");
      if (id.empty()) return wrong("has no 'id'");
      const auto known = checks::outcome_named(outcome);
      if (!known)
        return wrong(fmt::format("outcome '{}' is unknown, expected pass, fail or not measured", outcome));
      const std::string name = fmt::format("{}: {}", check.name, id);
      if (std::ranges::find(results, name, &CheckResult::name) != results.end())
        return wrong(fmt::format("id '{}' is there twice", id));
      results.push_back({.name = name,
                         .kind = check.kind,
                         .requirement = one.value("requirement", check.requirement),
                         .outcome = *known,
                         .measured = one.value("measured", ""),
                         .expected = one.value("expected", ""),
                         .judgement = checks::judgement_of(one)});
    } catch (const Json::exception& error) {
      return wrong(error.what());
    }
  }
  if (results.empty()) return failure("judged nothing");
  return results;
}

// The reports of a run, as files.
class Reports {
 public:
  static Result<Reports> write(const scenario::Scenario& scenario, const drive::Run& run) {
    auto folder = TemporaryFolder::make("check");
    if (!folder) return tl::unexpected(folder.error());
    Reports reports(std::move(*folder));
    const auto written =
        write_file(reports.json(), [&](const Sink& give) { give(report::json(scenario, run)); });
    if (!written) return tl::unexpected(written.error());
    if (auto table = write_file(reports.csv(), [&](const Sink& give) { report::csv(scenario, run, give); });
        !table)
      return tl::unexpected(table.error());
    return reports;
  }
  [[nodiscard]] std::string json() const { return (folder_->path() / "report.json").string(); }
  [[nodiscard]] std::string csv() const { return (folder_->path() / "run.csv").string(); }

 private:
  explicit Reports(std::unique_ptr<TemporaryFolder> folder) : folder_(std::move(folder)) {}
  std::unique_ptr<TemporaryFolder> folder_;
};

Result<std::vector<CheckResult>> asked(const Program& program, const CheckResult& check,
                                       const Result<Reports>& reports, const std::atomic<bool>& stop) {
  if (!reports) return tl::unexpected(reports.error());
  std::vector<std::string> words = program.words;
  words.push_back(reports->json());
  words.push_back(reports->csv());
  const auto output = output_of(program, std::move(words), stop);
  if (!output) return tl::unexpected(output.error());
  return judgements_in(*output, check);
}

}  // namespace

void judge_by_programs(const scenario::Scenario& scenario, drive::Run& run, const std::atomic<bool>& stop) {
  if (run.ending.kind != drive::Ending::Kind::completed) return;
  const auto program_of = [&](std::size_t index) -> const Program* {
    const checks::Rule* rule = index < scenario.checks.size() ? scenario.checks[index].rule.get() : nullptr;
    const auto* program = dynamic_cast<const checks::RuleOf<Program>*>(rule);
    return program == nullptr ? nullptr : &program->kind();
  };
  std::optional<Result<Reports>> reports;  // of the run as it is before the first program
  std::vector<CheckResult> all;
  for (std::size_t i = 0; i < run.verdict.checks.size(); ++i) {
    CheckResult check = run.verdict.checks[i];
    const Program* program = program_of(i);
    if (program == nullptr) {
      all.push_back(std::move(check));
      continue;
    }
    if (!reports) reports.emplace(Reports::write(scenario, run));
    if (auto judged = asked(*program, check, *reports, stop)) {
      std::ranges::move(*judged, std::back_inserter(all));
    } else {
      check.measured = fmt::format("the program {}", one_line(judged.error().message));
      all.push_back(std::move(check));
    }
  }
  if (!reports) return;
  run.verdict.checks = std::move(all);
  checks::conclude(run.verdict, "");
}

}  // namespace canhil::report
