#include "bench/accept/dialogue.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "bench/accept/talk.hpp"

namespace canhil::accept {
namespace {

using namespace messages;

constexpr std::int64_t some_flight_us = 500'000;
constexpr double most_told = 8191;  // of TargetCounters, whose counts stay there

struct Rule {
  const char* id;
  const char* text;
  /// What was wrong; empty: nothing.
  std::string (*ask)(Talk& talk, const Suite& suite);
};

std::string said(const std::optional<TargetHeartbeat>& beat) {
  if (!beat) return "no heartbeat";
  return fmt::format("state {}, {} {}, errors: {}", name_of(beat->state), name_of(beat->estimator),
                     name_of(beat->algorithm), observe::errors_of(*beat));
}

std::string refuses_another_contract(Talk& talk, const Suite& /*suite*/) {
  if (auto wrong = talk.make_ready(); !wrong.empty()) return wrong;
  TargetCommand start = talk.command(Command::start);
  start.dbc_hash ^= 1U;
  talk.tell(start);
  const auto beat = talk.hear<TargetHeartbeat>([](const auto& one) { return one.error_dbc_mismatch != 0; });
  if (!beat) return "start with another contract's hash: no heartbeat says dbc_mismatch";
  return beat->state == TargetState::running ? "runs: " + said(beat) : "";
}

std::string starts_only_when_told_its_state(Talk& talk, const Suite& /*suite*/) {
  if (auto wrong = talk.reset(); !wrong.empty()) return wrong;
  talk.tell(talk.command(Command::start));
  const auto beat = talk.hear<TargetHeartbeat>(
      [](const auto& one) { return one.error_not_initialised != 0 || one.state == TargetState::running; });
  if (beat && beat->state != TargetState::running) return "";
  return "start without an initial state: " + said(beat);
}

std::string hears_a_repeated_command(Talk& talk, const Suite& /*suite*/) {
  if (auto wrong = talk.make_ready(); !wrong.empty()) return wrong;
  if (auto wrong = talk.start(); !wrong.empty()) return wrong;
  talk.repeat(talk.command(Command::stop));  // a bench that starts anew may have come to the same counter
  return talk.waits_for(TargetState::idle) ? "" : "a stop with the counter of the start before it: not heard";
}

std::string tells_its_state(Talk& talk, const Suite& /*suite*/) {
  if (auto wrong = talk.reset(); !wrong.empty()) return wrong;
  if (auto wrong = talk.make_ready(); !wrong.empty()) return wrong;
  if (auto wrong = talk.start(); !wrong.empty()) return wrong;
  return talk.fly(some_flight_us) > 0 ? "" : "no answers after the start";
}

std::string stops(Talk& talk, const Suite& suite) {
  if (auto wrong = tells_its_state(talk, suite); !wrong.empty()) return wrong;
  talk.tell(talk.command(Command::stop));
  if (!talk.waits_for(TargetState::idle)) return "stop: its state does not become idle";
  const int answers = talk.fly(2 * some_flight_us);
  return answers == 0 ? "" : fmt::format("{} answers after the stop", answers);
}

std::string starts_again(Talk& talk, const Suite& suite) {
  if (auto wrong = stops(talk, suite); !wrong.empty()) return wrong;
  return tells_its_state(talk, suite);
}

std::string takes_no_state_while_it_runs(Talk& talk, const Suite& suite) {
  if (auto wrong = tells_its_state(talk, suite); !wrong.empty()) return wrong;
  talk.tell_state();
  const auto beat = talk.hear_in_flight<TargetHeartbeat>(some_flight_us);
  if (!beat) return "no heartbeat in flight";
  return beat->state == TargetState::running && beat->error_command != 0
             ? ""
             : "an initial state in flight: " + said(beat);
}

std::string counts_to_the_end(Talk& talk, const Suite& suite) {
  if (auto wrong = tells_its_state(talk, suite); !wrong.empty()) return wrong;
  talk.tell_damaged(static_cast<int>(most_told) + 100);
  const auto told = talk.hear_in_flight<TargetCounters>(some_flight_us);
  if (!told) return "no counters in flight";
  return told->bad_crc == most_told
             ? ""
             : fmt::format("{} damaged frames: {} are told", most_told + 100, told->bad_crc);
}

std::string forgets_its_counts(Talk& talk, const Suite& suite) {
  if (auto wrong = tells_its_state(talk, suite); !wrong.empty()) return wrong;
  talk.tell_damaged(10);
  talk.fly(some_flight_us);
  if (auto wrong = tells_its_state(talk, suite); !wrong.empty()) return wrong;
  const auto told = talk.hear_in_flight<TargetCounters>(some_flight_us);
  if (!told) return "no counters in flight";
  return told->bad_crc == 0 ? ""
                            : fmt::format("after a reset {} frames with a bad CRC are told", told->bad_crc);
}

// What a parameter owes before the start.
std::string takes_its_range(Talk& talk, const Parameter& parameter) {
  const auto expect = [&](double value, ParameterStatus status, double in_force) -> std::string {
    const auto ack = talk.set(parameter.name, value);
    if (!ack) return fmt::format("{} = {:g}: no answer", parameter.name, value);
    if (ack->status == status &&
        std::abs(static_cast<double>(ack->value) - in_force) <= 2e-6 * std::abs(in_force))
      return "";
    return fmt::format("{} = {:g}: {}, {:g} is read back; expected {}, {:g}", parameter.name, value,
                       name_of(ack->status), static_cast<double>(ack->value), name_of(status), in_force);
  };
  const double width = parameter.most - parameter.least;
  const double inside =
      parameter.whole ? std::floor(parameter.least + width / 2) : parameter.least + 0.3 * width;
  const double beyond = parameter.whole ? 1 : std::max(0.01 * width, 1e-3 * std::abs(parameter.most));
  // The ends themselves are rounded to the bus's float: a little inside of them.
  const double low = parameter.whole ? parameter.least : parameter.least + 1e-6 * width;
  const double high = parameter.whole ? parameter.most : parameter.most - 1e-6 * width;
  for (const double value : {low, high, inside}) {
    if (auto wrong = expect(value, ParameterStatus::accepted, value); !wrong.empty()) return wrong;
  }
  for (const double value : {parameter.most + beyond, parameter.least - beyond, std::nan("")}) {
    if (auto wrong = expect(value, ParameterStatus::out_of_range, inside); !wrong.empty()) return wrong;
  }
  if (!parameter.whole) return "";
  return expect(parameter.least + 0.5, ParameterStatus::out_of_range, inside);
}

std::string parameters_have_ranges(Talk& talk, const Suite& suite) {
  if (auto wrong = talk.reset(); !wrong.empty()) return wrong;
  for (const Parameter& parameter : suite.parameters) {
    if (auto wrong = takes_its_range(talk, parameter); !wrong.empty()) return wrong;
  }
  return "";
}

std::string other_parameters_are_unknown(Talk& talk, const Suite& suite) {
  if (auto wrong = talk.reset(); !wrong.empty()) return wrong;
  for (const auto value : enumerators<messages::Parameter>) {
    const std::string name(name_of(value));
    const bool own = std::ranges::find(suite.parameters, name, &Parameter::name) != suite.parameters.end();
    const auto ack = talk.set(name, 1);
    if (!ack) return name + ": no answer";
    if (own == (ack->status == ParameterStatus::unknown))
      return fmt::format("{}: {}", name, name_of(ack->status));
  }
  return "";
}

std::string parameters_hold_in_flight(Talk& talk, const Suite& suite) {
  if (auto wrong = tells_its_state(talk, suite); !wrong.empty()) return wrong;
  for (const Parameter& parameter : suite.parameters) {
    const double value =
        parameter.whole ? parameter.least : parameter.least + 0.5 * (parameter.most - parameter.least);
    const auto ack = talk.set(parameter.name, value);
    if (!ack) return parameter.name + ": no answer";
    const auto status = parameter.in_flight ? ParameterStatus::accepted : ParameterStatus::wrong_state;
    if (ack->status != status)
      return fmt::format("{} in flight: {}, expected {}", parameter.name, name_of(ack->status),
                         name_of(status));
  }
  return "";
}

// The same flight twice, once with a parameter set on the way.
std::string parameters_take_effect_in_flight(Talk& talk, const Suite& suite) {
  std::vector<Frame> without;
  for (const bool with : {false, true}) {
    if (auto wrong = tells_its_state(talk, suite); !wrong.empty()) return wrong;
    if (with) talk.set(suite.apply->first, suite.apply->second);
    talk.fly(8 * some_flight_us);
    if (!with) without = talk.answers();
  }
  return talk.answers() == without ? fmt::format("{} = {:g} in flight: the answers stay the same",
                                                 suite.apply->first, suite.apply->second)
                                   : "";
}

constexpr Rule rules[] = {
    {"P-CONTRACT", "A command with another contract's hash is answered with dbc_mismatch and not obeyed.",
     refuses_another_contract},
    {"P-STATE", "The target says idle, ready and running as it is told to, and answers from the start on.",
     tells_its_state},
    {"P-NO-STATE", "An estimator that was given no initial state does not start, and says so.",
     starts_only_when_told_its_state},
    {"P-REPEAT", "A command is heard though its counter is that of the one before.",
     hears_a_repeated_command},
    {"P-STOP", "After a stop nothing is answered.", stops},
    {"P-AGAIN", "After a stop the target is started again.", starts_again},
    {"P-IN-FLIGHT",
     "An initial state that comes in flight changes nothing, and is told as an error of command.",
     takes_no_state_while_it_runs},
    {"P-COUNT", "Counters of losses stay at their end.", counts_to_the_end},
    {"P-RESET", "A reset forgets the counts.", forgets_its_counts},
    {"P-RANGE",
     "Each parameter takes its whole range and reads it back; beyond it, and a fraction where a whole number "
     "is due, is refused, and the value in force is told.",
     parameters_have_ranges},
    {"P-UNKNOWN", "A parameter of another estimator is unknown.", other_parameters_are_unknown},
    {"P-HOLD", "In flight those parameters are refused that may not change.", parameters_hold_in_flight},
    {"P-EFFECT", "A parameter that may be set in flight takes effect there.",
     parameters_take_effect_in_flight},
};

bool asked(const Rule& rule, const Suite& suite) {
  return rule.ask != parameters_take_effect_in_flight || suite.apply.has_value();
}

bool of_parameters(const Rule& rule) {
  const std::string_view id = rule.id;
  return id == "P-RANGE" || id == "P-UNKNOWN" || id == "P-HOLD" || id == "P-EFFECT";
}

}  // namespace

std::vector<Requirement> protocol_requirements(const Suite& suite) {
  std::vector<Requirement> all;
  for (const Rule& rule : rules) {
    if (!asked(rule, suite)) continue;
    all.push_back(
        {.id = rule.id, .family = of_parameters(rule) ? "parameters" : "protocol", .text = rule.text});
  }
  return all;
}

Result<std::vector<Item>> talk(const Suite& suite, const std::string& target, const std::atomic<bool>& stop) {
  std::vector<Item> items;
  auto talk = Talk::open(*suite.dialogue, target);
  if (!talk) return tl::unexpected(talk.error());
  for (const Rule& rule : rules) {
    if (stop) break;
    if (!asked(rule, suite)) continue;
    const std::string wrong = rule.ask(**talk, suite);
    items.push_back({.requirement = rule.id,
                     .name = "dialogue",
                     .outcome = wrong.empty() ? checks::Outcome::pass : checks::Outcome::fail,
                     .measured = wrong.empty() ? "so" : wrong,
                     .expected = rule.text});
  }
  return items;
}

}  // namespace canhil::accept
