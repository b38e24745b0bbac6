#include "bench/observe/intruders.hpp"

#include "messages/canhil.hpp"

namespace canhil::observe {

void Intruders::transmitted(const Frame& frame, std::int64_t /*t_ns*/, std::int64_t /*late_ns*/) {
  if (const std::size_t place = places_(frame); place != MessagePlaces::nowhere) ours_[place] = true;
}

void Intruders::received(const Received& received) {
  const std::size_t place = places_(received.frame);
  if (received.own || place == MessagePlaces::nowhere || !ours_[place]) return;
  ++frames_[messages_[place].name];
}

}  // namespace canhil::observe
