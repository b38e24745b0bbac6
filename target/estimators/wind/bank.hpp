#pragma once
// Filters on the same samples, each with another reason for what the model of the airframe leaves
// unexplained, weighted by how likely each makes what is measured (multiple-model adaptive estimation: Magill
// 1965, IEEE Trans. AC-10, 434-439).
//
//   J_i <- J_i exp(-dt/memory) + nu_i' S_i^-1 nu_i + ln det S_i        w_i = odds_i exp(-J_i/2), of sum 1
//   x = sum w_i x_i                                                    P = sum w_i (P_i + (x_i - x)(x_i -
//   x)')
//
// The memory is short, so that a filter which was wrong for a while is believed again. One filter alone is
// that filter, bit for bit.
#include <array>
#include <cstddef>

#include "target/estimators/wind/filter.hpp"

namespace canhil::wind {

/// Of wrong coefficients, and of gusts.
inline constexpr std::size_t bank_most = 2;

struct BankDesign {
  std::array<Design, bank_most> of;
  std::array<double, bank_most> odds{};  // before anything is measured
  std::size_t count = 1;                 // of filters that run
};

struct Bank {
  std::array<State, bank_most> states;
  std::array<double, bank_most> surprise{};  // J
  std::array<double, bank_most> weight{};    // w, of the last sample
  std::size_t count = 0;                     // of filters that run
  StateVector x = StateVector::Zero();  // the mixture; of a filter that has not started only the wind counts
  Covariance P = Covariance::Identity();
  bool started = false;
};

/// One filter of these settings; with ProcessNoise::likeliest as many as there are reasons.
BankDesign make_bank(const Settings& settings);

/// As initial() of a filter: of what is known at release, and of nothing.
Bank initial(const BankDesign& design);
Bank initial(const Start& start, const BankDesign& design);

/// One sample for each filter, and their mixture; the result is that of the likeliest. No allocation, no
/// exception.
UpdateResult step(Bank& bank, const Navigation& navigation, const FinHistory& fins, const BankDesign& design);

}  // namespace canhil::wind
