// Rules about parameters: their ranges, their read-back, and the times at which parameters may be set.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "bench/conformance/rules.hpp"

namespace canhil::conformance {
namespace {

using namespace messages;

constexpr double far_out = 3e38;                                      // near the largest float
constexpr double nothing = std::numeric_limits<double>::quiet_NaN();  // NaN is outside every range

messages::Parameter named(const Parameter& parameter) {
  return from_name<messages::Parameter>(parameter.name).value_or(messages::Parameter{});
}

// Returns the current value of a parameter; nullopt: the target does not have the parameter. The function
// tries to set NaN: the target refuses this and acknowledges with the current value.
std::optional<double> in_force(Talk& talk, messages::Parameter parameter) {
  const auto ack = talk.set(parameter, nothing);
  if (!ack || ack->status == ParameterStatus::unknown) return std::nullopt;
  return static_cast<double>(ack->value);
}

// Returns a value close to `value` that still differs from `value` when both are rounded to float.
double beside(double value) { return value == 0 ? 1 : value * 1.25; }

std::string read_back(Talk& talk, messages::Parameter parameter) {
  const auto refused = talk.set(parameter, nothing);
  if (!refused) return fmt::format("{}: no ParamAck", name_of(parameter));
  if (refused->status == ParameterStatus::unknown) return "";
  const auto before = static_cast<double>(refused->value);
  if (refused->status != ParameterStatus::out_of_range || std::isnan(before))
    return fmt::format("{} = NaN: {}, {:g} is read back; expected out_of_range and the value in force",
                       name_of(parameter), name_of(refused->status), before);
  double expected = before;
  for (const double value : {before, beside(before), far_out}) {
    const auto ack = talk.set(parameter, value);
    if (!ack) return fmt::format("{}: no ParamAck", name_of(parameter));
    if (ack->status == ParameterStatus::accepted) expected = value;
    if (std::abs(static_cast<double>(ack->value) - expected) > 2e-6 * std::abs(expected))
      return fmt::format("{} = {:g}: {}, {:g} is read back; expected {:g}", name_of(parameter), value,
                         name_of(ack->status), static_cast<double>(ack->value), expected);
  }
  return "";
}

std::string parameters_are_read_back(Subject& subject) {
  if (auto wrong = subject.talk.reset(); !wrong.empty()) return wrong;
  for (const auto parameter : enumerators<messages::Parameter>) {
    if (auto wrong = read_back(subject.talk, parameter); !wrong.empty()) return wrong;
  }
  return "";
}

std::string unnamed_parameters_are_unknown(Subject& subject) {
  if (auto wrong = subject.talk.reset(); !wrong.empty()) return wrong;
  constexpr messages::Parameter nobodys{0xFF};
  static_assert(name_of(nobodys).empty());
  const auto ack = subject.talk.set(nobodys, 1);
  if (!ack) return "a parameter that the DBC does not name: no ParamAck";
  return ack->status == ParameterStatus::unknown
             ? ""
             : fmt::format("a parameter that the DBC does not name: {}, expected unknown",
                           name_of(ack->status));
}

std::string a_reset_brings_them_back(Subject& subject) {
  Talk& talk = subject.talk;
  if (auto wrong = talk.reset(); !wrong.empty()) return wrong;
  for (const auto parameter : enumerators<messages::Parameter>) {
    const auto initial = in_force(talk, parameter);
    if (!initial) continue;
    const auto ack = talk.set(parameter, beside(*initial));
    if (!ack || ack->status != ParameterStatus::accepted) continue;
    if (auto wrong = talk.reset(); !wrong.empty()) return wrong;
    const auto after = in_force(talk, parameter);
    if (after != initial)
      return fmt::format("{}: {:g} after a reset, expected {:g}", name_of(parameter), after.value_or(nothing),
                         *initial);
  }
  return "";
}

// Before the start, the target must accept every value in the range of a parameter and reject values outside
// the range.
std::string takes_its_range(Talk& talk, const Parameter& parameter) {
  const auto expect = [&](double value, ParameterStatus status, double in_force_then) -> std::string {
    const auto ack = talk.set(named(parameter), value);
    if (!ack) return fmt::format("{} = {:g}: no answer", parameter.name, value);
    if (ack->status == status &&
        std::abs(static_cast<double>(ack->value) - in_force_then) <= 2e-6 * std::abs(in_force_then))
      return "";
    return fmt::format("{} = {:g}: {}, {:g} is read back; expected {}, {:g}", parameter.name, value,
                       name_of(ack->status), static_cast<double>(ack->value), name_of(status), in_force_then);
  };
  const double width = parameter.most - parameter.least;
  const double inside =
      parameter.whole ? std::floor(parameter.least + width / 2) : parameter.least + 0.3 * width;
  const double beyond = parameter.whole ? 1 : std::max(0.01 * width, 1e-3 * std::abs(parameter.most));
  // On the bus, the limits of the range are rounded to float. Therefore the test uses values slightly inside
  // the limits.
  const double low = parameter.whole ? parameter.least : parameter.least + 1e-6 * width;
  const double high = parameter.whole ? parameter.most : parameter.most - 1e-6 * width;
  for (const double value : {low, high, inside}) {
    if (auto wrong = expect(value, ParameterStatus::accepted, value); !wrong.empty()) return wrong;
  }
  for (const double value : {parameter.most + beyond, parameter.least - beyond, nothing}) {
    if (auto wrong = expect(value, ParameterStatus::out_of_range, inside); !wrong.empty()) return wrong;
  }
  if (!parameter.whole) return "";
  return expect(parameter.least + 0.5, ParameterStatus::out_of_range, inside);
}

std::string parameters_have_ranges(Subject& subject) {
  if (auto wrong = subject.talk.reset(); !wrong.empty()) return wrong;
  for (const Parameter& parameter : subject.parameters) {
    if (auto wrong = takes_its_range(subject.talk, parameter); !wrong.empty()) return wrong;
  }
  return "";
}

std::string other_parameters_are_unknown(Subject& subject) {
  if (auto wrong = subject.talk.reset(); !wrong.empty()) return wrong;
  for (const auto value : enumerators<messages::Parameter>) {
    const std::string name(name_of(value));
    const bool own =
        std::ranges::find(subject.parameters, name, &Parameter::name) != subject.parameters.end();
    const auto ack = subject.talk.set(value, 1);
    if (!ack) return name + ": no answer";
    if (own == (ack->status == ParameterStatus::unknown))
      return fmt::format("{}: {}", name, name_of(ack->status));
  }
  return "";
}

std::string parameters_hold_in_flight(Subject& subject) {
  if (auto wrong = flies(subject); !wrong.empty()) return wrong;
  for (const Parameter& parameter : subject.parameters) {
    const double value =
        parameter.whole ? parameter.least : parameter.least + 0.5 * (parameter.most - parameter.least);
    const auto ack = subject.talk.set(named(parameter), value);
    if (!ack) return parameter.name + ": no answer";
    const auto status = parameter.in_flight ? ParameterStatus::accepted : ParameterStatus::wrong_state;
    if (ack->status != status)
      return fmt::format("{} in flight: {}, expected {}", parameter.name, name_of(ack->status),
                         name_of(status));
  }
  return "";
}

// Flies the same flight twice. In the second flight, the test changes a parameter.
std::string parameters_take_effect_in_flight(Subject& subject) {
  std::vector<Frame> without;
  const auto parameter = from_name<messages::Parameter>(subject.apply->first);
  for (const bool with : {false, true}) {
    if (auto wrong = flies(subject); !wrong.empty()) return wrong;
    if (with && parameter) subject.talk.set(*parameter, subject.apply->second);
    subject.talk.fly(8 * some_flight_us);
    if (!with) without = subject.talk.answers();
  }
  return subject.talk.answers() == without ? fmt::format("{} = {:g} in flight: the answers stay the same",
                                                         subject.apply->first, subject.apply->second)
                                           : "";
}

constexpr Rule all[] = {
    {"P-READ-BACK", "parameters",
     "ParamAck says what became of a value and which one is in force; NaN is out of every range.",
     parameters_are_read_back},
    {"P-UNNAMED", "parameters", "A parameter that the DBC does not name is unknown.",
     unnamed_parameters_are_unknown},
    {"P-INITIAL", "parameters", "A reset brings the parameters back to their initial values.",
     a_reset_brings_them_back},
    {"P-RANGE", "parameters",
     "Each parameter takes its whole range and reads it back; a value beyond it, or a fraction where a whole "
     "number "
     "is due, is refused, and the value in force is reported.",
     parameters_have_ranges, Needs::parameters},
    {"P-UNKNOWN", "parameters", "A parameter of another estimator is unknown.", other_parameters_are_unknown,
     Needs::parameters},
    {"P-HOLD", "parameters", "In flight, parameters that may not change are refused.",
     parameters_hold_in_flight, Needs::parameters},
    {"P-EFFECT", "parameters", "A parameter that may be set in flight takes effect there.",
     parameters_take_effect_in_flight, Needs::apply},
};

}  // namespace

std::span<const Rule> parameter_rules() { return all; }

}  // namespace canhil::conformance
