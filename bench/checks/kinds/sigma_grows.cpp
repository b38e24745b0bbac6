#include "bench/checks/kinds/sigma_grows.hpp"

#include <fmt/format.h>

#include "bench/checks/evidence.hpp"
#include "bench/checks/kinds/of_tracks.hpp"
#include "bench/scenario/rule.hpp"

namespace canhil::checks {

SigmaGrows SigmaGrows::read(scenario::Section& section, const scenario::CheckContext& context) {
  SigmaGrows rule;
  rule.of = read_subject(section, context, [](const quantities::Quantity& quantity) {
    return quantity.degrees_of_freedom == 0 && !quantity.white && quantity.parts.empty();
  });
  if (const auto fault = read_fault(section, context)) {
    for (const std::string_view key : {"from_s", "to_s"})
      section.refuse(key, "has no effect beside fault", "one of the two");
    rule.fault = fault->fault;
    rule.window = {.from_us = fault->valid_from_us, .to_us = fault->window.to_us};
  } else {
    rule.window = scenario::read_window(section, context.duration_us);
  }
  rule.by = section.plain_number(
      {"by", "The last sigma of the window is more than so many times the last one before it."},
      scenario::Limits::at_least(1), 1);
  return rule;
}

Finding SigmaGrows::judge(const Evidence& evidence) const {
  const std::string expected =
      fmt::format("sigma grows to more than {:g} times {}", by,
                  fault.empty() ? seconds(window) : fmt::format("through fault '{}'", fault));
  const auto tracks = tracks_of(evidence, of.estimator, *of.quantity);
  if (tracks.empty()) return {Outcome::fail, "nothing to be judged against", expected};
  // The last that was told before the window began is what it grows from.
  std::optional<double> first, last;
  std::size_t inside = 0;
  for (const quantities::Told& told : tracks.front()->told) {
    if (!told.sigma || told.t_us > window.to_us) continue;
    if (told.t_us <= window.from_us || !first) first = told.sigma;
    last = told.sigma;
    if (told.t_us > window.from_us) ++inside;
  }
  if (inside == 0) return {Outcome::fail, "no sigma is told in it", expected};
  const quantities::Unit& unit = of.quantity->unit;
  const int digits = digits_of(unit);
  return {pass_if(*last > by * *first),  // what is no number is not larger
          fmt::format("{:.{}f} to {:.{}f} {}", *first / unit.factor, digits, *last / unit.factor, digits,
                      unit.name),
          expected};
}

}  // namespace canhil::checks
