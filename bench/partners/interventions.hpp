// What a partner changes in a run: faults that wait for commands, values of sensors, the end of the run.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "bench/scenario/scenario.hpp"
#include "bench/sensors/overrides.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::partners {

class Interventions {
 public:
  /// Begins or ends a fault. Returns whether it was not so before; an error, one phrase, if there is none.
  using FaultCommand = std::function<Result<bool>(std::string_view name, bool begins, std::int64_t t_us)>;

  /// `overrides` and `scenario` must outlive this object. `stop` ends the run, with a reason.
  Interventions(FaultCommand fault, sensors::Overrides& overrides, const scenario::Scenario& scenario,
                std::function<void(std::string why)> stop)
      : fault_(std::move(fault)), overrides_(overrides), scenario_(scenario), stop_(std::move(stop)) {}

  // `by`: name of the partner. Error, one phrase: there is no such fault, sensor or value.
  Result<void> fault(std::string_view by, std::string_view name, bool begins, std::int64_t t_us);
  /// Replaces a value of a sensor's samples, SENSOR.VALUE in SI, or a validity flag, SENSOR.valid.FLAG, until
  /// release().
  Result<void> set(std::string_view by, std::string_view value, double to, std::int64_t t_us);
  Result<void> release(std::string_view by, std::string_view value, std::int64_t t_us);
  void stop(std::string_view by, std::string_view why, std::int64_t t_us);

  /// In real time, a partner had not answered a step when the next was due.
  void missed(const std::string& by) { ++missed_[by]; }

  /// One line for each change, the first of many, and for each partner that missed steps.
  [[nodiscard]] std::vector<std::string> notes() const;

 private:
  Result<std::pair<const sensors::Kind*, sensors::Place>> place(std::string_view value) const;
  void note(std::string_view by, std::int64_t t_us, std::string what);

  FaultCommand fault_;
  sensors::Overrides& overrides_;
  const scenario::Scenario& scenario_;
  std::function<void(std::string)> stop_;
  std::vector<std::string> notes_;
  std::size_t count_ = 0;
  std::map<std::string, std::uint64_t> missed_;
};

}  // namespace canhil::partners
