#include "bench/faults/when.hpp"

#include "bench/scenario/rule.hpp"
#include "bench/scenario/section.hpp"

namespace canhil::faults {
namespace {

using scenario::Limits;

constexpr double longest_s = 86'400;
constexpr std::int64_t longest_us = 86'400'000'000;

// The key `when`: a fault that begins in the run.
void read_trigger(scenario::Section& section, When& when) {
  constexpr std::string_view meaning =
      "The fault begins when this expression over the truth is not 0 for the first time (\"plant.range < "
      "1000\"), or by a command (`when = \"command\"`). In place of `from_s` and `to_s`; `for_s` is then its "
      "duration.";
  const std::string text = section.text({"when", meaning}, "");
  if (text.empty()) return;
  when.from_us = Trigger::never_us;
  for (const std::string_view key : {"from_s", "to_s", "each_s"})
    section.refuse(key, "has no effect beside 'when'", "one of the two");
  if (text == "command")
    when.on_command = true;
  else
    when.condition = scenario::read_expression(section, "when", meaning);
  when.lasts_us = section.optional_time_us({"for_s", "Duration of the fault."}, Limits::above(0))
                      .value_or(Trigger::never_us);
}

void read_periods(scenario::Section& section, When& when) {
  const auto for_us = section.optional_time_us(
      {"for_s", "Duration of the fault, in place of `to_s`. With `each_s`: duration of each repetition."},
      Limits::above(0));
  const auto each_us = section.optional_time_us(
      {"each_s",
       "Time from the start of one repetition of the fault to the start of the next. Without this key the "
       "fault does not repeat. Only together with `for_s`."},
      Limits::above(0));
  if (each_us && !for_us) section.reject("each_s", "is given alone", "for_s beside it");
  if (!for_us) return;
  if (each_us) {
    if (*for_us > *each_us) section.reject("for_s", "is longer than each_s", "a shorter time");
    when.for_us = *for_us;
    when.each_us = *each_us;
    return;
  }
  if (section.has("to_s")) section.reject("for_s", "is given beside to_s", "one of the two, or each_s too");
  when.to_us = when.from_us + *for_us;
}

void read_times(scenario::Section& section, const scenario::FaultContext& context, When& when) {
  when.from_us = section.time_us({"from_s", "Time of transmission at which the fault begins."},
                                 Limits::between(0, longest_s), 0);
  when.to_us =
      section
          .optional_time_us(
              {"to_s", "Time of transmission at which the fault ends; by default the end of the run."},
              Limits::between(0, longest_s))
          .value_or(longest_us);
  scenario::expect_within_run(section, "from_s", when.from_us, context.duration_us);
  if (when.to_us < when.from_us) section.reject("to_s", "is before from_s", "a later time");
  read_periods(section, when);
}

}  // namespace

When read_when(scenario::Section& section, const scenario::FaultContext& context, Repeats repeats) {
  When when;
  read_trigger(section, when);
  if (!section.has("when")) read_times(section, context, when);
  if (repeats == Repeats::stretch) return when;
  when.every = section
                   .optional_integer(
                       {"every",
                        "A number N: the fault affects only the first of every N frames of a message, or the "
                        "first of every N samples. Default: 1, so the fault affects every frame or sample."},
                       1)
                   .value_or(1);
  when.share =
      0.01 *
      section.plain_number(
          {"percent", "Probability with which the fault affects a frame or sample that `every` selects."},
          Limits::between(0, 100), 100);
  return when;
}

When read_stretches(scenario::Section& section, const scenario::FaultContext& context) {
  const When when = read_when(section, context, Repeats::stretch);
  if (!section.has("for_s")) {
    section.missing("for_s", "how long it lasts");
    return when;
  }
  if (when.begins_in_run()) return when;
  const std::int64_t end_us = when.each_us == 0 ? when.to_us : when.from_us + when.for_us;
  if (end_us >= context.duration_us)
    section.reject("for_s", "lasts to the end of the run or longer", "an end before that of the run");
  return when;
}

}  // namespace canhil::faults
