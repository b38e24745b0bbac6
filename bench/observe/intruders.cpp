#include "bench/observe/intruders.hpp"

namespace canhil::observe {

void Intruders::transmitted(const Frame& frame, std::int64_t /*t_ns*/, std::int64_t /*late_ns*/) {
  if (const std::size_t index = places_(frame); index != MessagePlaces::nowhere) ours_[index] = true;
}

void Intruders::received(const Received& received) {
  const std::size_t index = places_(received.frame);
  if (received.own || index == MessagePlaces::nowhere || !ours_[index]) return;
  ++frames_[messages_[index].name];
}

}  // namespace canhil::observe
