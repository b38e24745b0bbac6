#include "bench/commands/run_many.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>

#include "bench/commands/interrupt.hpp"
#include "bench/commands/selection.hpp"
#include "bench/drive/inputs.hpp"
#include "bench/report/file.hpp"
#include "bench/report/page_parts.hpp"
#include "bench/report/run_reports.hpp"

namespace canhil::commands {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

// A file without a name that a process and its child share; it disappears with them.
using SharedFile = std::unique_ptr<std::FILE, decltype(&std::fclose)>;

struct Job {
  std::string name;        // the file without what all have in common
  RunArguments arguments;  // with the report files of this scenario
  PlannedRun planned{};
  pid_t process = 0;
  int descriptor = -1;  // of the process, while it runs
  SharedFile answer{nullptr, std::fclose}, errors{nullptr, std::fclose};
  ExitCode code = ExitCode::not_measured;
  ordered_json result{};  // "reason", "wall_s" and "suite"; null: the run came to no verdict
  std::string error{};    // what the run printed on stderr
};

std::string content_of(std::FILE* file) {
  std::string content;
  std::array<char, 4096> part{};
  std::rewind(file);
  for (std::size_t got = 0; (got = std::fread(part.data(), 1, part.size(), file)) > 0;)
    content.append(part.data(), got);
  return content;
}

// The names of the scenarios in tables and of their reports: the paths without extension, from the first
// folder on in which they differ, '-' in place of '/'.
std::vector<std::string> names_of(const std::vector<std::string>& files) {
  std::vector<std::vector<std::string>> parts;
  for (const std::string& file : files) {
    const fs::path path = fs::absolute(file).lexically_normal().replace_extension();
    parts.emplace_back();
    for (const fs::path& part : path) parts.back().push_back(part.string());
  }
  std::size_t same = 0;
  const auto all_have = [&](std::size_t at) {
    return std::ranges::all_of(
        parts, [&](const auto& one) { return one.size() > at + 1 && one[at] == parts[0][at]; });
  };
  while (all_have(same)) ++same;
  std::vector<std::string> names;
  for (const auto& one : parts)
    names.push_back(
        fmt::format("{}", fmt::join(one.begin() + static_cast<std::ptrdiff_t>(same), one.end(), "-")));
  return names;
}

Result<void> check(const RunArguments& arguments) {
  for (const auto& [option, value] : {std::pair("--json", arguments.reports.json),
                                      {"--html", arguments.reports.html},
                                      {"--csv", arguments.reports.csv},
                                      {"--log", arguments.log},
                                      {"--control", arguments.control}}) {
    if (!value.empty())
      return failure(
          fmt::format("{}: is one file, and there are several scenarios, expected --out FOLDER", option));
  }
  if (arguments.live.wanted() || arguments.terminal)
    return failure(fmt::format("{}: shows one run, and there are several scenarios, expected one scenario",
                               arguments.terminal ? "--tui" : "--live"));
  const drive::BusName bus(arguments.bus);
  const bool shared = is_external(arguments) || (!bus.in_process && named_local(bus.text, "own") == bus.text);
  if (arguments.at_once.value_or(1) > 1 && shared)
    return failure(
        fmt::format("-j {}: the scenarios would share --bus '{}', expected a private bus (local:, the "
                    "default) and a --target to start, or in-process",
                    *arguments.at_once, arguments.bus));
  return {};
}

// The scenarios that fly, with their options; nothing is written.
Result<std::vector<Job>> plan(const RunArguments& arguments) {
  if (auto fine = check(arguments); !fine) return tl::unexpected(fine.error());
  auto files = scenario_files(arguments.scenarios);
  if (!files) return tl::unexpected(files.error());
  Selects selects = [](std::string_view /*text*/) { return true; };
  if (!arguments.selection.empty()) {
    auto read = selection(arguments.selection);
    if (!read) return failure(fmt::format("-k {}", read.error().message));
    selects = std::move(*read);
  }
  const std::vector<std::string> names = names_of(*files);
  std::vector<Job> jobs;
  for (std::size_t i = 0; i < files->size(); ++i) {
    Job job{.name = names[i], .arguments = arguments};
    if (!arguments.out.empty()) {
      const fs::path stem = fs::path(arguments.out) / job.name;
      job.arguments.reports.json = stem.string() + ".json";
      job.arguments.reports.html = stem.string() + ".html";
      job.arguments.log = stem.string() + ".log";
    }
    job.arguments.reports.junit.clear();
    if (!selects((*files)[i] + "\n" + title_of((*files)[i]))) continue;
    auto planned = plan_run(job.arguments, (*files)[i], static_cast<int>(i) + 1);
    if (!planned) return tl::unexpected(planned.error());
    job.planned = std::move(*planned);
    const auto same = std::ranges::find(jobs, job.name, &Job::name);
    if (same != jobs.end())
      return failure(fmt::format("{}: {} has the same name, expected each scenario once",
                                 job.planned.scenario.file, same->planned.scenario.file));
    jobs.push_back(std::move(job));
  }
  if (jobs.empty())
    return failure(
        fmt::format("-k '{}': none of {} scenarios has this, expected words of their files or titles",
                    arguments.selection, files->size()));
  return jobs;
}

// Runs in the child process: flies, and passes the result on.
ExitCode fly_here(Job& job) {
  if (const int nowhere = open("/dev/null", O_WRONLY); nowhere >= 0) dup2(nowhere, STDOUT_FILENO);
  dup2(fileno(job.errors.get()), STDERR_FILENO);
  return fly(job.arguments, job.planned, [&](const drive::Run& run) -> Result<void> {
    const ordered_json result{{"reason", run.verdict.reason},
                              {"wall_s", run.wall_s},
                              {"suite", report::junit_suite(job.planned.scenario, run)}};
    const std::string text = result.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
    if (std::fwrite(text.data(), 1, text.size(), job.answer.get()) != text.size() ||
        std::fflush(job.answer.get()) != 0)
      return failure("the result of the run cannot be passed on: the disk is full");
    return {};
  });
}

Result<void> start(Job& job) {
  job.answer.reset(std::tmpfile());
  job.errors.reset(std::tmpfile());
  if (!job.answer || !job.errors) return failure("no temporary file can be made, expected space in /tmp");
  std::fflush(nullptr);  // else the child prints it again
  job.process = fork();
  if (job.process == 0) {
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    std::exit(static_cast<int>(fly_here(job)));
  }
  if (job.process > 0) job.descriptor = static_cast<int>(syscall(SYS_pidfd_open, job.process, 0));
  if (job.descriptor < 0) return failure("no process can be started for a scenario");
  return {};
}

void collect(Job& job) {
  int status = 0;
  waitpid(job.process, &status, 0);
  close(job.descriptor);
  job.descriptor = -1;
  job.code = WIFEXITED(status) ? static_cast<ExitCode>(WEXITSTATUS(status)) : ExitCode::usage;
  const std::string answer = content_of(job.answer.get());
  job.error = content_of(job.errors.get());
  if (WIFSIGNALED(status))
    job.error += fmt::format("hil-bench: the run was ended by signal {}\n", WTERMSIG(status));
  if (job.error.empty() && answer.empty()) job.error = "hil-bench: the run came to no verdict\n";
  if (!answer.empty()) job.result = ordered_json::parse(answer, nullptr, false);
  job.answer.reset();
  job.errors.reset();
}

// What is said about a run: the reason of its verdict, or the last line of its errors.
std::string reason_of(const Job& job) {
  if (!job.result.is_null()) return job.result.at("reason").get<std::string>();
  std::string_view error = job.error;
  while (error.ends_with('\n')) error.remove_suffix(1);
  error.remove_prefix(error.rfind('\n') + 1);  // npos + 1 is 0
  constexpr std::string_view prefix = "hil-bench: ";
  if (error.starts_with(prefix)) error.remove_prefix(prefix.size());
  return error.empty() ? "did not fly" : std::string(error);
}

std::string outcome_name(const Job& job) {
  return job.code == ExitCode::usage ? "error" : std::string(checks::name(outcome_of(job.code)));
}

void print(const Job& job, std::size_t width) {
  std::fputs(job.error.c_str(), stderr);
  fmt::print("  {:<12}  {:<{}}  {}{}\n", report::label(outcome_name(job)), job.name, width,
             one_line(reason_of(job)),
             job.result.is_null() ? "" : fmt::format(" ({:.2f} s)", job.result.at("wall_s").get<double>()));
  std::fflush(stdout);
}

// Flies the jobs, at most `at_once` at the same time, and prints each in its turn.
Result<void> fly_all(std::vector<Job>& jobs, std::size_t at_once) {
  std::size_t width = 0, begun = 0, printed = 0;
  for (const Job& job : jobs) width = std::max(width, job.name.size());
  bool passed_on = false;
  while (printed < jobs.size()) {
    std::vector<pollfd> running;
    std::vector<Job*> of;
    for (std::size_t i = printed; i < begun; ++i) {
      if (jobs[i].descriptor < 0) continue;
      running.push_back({.fd = jobs[i].descriptor, .events = POLLIN, .revents = 0});
      of.push_back(&jobs[i]);
    }
    if (interrupted && !std::exchange(passed_on, true))
      for (const Job* job : of) kill(job->process, SIGTERM);
    if (!interrupted && begun < jobs.size() && running.size() < at_once) {
      if (auto started = start(jobs[begun++]); !started) return started;
      continue;
    }
    if (running.empty() && interrupted) return {};
    constexpr int most_ms = 200;  // an interruption just before poll() waits for so long
    poll(running.data(), running.size(), most_ms);
    for (std::size_t i = 0; i < running.size(); ++i) {
      if (running[i].revents != 0) collect(*of[i]);
    }
    for (; printed < begun && jobs[printed].descriptor < 0; ++printed) print(jobs[printed], width);
  }
  return {};
}

std::string counts_of(const std::vector<Job>& jobs) {
  std::map<std::string, int> counts;
  for (const Job& job : jobs) ++counts[outcome_name(job)];
  std::string words;
  for (const auto& [what, word] : {std::pair("pass", "passed"),
                                   {"fail", "failed"},
                                   {"not measured", "not measured"},
                                   {"error", "could not fly"}}) {
    if (counts.contains(what)) words += fmt::format("{}{} {}", words.empty() ? "" : ", ", counts[what], word);
  }
  return words;
}

std::string index_page(const std::vector<Job>& jobs) {
  report::Rows rows;
  for (const Job& job : jobs) {
    const std::string outcome = outcome_name(job);
    const bool flown = !job.result.is_null();
    const std::string title = report::escaped(job.planned.scenario.title);
    rows.push_back(
        {report::outcome_words(outcome == "error" ? "fail" : outcome, outcome),
         flown ? fmt::format("<a href=\"{}.html\">{}</a>", report::escaped(job.name), title) : title,
         report::escaped(job.planned.scenario.file), report::escaped(reason_of(job)),
         flown ? fmt::format("{:.2f}", job.result.at("wall_s").get<double>()) : ""});
  }
  const std::string title = fmt::format("{} scenarios", jobs.size());
  return report::whole_page(title, report::styles,
                            report::head(title, counts_of(jobs)) +
                                report::table({"outcome", "scenario", "file", "reason", "time [s]"}, rows));
}

Result<void> write(const RunArguments& arguments, const std::vector<Job>& jobs) {
  if (!arguments.reports.junit.empty()) {
    std::string suites;
    for (const Job& job : jobs)
      suites += job.result.is_null() ? report::junit_suite_not_run(job.planned.scenario, reason_of(job))
                                     : job.result.at("suite").get<std::string>();
    if (auto written = report::write(arguments.reports.junit, report::junit_whole(suites)); !written)
      return written;
  }
  if (arguments.out.empty()) return {};
  return report::write_file((fs::path(arguments.out) / "index.html").string(), index_page(jobs));
}

// The files of all runs together: an output of one must not be an input or an output of another.
Result<void> check_files(const RunArguments& arguments, const std::vector<Job>& jobs) {
  CommandFiles files;
  for (const Job& job : jobs) {
    files.reads(drive::inputs_of(job.planned.scenario));
    files.may_write("--out", job.arguments.reports.json);
    files.may_write("--out", job.arguments.reports.html);
    files.may_write("--out", job.arguments.log);
  }
  files.writes("--junit", arguments.reports.junit);
  if (!arguments.out.empty()) files.writes_file("--out", (fs::path(arguments.out) / "index.html").string());
  return files.check();
}

}  // namespace

bool are_many(const RunArguments& arguments) {
  std::error_code unknown;
  return arguments.scenarios.size() > 1 || !arguments.out.empty() || !arguments.selection.empty() ||
         arguments.at_once || fs::is_directory(arguments.scenarios.front(), unknown);
}

ExitCode run_many(const RunArguments& arguments) {
  std::error_code error;
  const bool new_folder = !arguments.out.empty() && fs::create_directories(arguments.out, error);
  if (error) return complain({fmt::format("{}: cannot be a folder: {}", arguments.out, error.message())});
  auto jobs = plan(arguments);
  auto fine = jobs ? check_files(arguments, *jobs) : tl::unexpected(jobs.error());
  if (!fine) {
    if (new_folder) fs::remove(arguments.out, error);
    return complain(fine.error());
  }
  for (const Job& job : *jobs) remove_earlier(job.arguments.reports);
  catch_interrupts();
  if (auto flown = fly_all(*jobs, static_cast<std::size_t>(arguments.at_once.value_or(1))); !flown)
    return complain(flown.error());
  if (auto written = write(arguments, *jobs); !written) return complain(written.error());
  if (interrupted) return end_interrupted();
  if (arguments.reports.junit != report::to_stdout) fmt::print("\n{}\n", counts_of(*jobs));
  for (const ExitCode worst : {ExitCode::usage, ExitCode::fail, ExitCode::not_measured}) {
    if (std::ranges::find(*jobs, worst, &Job::code) != jobs->end()) return worst;
  }
  return ExitCode::pass;
}

}  // namespace canhil::commands
