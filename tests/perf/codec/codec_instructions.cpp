// A program for callgrind. It calls pack() and unpack() as often as the argument states. The two calls are in
// separate functions, so that callgrind can count the instructions of each.
#include <cstdlib>
#include <span>

#include "messages/canhil.hpp"
#include "perf_messages/four_signals.hpp"

using canhil::messages::SlaveImuDeltaTheta;
using perf_messages::FourSignals;
using perf_messages::FourSignalsBig;

extern "C" {
// NOLINTBEGIN(bugprone-macro-parentheses): the macro's argument is a type
#define CANHIL_COUNTED(Message)                                                                    \
  [[gnu::noinline]] void unpack_##Message(Message& message, const std::uint8_t* bytes) {           \
    message = Message::unpack(std::span<const std::uint8_t, Message::size>(bytes, Message::size)); \
  }                                                                                                \
  [[gnu::noinline]] void pack_##Message(const Message& message, std::uint8_t* bytes) {             \
    message.pack(std::span<std::uint8_t, Message::size>(bytes, Message::size));                    \
  }
// NOLINTEND(bugprone-macro-parentheses)
CANHIL_COUNTED(SlaveImuDeltaTheta)
CANHIL_COUNTED(FourSignals)
CANHIL_COUNTED(FourSignalsBig)
}

int main(int argc, char** argv) {
  const int times = argc > 1 ? std::atoi(argv[1]) : 1;
  std::array<std::uint8_t, 8> bytes{0x12, 0x34, 0x56, 0x78, 0x9A, 0x1C, 0x2E, 0x30};
  SlaveImuDeltaTheta imu;
  FourSignals four;
  FourSignalsBig big;
  for (int i = 0; i < times; ++i) {
    unpack_SlaveImuDeltaTheta(imu, bytes.data());
    pack_SlaveImuDeltaTheta(imu, bytes.data());
    unpack_FourSignals(four, bytes.data());
    pack_FourSignals(four, bytes.data());
    unpack_FourSignalsBig(big, bytes.data());
    pack_FourSignalsBig(big, bytes.data());
  }
  return bytes[0] == 0x12 && imu.delta_theta_x_rad == 0 ? 1 : 0;
}
