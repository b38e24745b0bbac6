// An ECU on CAN FD. It answers each frame that has the id 0x300: the answer has the id 0x301 and the same
// data. With the argument "nan", the first value of every hundredth answer is not a number.
//   fd_ecu [nan] --bus BUS
#include <algorithm>
#include <cstdint>
#include <string>

#include "dbc/ports/port.hpp"

int main(int argc, char** argv) {
  using namespace canhil;
  const bool nan = argc == 4 && std::string(argv[1]) == "nan";
  const std::string bus = argc >= 3 && std::string(argv[argc - 2]) == "--bus" ? argv[argc - 1] : "";
  PortOptions options;
  options.fd = true;
  const auto port = open_port(bus, options);
  if (!port) return 2;
  int answers = 0;
  constexpr std::uint32_t heard = 0x300, said = 0x301;
  while (!(*port)->closed()) {
    wait(**port, WaitFor::frame, (*port)->monotonic_ns() + 100'000'000);
    while (const auto received = (*port)->receive()) {
      if (received->own || received->frame.id != heard || !received->frame.fd) continue;
      Frame answer = received->frame;
      answer.id = said;
      if (++answers % 100 == 0 && nan) std::fill_n(answer.data.begin(), sizeof(double), std::uint8_t{0xFF});
      static_cast<void>((*port)->send(answer));
    }
  }
  return 0;
}
