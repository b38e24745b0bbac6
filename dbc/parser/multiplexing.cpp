// Assigns multiplexors to signals, and checks the multiplexing of complete messages.
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "dbc/parser/check.hpp"
#include "dbc/wire/bits.hpp"

namespace canhil::dbc {
namespace {

bool has_multiplexor(const Signal& signal) { return !signal.multiplexed_by.empty(); }

/// True if the signal is multiplexed and the text does not name its multiplexor. This is usual in a message
/// that has only one multiplexor.
bool is_unnamed(const Signal& signal) { return !signal.mux_ranges.empty() && !has_multiplexor(signal); }

void check_type(Findings& findings, const Message& message, const Signal& signal) {
  if (!signal.multiplexor || !(signal.is_float() || signal.is_signed())) return;
  findings.add(Rule::multiplexor_type, signal.at,
               fmt::format("multiplexor {} is {}, expected an unsigned integer", full_name(message, signal),
                           signal.is_float() ? "a float" : "signed"));
}

void check_ranges(Findings& findings, const Message& message, const Signal& signal) {
  const Signal& multiplexor = *find_signal(message, signal.multiplexed_by);
  const std::uint64_t largest = wire::mask(multiplexor.length);
  for (const MuxRange& range : signal.mux_ranges) {
    if (range.last <= largest) continue;
    findings.add(
        Rule::multiplexor_value, signal.at,
        fmt::format("signal {} is present when {} is {}, expected a value of its {} bits: 0..{}",
                    full_name(message, signal), multiplexor.name, range.last, multiplexor.length, largest));
  }
}

bool is_in_a_circle(const Message& message, const Signal& signal) {
  std::size_t depth = 0;
  for (const Signal* above = &signal; has_multiplexor(*above); ++depth) {
    if (depth > message.signals.size()) return true;
    above = find_signal(message, above->multiplexed_by);
  }
  return false;
}

}  // namespace

void resolve_multiplexors(Findings& findings, Message& message, LeftOut& left_out) {
  const auto is_root = [](const Signal& s) { return s.multiplexor && s.mux_ranges.empty(); };
  const auto root = std::ranges::find_if(message.signals, is_root);
  const auto none = message.signals.end();
  const auto second = root == none ? none : std::find_if(root + 1, none, is_root);
  const bool any_unnamed = std::ranges::any_of(message.signals, is_unnamed);
  if (second != none && any_unnamed) {
    findings.add(Rule::second_multiplexor, second->at,
                 fmt::format("message {} has a second multiplexor {}, expected one, or SG_MUL_VAL_ for every "
                             "multiplexed signal",
                             message.name, second->name));
  }
  for (std::size_t i = 0; i < message.signals.size(); ++i) {
    Signal& signal = message.signals[i];
    if (!is_unnamed(signal)) continue;
    if (root == none) {
      findings.add(
          Rule::multiplexor_missing, signal.at,
          fmt::format("signal {} is multiplexed but {} has no multiplexor, expected a signal with the "
                      "indicator M",
                      full_name(message, signal), message.name));
    }
    if (root == none || second != none) {
      left_out[i] = true;
    } else {
      signal.multiplexed_by = root->name;
    }
  }
}

void check_multiplexing(Findings& findings, const Message& message, LeftOut& left_out) {
  for (std::size_t i = 0; i < message.signals.size(); ++i) {
    const Signal& signal = message.signals[i];
    check_type(findings, message, signal);
    if (!has_multiplexor(signal)) continue;
    check_ranges(findings, message, signal);
    if (!is_in_a_circle(message, signal)) continue;
    findings.add(
        Rule::multiplexing_circle, signal.at,
        fmt::format("signal {} is multiplexed in a circle, expected a multiplexor that is always present",
                    full_name(message, signal)));
    left_out[i] = true;
  }
}

void leave_out_multiplexed(Findings& findings, const Message& message, LeftOut& left_out) {
  const auto is_left_out = [&](std::string_view name) {
    const Signal* signal = find_signal(message, name);
    return left_out[static_cast<std::size_t>(signal - message.signals.data())];
  };
  for (bool any = true; any;) {
    any = false;
    for (std::size_t i = 0; i < left_out.size(); ++i) {
      const Signal& signal = message.signals[i];
      if (left_out[i] || !has_multiplexor(signal) || !is_left_out(signal.multiplexed_by)) continue;
      findings.add(Rule::multiplexor_left_out, signal.at,
                   fmt::format("signal {} is multiplexed by {}, which is left out, expected a multiplexor "
                               "that can be decoded",
                               full_name(message, signal), signal.multiplexed_by));
      left_out[i] = any = true;
    }
  }
}

}  // namespace canhil::dbc
