#include <ctime>

#include "dbc/ports/local_bus.hpp"

namespace canhil {

void run_hub(Port& hub, const std::function<bool()>& stop) {
  constexpr std::int64_t look_up_ns = 100'000'000;
  constexpr int at_most =
      1000;  // frames between two calls of stop(), so that stop() is called also on a full bus
  while (!stop()) {
    wait(hub, WaitFor::frame, clock_ns(CLOCK_MONOTONIC) + look_up_ns);
    for (int n = 0; n < at_most && hub.receive(); ++n) {
    }
  }
}

}  // namespace canhil
