#include "bench/mapping/read_flags.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

#include "bench/mapping/read_reported.hpp"
#include "bench/scenario/nearest.hpp"
#include "bench/scenario/sensor_name.hpp"

namespace canhil::mapping {
namespace {

using scenario::Section;

std::uint64_t all_bits(const dbc::Signal& signal) {
  return signal.length >= 64 ? std::numeric_limits<std::uint64_t>::max()
                             : (std::uint64_t{1} << signal.length) - 1;
}

// The bits of a raw value with this name in the DBC.
std::uint64_t named_value(Section& section, const std::string& key, const dbc::Signal& signal) {
  const std::string name = section.text(key);
  const auto found = std::ranges::find(signal.values, name, &dbc::ValueName::name);
  if (found != signal.values.end()) return static_cast<std::uint64_t>(found->value) & all_bits(signal);
  std::vector<std::string> names;
  for (const dbc::ValueName& one : signal.values) names.push_back(one.name);
  section.reject(key, fmt::format("{} has no value '{}'", signal.name, name),
                 names.empty() ? "a raw value: the DBC names no values of the signal"
                               : scenario::expected_instead(name, names));
  return 0;
}

ReportedFlag read_state(Section& section, const std::string& name, const dbc::Signal& signal) {
  ReportedFlag flag{.name = name, .signal = &signal, .mask = all_bits(signal)};
  if (section.holds_text(name)) {
    flag.value = named_value(section, name, signal);
  } else if (section.holds_table(name)) {
    Section bit = section.table(name);
    const std::int64_t number = bit.integer("bit", 0);
    if (number >= static_cast<std::int64_t>(signal.length))
      bit.reject("bit", fmt::format("{} has {} bits", signal.name, signal.length),
                 "a bit of the signal, counted from 0, its least significant bit");
    else
      flag.mask = std::uint64_t{1} << static_cast<unsigned>(number);
    bit.finish();
  } else {
    flag.value = static_cast<std::uint64_t>(section.integer(name, 0));
    expect_bits(section, name, signal, *flag.value);
  }
  return flag;
}

}  // namespace

std::vector<ReportedFlag> read_flags(Section& section, const dbc::Message& of,
                                     std::span<const std::string> signs) {
  std::vector<ReportedFlag> flags;
  for (const std::string& key : section.keys()) {
    const dbc::Signal* signal = dbc::find_signal(of, key);
    if (signal == nullptr) {
      section.reject(key, fmt::format("{} has no signal '{}'", of.name, key), "a signal of the message");
      break;
    }
    if (section.holds_text(key)) {
      flags.push_back({.name = section.text(key), .signal = signal, .mask = all_bits(*signal)});
      continue;
    }
    Section states = section.table(key);
    for (const std::string& name : states.keys()) flags.push_back(read_state(states, name, *signal));
    states.finish();
  }
  for (ReportedFlag& flag : flags) {
    if (!scenario::is_name(flag.name))
      section.reject(flag.signal->name, fmt::format("'{}' is no name of a flag", flag.name),
                     "a-z, 0-9 and _, such as imu_b_excluded");
    flag.is_sign = std::ranges::find(signs, flag.name) != signs.end();
  }
  section.finish();
  return flags;
}

}  // namespace canhil::mapping
