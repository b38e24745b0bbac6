// A check of how a true value follows its setpoint: the closed loop of the target and a plant.
#pragma once

#include <string>

#include "bench/checks/rule.hpp"

namespace canhil::world {
struct TruthValue;
}

namespace canhil::checks {

struct Response {
  static constexpr std::string_view kind = "response";
  static constexpr std::string_view meaning =
      "Passes when a true value reaches its setpoint soon enough (`settling_time`), goes little beyond it "
      "(`overshoot`), or stays near it (`steady_error`).";
  enum class Statistic : std::uint8_t { settling_time, overshoot, steady_error };

  const world::TruthValue* value = nullptr;
  bool turns = false;         ///< an angle
  std::string_view ending{};  ///< of keys with values: "_deg"
  Statistic statistic = Statistic::settling_time;
  double setpoint = 0;  ///< [SI]
  double band = 0;      ///< of the settling time: the largest deviation of a settled value [SI]
  double below = 0;     ///< [s] for the settling time, otherwise [SI]
  scenario::Window window{};

  static Response read(scenario::Section& section, const scenario::CheckContext& context);
  [[nodiscard]] std::string subject() const;
  [[nodiscard]] Finding judge(const Evidence& evidence) const;

 private:
  [[nodiscard]] std::string shown(double in_si) const;
};

}  // namespace canhil::checks
