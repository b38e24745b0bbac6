#include <fmt/format.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "bench/commands/exit_code.hpp"
#include "bench/commands/interrupt.hpp"
#include "bench/commands/progress_line.hpp"
#include "bench/commands/run_many.hpp"
#include "bench/commands/run_options.hpp"
#include "bench/commands/subcommands.hpp"
#include "bench/doctor/interface.hpp"
#include "bench/drive/kept_frames.hpp"
#include "bench/live/terminal.hpp"
#include "bench/report/program_checks.hpp"

namespace canhil::commands {
namespace {

// A text such as "[===   ] 7.3 / 20 s".
std::string progress_text(std::int64_t t_us, std::int64_t duration_us) {
  const double t_s = 1e-6 * static_cast<double>(t_us), duration_s = 1e-6 * static_cast<double>(duration_us);
  return fmt::format("{} {:.1f} / {:g} s", progress_bar(t_s / duration_s), t_s, duration_s);
}

void remove_earlier(const RunArguments& arguments) {
  remove_earlier(arguments.reports);
  std::error_code ignored;
  std::filesystem::remove(arguments.log, ignored);
}

// Appends the state of the controller to an error: if the bit rates of the nodes differ, or if no other node
// is present, this state explains why nothing is received.
Error with_controller(Error error, const std::string& bus) {
  const auto interface = doctor::find_interface(bus);
  if (!interface) return error;
  for (const doctor::Line& line : doctor::interface_lines(*interface)) {
    if (line.subject == "state" && line.grade != doctor::Grade::good)
      error.message += fmt::format("; {} is {}: {}", bus, line.found, line.remedy);
  }
  return error;
}

// Flies one scenario, and writes its reports.
ExitCode execute(const RunArguments& arguments) {
  auto planned = plan_run(arguments, arguments.scenarios.front());
  if (!planned) return complain(planned.error());
  return fly(arguments, *planned, [](const drive::Run&) { return Result<void>(); });
}

}  // namespace

ExitCode fly(const RunArguments& arguments, PlannedRun& planned,
             const std::function<Result<void>(const drive::Run&)>& then) {
  std::vector<std::unique_ptr<live::Display>> displays;
  if (arguments.terminal) {
    auto terminal = live::open_terminal();
    if (!terminal) return complain(terminal.error());
    displays.push_back(std::move(*terminal));
  }
  auto view = OpenView::open(arguments.live, {.flight = live::flight_of(planned.scenario, planned.options)},
                             std::move(displays));
  if (!view) return complain(view.error());
  if (view->get() != nullptr) planned.options.onlookers.push_back(&view->get()->onlooker());
  const auto kept = frames_for(arguments.reports);
  if (kept) planned.options.onlookers.push_back(kept.get());
  catch_interrupts();
  Result<drive::Run> finished = [&] {
    const ProgressLine line;
    bool begun = false;
    return drive::run(planned.scenario, planned.options, interrupted, [&](std::int64_t t_us) {
      if (!std::exchange(begun, true)) remove_earlier(arguments);
      line.show([&] { return progress_text(t_us, planned.scenario.duration_us); });
    });
  }();
  if (finished) finished->frames = kept;
  if (finished) report::judge_by_programs(planned.scenario, *finished, interrupted);
  if (view->get() != nullptr) {
    if (finished)
      view->get()->show(live::flight_of(planned.scenario, *finished));
    else
      view->get()->show_ended(finished.error().message);
    if (arguments.terminal) view->get()->close();  // the terminal is restored before the report is printed
  }
  if (!finished && interrupted) {
    complain(finished.error());  // this line also names the log of the handshake
    return ExitCode::not_measured;
  }
  if (!finished) return complain(with_controller(finished.error(), arguments.bus));
  if (arguments.realtime.wanted) {
    const std::string warning = realtime::frequency_warning(*finished->host);
    if (!warning.empty()) say(warning);
  }
  if (auto written = write_reports(arguments.reports, planned.scenario, *finished); !written)
    return complain(written.error());
  if (auto written = then(*finished); !written) return complain(written.error());
  view->hold();
  return exit_code(finished->verdict.outcome);
}

void add_run(command_line::Command app, int& code) {
  auto arguments = std::make_shared<RunArguments>();
  const auto command = app.add_subcommand("run", "run scenarios against a target and judge it");
  add_options(command, *arguments);
  command.on_given([&code, arguments] {
    code = static_cast<int>(are_many(*arguments) ? run_many(*arguments) : execute(*arguments));
  });
}

}  // namespace canhil::commands
