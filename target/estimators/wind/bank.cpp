#include "target/estimators/wind/bank.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace canhil::wind {
namespace {

// Filters that have not started get the weight 0, unless no filter has started.
void weigh(Bank& bank, const BankDesign& design) {
  bank.weight = {};
  std::array<double, bank_most> exponent;
  double largest = -std::numeric_limits<double>::infinity();
  const bool any =
      std::any_of(bank.states.begin(), bank.states.begin() + static_cast<std::ptrdiff_t>(design.count),
                  [](const State& state) { return state.started; });
  for (std::size_t i = 0; i < design.count; ++i) {
    exponent[i] = bank.states[i].started == any ? std::log(design.odds[i]) - bank.surprise[i] / 2
                                                : -std::numeric_limits<double>::infinity();
    largest = std::max(largest, exponent[i]);
  }
  double sum = 0;
  for (std::size_t i = 0; i < design.count; ++i) sum += bank.weight[i] = std::exp(exponent[i] - largest);
  for (std::size_t i = 0; i < design.count; ++i) bank.weight[i] /= sum;
}

std::size_t likeliest(const Bank& bank) {
  return static_cast<std::size_t>(std::max_element(bank.weight.begin(), bank.weight.end()) -
                                  bank.weight.begin());
}

// x - y, with roll and heading in [-pi, pi].
StateVector difference(const StateVector& x, const StateVector& y) {
  StateVector d = x - y;
  for (const int i : {attitude_at, attitude_at + 2}) d(i) = wrapped(d(i));
  return d;
}

void mix(Bank& bank, const BankDesign& design) {
  const State& most = bank.states[likeliest(bank)];
  bank.started = most.started;
  bank.x = most.x;
  if (design.count == 1) {
    bank.P = reported_covariance(most, design.of[0].settings);
    return;
  }
  StateVector mean = StateVector::Zero();
  for (std::size_t i = 0; i < design.count; ++i)
    mean += bank.weight[i] * difference(bank.states[i].x, most.x);
  bank.P.setZero();
  for (std::size_t i = 0; i < design.count; ++i) {
    const StateVector d = difference(bank.states[i].x, most.x) - mean;
    bank.P +=
        bank.weight[i] * (reported_covariance(bank.states[i], design.of[i].settings) + d * d.transpose());
  }
  bank.x += mean;
  for (const int i : {attitude_at, attitude_at + 2}) bank.x(i) = wrapped(bank.x(i));
}

Bank of(const BankDesign& design, const auto& state_of) {
  Bank bank;
  bank.count = design.count;
  for (std::size_t i = 0; i < design.count; ++i) bank.states[i] = state_of(design.of[i]);
  weigh(bank, design);
  mix(bank, design);
  return bank;
}

}  // namespace

BankDesign make_bank(const Settings& settings) {
  BankDesign design;
  design.of[0] = make_design(settings);
  design.odds[0] = 1;
  if (settings.process_noise != ProcessNoise::likeliest) return design;
  Settings gusts = settings;
  gusts.density.wind = std::max(gusts.density.wind, settings.gust_noise);
  design.of[1] = make_design(gusts);
  design.odds[1] = settings.odds_of_gusts;
  design.count = 2;
  return design;
}

Bank initial(const BankDesign& design) {
  return of(design, [](const Design& one) { return initial(one); });
}
Bank initial(const Start& start, const BankDesign& design) {
  return of(design, [&start](const Design& one) { return initial(start, one); });
}

UpdateResult step(Bank& bank, const Navigation& navigation, const FinHistory& fins,
                  const BankDesign& design) {
  // Filters that were enabled since the last sample start as copies of the first filter.
  for (; bank.count < design.count; ++bank.count) {
    bank.states[bank.count] = bank.states[0];
    bank.surprise[bank.count] = bank.surprise[0];
  }
  bank.count = design.count;
  std::array<UpdateResult, bank_most> results;
  for (std::size_t i = 0; i < design.count; ++i) {
    const std::optional<std::int64_t> before_us = bank.states[i].t_us;
    results[i] = step(bank.states[i], navigation, fins, design.of[i]);
    if (results[i].outcome != Outcome::updated) continue;
    const double dt = before_us ? 1e-6 * static_cast<double>(navigation.t_us - *before_us) : 0;
    bank.surprise[i] = bank.surprise[i] * std::exp(-dt / design.of[i].settings.memory) + results[i].surprise;
  }
  weigh(bank, design);
  mix(bank, design);
  return results[likeliest(bank)];
}

}  // namespace canhil::wind
