// Errors of the nominal aerodynamic coefficients. A true coefficient is nominal (1 + level n), where n is a
// standard normal random number.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "bench/plant/glide/aerodynamics.hpp"
#include "bench/world/gauss_markov.hpp"
#include "bench/world/stream.hpp"

namespace canhil::plant::glide {

using world::GaussMarkov;
using world::Stream;

/// How the random number n of a coefficient's error changes with time.
enum class ErrorKind : std::uint8_t {
  white,    ///< drawn at every step of the truth
  held,     ///< drawn every `time_us`, then held
  markov,   ///< first-order Gauss-Markov with correlation time `time_us`
  constant  ///< drawn once for the run
};
inline constexpr std::array<std::string_view, 4> error_kind_names{"white", "held", "markov", "constant"};

struct CoefficientErrorModel {
  double level = 0;  ///< sigma of the relative error
  ErrorKind kind = ErrorKind::held;
  std::int64_t time_us = 50'000;  ///< hold or correlation time, for held and markov
  bool per_part = true;           ///< each part of a coefficient has its own factor
  bool moments = true;            ///< false: only the coefficients of forces have errors
};

class CoefficientErrors {
 public:
  CoefficientErrors(const CoefficientErrorModel& model, Stream stream);

  /// The current factors.
  [[nodiscard]] const Factors& now() const { return factors_; }
  /// Advances to the time t_us. dt_us is the time since the previous call.
  void advance(std::int64_t t_us, std::int64_t dt_us);

 private:
  void draw(const GaussMarkov& process);

  CoefficientErrorModel model_;
  Stream stream_;
  Factors n_{};  // standard normal numbers
  Factors factors_ = nominal;
};

}  // namespace canhil::plant::glide
