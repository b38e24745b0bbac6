#include "bench/world/glide/coefficient_errors.hpp"

#include <cmath>

namespace canhil::world::glide {

CoefficientErrors::CoefficientErrors(const CoefficientErrorModel& model, Stream stream)
    : model_(model), stream_(stream) {
  draw(0);
}

void CoefficientErrors::advance(std::int64_t t_us, std::int64_t dt_us) {
  switch (model_.kind) {
    case ErrorKind::white:
      return draw(0);
    case ErrorKind::held:
      if (t_us / model_.time_us != (t_us - dt_us) / model_.time_us) draw(0);
      return;
    case ErrorKind::markov:
      return draw(std::exp(-static_cast<double>(dt_us) / static_cast<double>(model_.time_us)));
    case ErrorKind::constant:
      return;
  }
}

// Multiplies each random number n by `kept` and adds w sqrt(1 - kept^2), where w is a new standard normal
// number. The numbers of all parts are drawn, whether they are used or not.
void CoefficientErrors::draw(double kept) {
  for (std::size_t c = 0; c < coefficient_count; ++c) {
    const bool wrong = model_.moments || c <= static_cast<std::size_t>(Coefficient::side);
    for (std::size_t p = 0; p < part_count; ++p)
      n_[c][p] = kept * n_[c][p] + std::sqrt(1 - kept * kept) * stream_.normal();
    for (std::size_t p = 0; p < part_count; ++p)
      factors_[c][p] = wrong ? 1 + model_.level * n_[c][model_.per_part ? p : 0] : 1;
  }
}

}  // namespace canhil::world::glide
