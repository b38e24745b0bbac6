#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/commands/exit_code.hpp"
#include "bench/commands/interrupt.hpp"
#include "bench/commands/program.hpp"
#include "bench/commands/progress_line.hpp"
#include "bench/commands/subcommands.hpp"
#include "bench/drive/contract.hpp"
#include "bench/drive/inputs.hpp"
#include "bench/drive/session.hpp"
#include "bench/drive/target_command.hpp"
#include "bench/observe/divergence.hpp"
#include "bench/processes/command.hpp"
#include "bench/report/file.hpp"
#include "bench/scenario/binding.hpp"
#include "dbc/files/command_files.hpp"
#include "dbc/files/text_file.hpp"

namespace canhil::commands {
namespace {

namespace fs = std::filesystem;

// The arguments as given on the command line.
struct Arguments {
  std::string folder;
  std::vector<std::string> scenarios;
  std::string target = processes::quoted_word(own_folder() + "/hil-target");
  std::optional<std::uint64_t> tolerance;
  std::string json;
};

// The stored files of a flight: the scenario, and the log of every frame.
struct Golden {
  fs::path scenario, log;
  [[nodiscard]] std::string name() const { return scenario.stem().string(); }
};
Golden golden(const fs::path& folder, const fs::path& scenario) {
  const std::string name = scenario.stem().string();
  return {.scenario = folder / (name + ".toml"), .log = folder / (name + ".log")};
}

// A scenario that can be kept. The frames of a target with a mapping have neither a time base nor values that
// observe::compare() knows.
Result<scenario::Scenario> keepable(Result<scenario::Scenario> read, const std::string& file) {
  if (read && !read->binding->time_base)
    return failure(
        fmt::format("{}: has a mapping, expected a scenario for a target with canhil's DBC", file));
  return read;
}

// The log of the flight that `golden check` compares with the stored log.
fs::path checked_log(const Golden& kept) { return fs::path(kept.log).replace_extension(".check.log"); }

// Flies in lockstep on a private bus. Returns an Error of one line if the flight was not completed.
Result<void> fly(const scenario::Scenario& scenario, const Arguments& arguments, const fs::path& log) {
  drive::Options options = drive::in_lockstep_against(arguments.target);
  options.log_path = log.string();
  options.format = drive::format_of(scenario);
  const ProgressLine line;
  const auto run = drive::run(scenario, options, interrupted, [&](std::int64_t t_us) {
    line.show([&] { return fmt::format("{} {:.0f} s", scenario.title, 1e-6 * static_cast<double>(t_us)); });
  });
  if (!run) return tl::unexpected(run.error());
  if (run->log_error) return tl::unexpected(*run->log_error);
  if (run->ending.kind != drive::Ending::Kind::completed)
    return failure(fmt::format("{}: {}", scenario.file, run->ending.detail));
  return {};
}

ExitCode record(const Arguments& arguments) {
  const fs::path folder = arguments.folder;
  std::vector<std::string> names, texts;
  std::vector<scenario::Scenario> scenarios;
  for (const std::string& scenario : arguments.scenarios) {
    const Golden kept = golden(folder, scenario);
    auto text = read_text_file(scenario, "a scenario file", scenario::most_toml_bytes);
    if (!text) return complain(text.error());
    auto read = keepable(drive::parse_scenario(*text, scenario), scenario);
    if (!read) return complain(read.error());
    if (read->recordings_hash != 0)
      return complain(
          {fmt::format("{}: uses recordings, which are not kept with it, expected a scenario "
                       "without 'recorded'",
                       scenario)});
    std::error_code unknown;
    if (std::ranges::find(names, kept.name()) != names.end())
      return complain({fmt::format("scenario '{}': is named twice, expected each name once", kept.name())});
    if (fs::exists(kept.scenario, unknown) || fs::exists(kept.log, unknown))
      return complain({fmt::format("{}: exists already, expected a folder without it", kept.log.string())});
    names.push_back(kept.name());
    scenarios.push_back(std::move(*read));
    texts.push_back(std::move(*text));
  }
  CommandFiles files;
  files.reads(drive::inputs_of_target(arguments.target));
  for (const scenario::Scenario& scenario : scenarios) {
    files.reads(drive::inputs_of(scenario));
    files.may_write("FOLDER", golden(folder, scenario.file).scenario.string());
    files.may_write("FOLDER", golden(folder, scenario.file).log.string());
  }
  if (auto distinct = files.check_distinct(); !distinct) return complain(distinct.error());
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return complain({fmt::format("{}: cannot be a folder: {}", folder.string(), error.message())});
  for (std::size_t i = 0; i < scenarios.size(); ++i) {
    const scenario::Scenario& scenario = scenarios[i];
    const Golden kept = golden(folder, scenario.file);
    if (auto flown = fly(scenario, arguments, kept.log); !flown) {
      fs::remove(kept.log, error);
      return end_with(flown.error());
    }
    if (auto copied = report::write_file(kept.scenario.string(), texts[i]); !copied)
      return complain(copied.error());
    fmt::print("recorded {}\n", one_line(kept.log.string()));
  }
  return ExitCode::pass;
}

// The first difference between the new answers and the stored answers; empty if there is none.
std::string difference(const observe::Comparison& comparison) {
  if (!comparison.first) return {};
  const observe::Divergence& first = *comparison.first;
  const std::string where = fmt::format("at t={:.3f} s after {} frames: ", first.t_s, comparison.compared);
  if (!first.a) return where + "recorded no more, now " + observe::describe(first.b->frame);
  if (!first.b) return where + "now no more, recorded " + observe::describe(first.a->frame);
  if (!first.signal.empty()) return where + first.signal;
  return where + fmt::format("recorded {}, now {}", observe::describe(first.a->frame),
                             observe::describe(first.b->frame));
}

ExitCode check(const Arguments& arguments) {
  const fs::path folder = arguments.folder;
  std::vector<fs::path> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  }
  if (error) return complain({fmt::format("{}: cannot be read: {}", folder.string(), error.message())});
  if (files.empty())
    return complain({fmt::format("{}: has no scenario, expected what golden record made", folder.string())});
  std::ranges::sort(files);
  std::vector<scenario::Scenario> scenarios;
  for (const fs::path& file : files) {
    auto read = keepable(drive::read_scenario(file), file);
    if (!read) return complain(read.error());  // the input file is wrong, not the target
    scenarios.push_back(std::move(*read));
  }
  CommandFiles named;
  named.reads(drive::inputs_of_target(arguments.target));
  for (const scenario::Scenario& scenario : scenarios) {
    const Golden kept = golden(folder, scenario.file);
    named.reads(drive::inputs_of(scenario));
    named.reads("golden log", kept.log.string());
    named.may_write("log of the check", checked_log(kept).string());
  }
  named.writes("--json", arguments.json);
  if (auto fine = named.check(); !fine) return complain(fine.error());
  auto results = nlohmann::ordered_json::array();
  bool same = true;
  for (const scenario::Scenario& scenario : scenarios) {
    const Golden kept = golden(folder, scenario.file);
    const fs::path log = checked_log(kept);
    std::string what;
    std::size_t frames = 0;
    if (const auto flown = fly(scenario, arguments, log)) {
      const auto comparison = observe::compare(kept.log.string(), log.string(),
                                               static_cast<double>(arguments.tolerance.value_or(0)));
      if (!comparison) return complain(comparison.error());
      frames = comparison->compared;
      what = difference(*comparison);
    } else if (interrupted) {
      fs::remove(log, error);
      return end_interrupted();
    } else {
      what = flown.error().message;
    }
    if (what.empty()) fs::remove(log, error);
    if (!what.empty() && fs::exists(log, error)) what += fmt::format("; all frames in {}", log.string());
    same = same && what.empty();
    results.push_back(
        {{"scenario", kept.name()}, {"outcome", what.empty() ? "pass" : "fail"}, {"frames", frames}});
    if (!what.empty()) results.back()["difference"] = what;
    if (arguments.json == report::to_stdout) continue;
    fmt::print("  {}  {:<24} {}\n", what.empty() ? "PASS" : "FAIL", one_line(kept.name()),
               what.empty() ? fmt::format("{} frames as recorded", frames) : one_line(what));
  }
  if (!arguments.json.empty()) {
    // File names may contain bytes that are not UTF-8; such bytes are replaced.
    const std::string text =
        results.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
    if (auto written = report::write(arguments.json, text); !written) return complain(written.error());
  }
  return same ? ExitCode::pass : ExitCode::fail;
}

}  // namespace

void add_golden(command_line::Command app, int& code) {
  const auto command =
      app.add_subcommand("golden", "keep what a target answers, and find the first answer that changes");
  command.require_subcommands(1, 1);
  const auto add = [&](const char* name, const char* summary, ExitCode (*execute)(const Arguments&)) {
    auto arguments = std::make_shared<Arguments>();
    const auto own = command.add_subcommand(name, summary);
    own.add_option("FOLDER", arguments->folder, "where scenarios and frames are kept").required();
    own.add_option("--target", arguments->target,
                   "program and its arguments, as one word (default: hil-target beside hil-bench)");
    own.on_given([&code, arguments, execute] {
      if (auto fine = drive::check_target(arguments->target); !fine) {
        code = static_cast<int>(complain(fine.error()));
        return;
      }
      catch_interrupts();
      code = static_cast<int>(execute(*arguments));
    });
    return std::pair(own, arguments);
  };
  const auto [recording, recorded] = add("record", "fly scenarios in lockstep and keep every frame", record);
  recording.add_option("SCENARIO", recorded->scenarios, "scenario files (TOML)").required();
  const auto [checking, checked] = add("check", "fly them again and compare the target's frames", check);
  checking.add_number("--tolerance", checked->tolerance,
                      "steps of its resolution by which a signal may be off (default: 0, no bit)", 0,
                      1'000'000);
  checking.add_option("--json", checked->json, "also as JSON, to a file; -: to stdout, in place of the text");
}

}  // namespace canhil::commands
