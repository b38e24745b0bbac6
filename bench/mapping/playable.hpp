// The measured quantities that a mapping may play.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/scenario/section.hpp"
#include "bench/sensors/measurands.hpp"

namespace canhil::mapping {

class Playable {
 public:
  Playable() = default;
  /// `section`: the table [sensors] of a mapping, which names further sensors: `imu_b = "slave_imu"`.
  explicit Playable(std::optional<scenario::Section> section);

  /// The measurand of this name; null if there is none.
  [[nodiscard]] const sensors::Measurand* find(std::string_view name) const;
  [[nodiscard]] std::vector<std::string_view> names() const;
  /// The sensors with names of their own.
  [[nodiscard]] const std::vector<const sensors::Kind*>& named() const { return named_; }

 private:
  std::vector<const sensors::Kind*> named_;
  std::vector<const sensors::Measurand*> all_;
};

}  // namespace canhil::mapping
