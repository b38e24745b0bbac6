#include "bench/plant/fmu/here.hpp"

#include <numeric>

namespace canhil::plant::fmu {

Started start_here(const Setup& setup, std::span<double> outputs) {
  auto binary = Binary::load(setup.library);
  if (!binary) return tl::unexpected(binary.error());
  return setup.version == 2 ? start_fmi2(setup, std::move(*binary), outputs)
                            : start_fmi3(setup, std::move(*binary), outputs);
}

std::size_t elements_of(std::span<const Place> places) {
  return std::accumulate(places.begin(), places.end(), std::size_t{0},
                         [](std::size_t sum, const Place& place) { return sum + place.count; });
}

}  // namespace canhil::plant::fmu
