// The common part of all adapters: parameters that tune the estimator.
#pragma once

#include <span>

#include "target/device/adapter.hpp"
#include "target/device/parameter_table.hpp"

namespace canhil::target {

/// An adapter with a parameter table that sets `tuning_`.
template <class Tuning>
class TunedAdapter : public Adapter {
 public:
  using Row = typename ParameterTable<Tuning>::Row;

  messages::ParameterStatus set(messages::Parameter parameter, double value, bool running) override {
    return parameters_.set(tuning_, parameter, value, running);
  }
  [[nodiscard]] std::optional<double> get(messages::Parameter parameter) const final {
    return parameters_.get(parameter);
  }
  [[nodiscard]] std::optional<ParameterRange> range(messages::Parameter parameter) const final {
    return parameters_.range(parameter);
  }

 protected:
  explicit TunedAdapter(std::span<const Row> rows) : parameters_(rows) {}
  void reset_parameters() { parameters_.reset(tuning_); }

  Tuning tuning_;

 private:
  ParameterTable<Tuning> parameters_;
};

}  // namespace canhil::target
