#include "bench/checks/kinds/program.hpp"

#include <fmt/format.h>

#include "bench/checks/evidence.hpp"
#include "bench/processes/command.hpp"
#include "bench/scenario/commands.hpp"
#include "bench/scenario/section.hpp"

namespace canhil::checks {

Program Program::read(scenario::Section& section, const scenario::CheckContext& /*context*/) {
  Program rule;
  rule.command =
      section.text({"command",
                    "The program and its arguments, as in a shell without variables and patterns. "
                    "It runs in the folder of the scenario file; the bench adds two arguments: the "
                    "files with the JSON report and the CSV table of the run."});
  rule.folder = section.beside("");
  constexpr double hour_s = 3600, usual_s = 60;
  rule.within_us = section.time_us({"within_s", "Wall time in which the program must have ended."},
                                   scenario::Limits::above(0, hour_s), usual_s);
  if (rule.command.empty()) return rule;
  auto words = processes::words_of(rule.command);
  if (!words) {
    section.reject("command", words.error());
    return rule;
  }
  rule.words = *std::move(words);
  scenario::may_execute(section, "command", fmt::format("is a program ('{}')", rule.command));
  return rule;
}

Finding Program::judge(const Evidence& /*evidence*/) const {
  return {Outcome::not_measured,
          "its program is asked after single runs only ('hil-bench run')",
          {.text = "a judgement of the program"}};
}

}  // namespace canhil::checks
