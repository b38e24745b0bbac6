#include "bench/mapping/reading.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace canhil::mapping {

bool is_multiplexed(const dbc::Message& message) {
  return std::ranges::any_of(message.signals, &dbc::Signal::multiplexor);
}

bool says_invalid(const dbc::Signal& signal, const std::optional<std::uint64_t>& invalid,
                  std::span<const std::uint8_t> data) {
  return invalid && dbc::raw_bits(signal, data) == *invalid;
}

std::optional<world::Euler> angles_in(const Hear& hear, std::span<const std::uint8_t> data,
                                      std::span<const double> values) {
  const ReportedQuaternion& of = *hear.quaternion;
  std::array<double, 4> q{};
  for (std::size_t i = 0; i < q.size(); ++i) {
    const std::size_t number = hear.of.number(*of.parts[i]);
    const bool present = hear.of.plan.is_present(number, data);
    if (!present || says_invalid(*of.parts[i], of.invalid[i], data)) return std::nullopt;
    q[i] = values[number] * of.factors[i];
  }
  const Eigen::Quaterniond quaternion(q[0], q[1], q[2], q[3]);
  constexpr double least = 0.5;
  if (!(quaternion.norm() > least)) return std::nullopt;
  return world::euler_from(quaternion.normalized().toRotationMatrix());
}

std::optional<bool> state_of(const Hear& hear, const ReportedFlag& flag,
                             std::span<const std::uint8_t> bytes) {
  if (!hear.of.plan.is_present(hear.of.number(*flag.signal), bytes)) return std::nullopt;
  return flag.is_set(dbc::raw_bits(*flag.signal, bytes));
}

}  // namespace canhil::mapping
