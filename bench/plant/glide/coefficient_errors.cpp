#include "bench/plant/glide/coefficient_errors.hpp"

namespace canhil::plant::glide {

CoefficientErrors::CoefficientErrors(const CoefficientErrorModel& model, Stream stream)
    : model_(model), stream_(stream) {
  draw(GaussMarkov::white());
}

void CoefficientErrors::advance(std::int64_t t_us, std::int64_t dt_us) {
  switch (model_.kind) {
    case ErrorKind::white:
      return draw(GaussMarkov::white());
    case ErrorKind::held:
      if (t_us / model_.time_us != (t_us - dt_us) / model_.time_us) draw(GaussMarkov::white());
      return;
    case ErrorKind::markov:
      return draw(GaussMarkov(static_cast<double>(dt_us) / static_cast<double>(model_.time_us)));
    case ErrorKind::constant:
      return;
  }
}

// The numbers of all parts are drawn, whether they are used or not.
void CoefficientErrors::draw(const GaussMarkov& process) {
  for (std::size_t c = 0; c < coefficient_count; ++c) {
    const bool wrong = model_.moments || c <= static_cast<std::size_t>(Coefficient::side);
    for (std::size_t p = 0; p < part_count; ++p) n_[c][p] = process.next(n_[c][p], stream_.normal());
    for (std::size_t p = 0; p < part_count; ++p)
      factors_[c][p] = wrong ? 1 + model_.level * n_[c][model_.per_part ? p : 0] : 1;
  }
}

}  // namespace canhil::plant::glide
