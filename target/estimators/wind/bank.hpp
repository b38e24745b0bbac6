#pragma once
// A bank of filters that process the same samples. Each filter attributes the residuals of the airframe model
// to a different cause. The weight of a filter follows from the likelihood of the measurements
// (multiple-model adaptive estimation: Magill 1965, IEEE Trans. AC-10, 434-439).
//
//   J_i <- J_i exp(-dt/memory) + nu_i' S_i^-1 nu_i + ln det S_i
//   w_i = odds_i exp(-J_i/2), scaled to the sum 1
//   x = sum w_i x_i,   P = sum w_i (P_i + (x_i - x)(x_i - x)')
//
// The memory is short, so that a filter that was wrong regains its weight soon. A bank with one filter equals
// that filter, bit for bit.
#include <array>
#include <cstddef>

#include "target/estimators/wind/filter.hpp"

namespace canhil::wind {

/// The largest number of filters: one for wrong coefficients, one for gusts.
inline constexpr std::size_t bank_most = 2;

/// The designs of a bank's filters.
struct BankDesign {
  std::array<Design, bank_most> of;
  std::array<double, bank_most> odds{};  // prior weights
  std::size_t count = 1;                 // number of running filters
};

/// The state of a bank between two samples.
struct Bank {
  std::array<State, bank_most> states;
  std::array<double, bank_most> surprise{};  // J
  std::array<double, bank_most> weight{};    // w, after the last sample
  std::size_t count = 0;                     // number of running filters
  StateVector x = StateVector::Zero();       // the mixture; before the start only the wind is valid
  Covariance P = Covariance::Identity();
  bool started = false;
};

/// The designs of a bank: one filter, or with ProcessNoise::likeliest one filter for each cause.
BankDesign make_bank(const Settings& settings);

/// The initial bank if the state at release is unknown.
Bank initial(const BankDesign& design);
/// The initial bank for a known state at release.
Bank initial(const Start& start, const BankDesign& design);

/// Processes one sample with each filter and mixes their states; returns the result of the likeliest filter.
/// No allocation, no exception.
UpdateResult step(Bank& bank, const Navigation& navigation, const FinHistory& fins, const BankDesign& design);

}  // namespace canhil::wind
