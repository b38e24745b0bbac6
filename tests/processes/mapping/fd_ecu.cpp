// An ECU on CAN FD. It answers each frame that has the id 0x300: the answer has the id 0x301 and the same
// data.
#include <algorithm>
#include <string>

#include "dbc/ports/port.hpp"

int main(int argc, char** argv) {
  using namespace canhil;
  const std::string bus = argc == 3 && std::string(argv[1]) == "--bus" ? argv[2] : "";
  PortOptions options;
  options.fd = true;
  const auto port = open_port(bus, options);
  if (!port) return 2;
  constexpr std::uint32_t heard = 0x300, said = 0x301;
  while (!(*port)->closed()) {
    wait(**port, WaitFor::frame, (*port)->monotonic_ns() + 100'000'000);
    while (const auto received = (*port)->receive()) {
      if (received->own || received->frame.id != heard || !received->frame.fd) continue;
      Frame answer = received->frame;
      answer.id = said;
      static_cast<void>((*port)->send(answer));
    }
  }
  return 0;
}
