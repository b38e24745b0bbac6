#include "bench/partners/interventions.hpp"

#include <fmt/format.h>

#include <utility>

namespace canhil::partners {

void Interventions::note(std::string_view by, std::int64_t t_us, std::string what) {
  constexpr std::size_t most = 20;
  if (++count_ <= most)
    notes_.push_back(fmt::format("t={:.3f} s: '{}' {}", 1e-6 * static_cast<double>(t_us), by, what));
}

std::vector<std::string> Interventions::notes() const {
  std::vector<std::string> notes = notes_;
  if (count_ > notes_.size())
    notes.push_back(fmt::format("partners changed {} further things in the run", count_ - notes_.size()));
  for (const auto& [by, steps] : missed_)
    notes.push_back(fmt::format("'{}' was not ready for {} of its steps", by, steps));
  return notes;
}

Result<void> Interventions::fault(std::string_view by, std::string_view name, bool begins,
                                  std::int64_t t_us) {
  const auto changed = fault_(name, begins, t_us);
  if (!changed) return tl::unexpected(changed.error());
  if (*changed) note(by, t_us, fmt::format("{} the fault '{}'", begins ? "began" : "ended", name));
  return {};
}

Result<std::pair<const sensors::Kind*, sensors::Place>> Interventions::place(std::string_view value) const {
  const std::size_t point = value.find('.');
  const std::string_view sensor = value.substr(0, point);
  const scenario::NodeSettings* node = scenario_.node(sensor);
  if (node == nullptr || point == std::string_view::npos)
    return failure(fmt::format("'{}' is no value of a sensor of the run, expected SENSOR.VALUE", value));
  const sensors::Kind& kind = *node->table().sensor;
  const std::string_view name = value.substr(point + 1);
  const auto found = sensors::place_of(kind.outputs, name);
  if (!found) return failure(fmt::format("sensor '{}' has no value '{}'", sensor, name));
  return std::pair(&kind, *found);
}

Result<void> Interventions::set(std::string_view by, std::string_view value, double to, std::int64_t t_us) {
  const auto where = place(value);
  if (!where) return tl::unexpected(where.error());
  const auto [at, is_new] = overrides_.values.insert_or_assign(*where, to);
  if (is_new) note(by, t_us, fmt::format("set {} to {:g}", value, to));
  return {};
}

Result<void> Interventions::release(std::string_view by, std::string_view value, std::int64_t t_us) {
  const auto where = place(value);
  if (!where) return tl::unexpected(where.error());
  if (overrides_.values.erase(*where) > 0) note(by, t_us, fmt::format("released {}", value));
  return {};
}

void Interventions::stop(std::string_view by, std::string_view why, std::int64_t t_us) {
  note(by, t_us, fmt::format("ended the run: {}", why));
  stop_(fmt::format("'{}' ended the run at {:g} s: {}", by, 1e-6 * static_cast<double>(t_us), why));
}

}  // namespace canhil::partners
