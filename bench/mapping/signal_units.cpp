#include "bench/mapping/signal_units.hpp"

#include <fmt/format.h>

#include <utility>

#include "bench/quantities/wire_unit.hpp"

namespace canhil::mapping {

bool SignalUnits::give(const dbc::Signal& signal, std::string unit) {
  const bool known = quantities::wire_unit(unit).has_value();
  given_[&signal] = std::move(unit);
  return known;
}

const std::string& SignalUnits::text_of(const dbc::Signal& signal) const {
  const auto given = given_.find(&signal);
  return given == given_.end() ? signal.unit : given->second;
}

std::string_view SignalUnits::si_of(const dbc::Signal& signal) const {
  const auto unit = quantities::wire_unit(text_of(signal));
  return unit ? unit->si : "";
}

double SignalUnits::factor(scenario::Section& section, std::string_view key, const dbc::Message& of,
                           const dbc::Signal& signal, std::string_view si, std::string_view quantity) const {
  const std::string& text = text_of(signal);
  const auto unit = quantities::wire_unit(text, si);
  const auto expected = [&] {
    return fmt::format("[units] with \"{}.{}\" = one of: {}", of.name, signal.name,
                       quantities::wire_units(si));
  };
  if (!unit && !si.empty())
    section.reject(
        key,
        text.empty() ? "has no unit in the DBC" : fmt::format("has the unit '{}', which is unknown", text),
        expected());
  if (unit && unit->si != si)
    section.reject(key, fmt::format("is in '{}', {} is in {}", text, quantity, si.empty() ? "no unit" : si),
                   expected());
  return unit ? unit->factor : 1;
}

}  // namespace canhil::mapping
