// The units of the signals of a mapping's DBC.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "bench/scenario/section.hpp"
#include "dbc/parser/database.hpp"

namespace canhil::mapping {

class SignalUnits {
 public:
  /// Gives a signal a unit in place of that of the DBC. False: the unit is unknown.
  bool give(const dbc::Signal& signal, std::string unit);
  /// The SI unit of a signal's unit; empty: none, or unknown.
  [[nodiscard]] std::string_view si_of(const dbc::Signal& signal) const;
  /// The factor from the signal's unit to SI. `si`: the SI unit of the quantity. The section gets an error if
  /// the two do not fit.
  double factor(scenario::Section& section, std::string_view key, const dbc::Message& of,
                const dbc::Signal& signal, std::string_view si, std::string_view quantity) const;

 private:
  [[nodiscard]] const std::string& text_of(const dbc::Signal& signal) const;

  std::map<const dbc::Signal*, std::string> given_;
};

}  // namespace canhil::mapping
