// hil-target with delays: the object files of the delivered program, in which the linker option --wrap
// replaces two functions by functions with a pause. CANHIL_SLOW_COMPUTE_US: additional computing time for
// each answered frame, in which the target sleeps; CANHIL_SLOW_BUSY_US: in which it computes.
// CANHIL_SLOW_QUEUE_US: how long frames wait before they are processed.
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "dbc/ports/port.hpp"
#include "target/device/device.hpp"

namespace canhil {
namespace {

useconds_t microseconds(const char* variable) {
  const char* text = std::getenv(variable);
  return text == nullptr ? 0 : static_cast<useconds_t>(std::strtoul(text, nullptr, 10));
}

}  // namespace

// The linker's names of the two functions, by the Itanium C++ ABI. In this ABI, the first argument of a
// member function is its object.
std::span<const Frame> delivered_receive(target::Device& device, const Frame& frame) asm(
    "__real__ZN6canhil6target6Device7receiveERKNS_5FrameE");
std::span<const Frame> slow_receive(target::Device& device, const Frame& frame) asm(
    "__wrap__ZN6canhil6target6Device7receiveERKNS_5FrameE");
bool delivered_wait(Port& port, WaitFor what,
                    std::int64_t deadline_ns) asm("__real__ZN6canhil4waitERNS_4PortENS_7WaitForEl");
bool slow_wait(Port& port, WaitFor what,
               std::int64_t deadline_ns) asm("__wrap__ZN6canhil4waitERNS_4PortENS_7WaitForEl");

std::span<const Frame> slow_receive(target::Device& device, const Frame& frame) {
  static const useconds_t pause_us = microseconds("CANHIL_SLOW_COMPUTE_US");
  const std::span<const Frame> answers = delivered_receive(device, frame);
  static const std::chrono::microseconds busy(microseconds("CANHIL_SLOW_BUSY_US"));
  if (pause_us > 0 && !answers.empty()) usleep(pause_us);
  if (busy.count() == 0 || answers.empty()) return answers;
  for (const auto start = std::chrono::steady_clock::now();
       std::chrono::steady_clock::now() - start < busy;) {
  }
  return answers;
}

bool slow_wait(Port& port, WaitFor what, std::int64_t deadline_ns) {
  static const useconds_t pause_us = microseconds("CANHIL_SLOW_QUEUE_US");
  const bool came = delivered_wait(port, what, deadline_ns);
  if (pause_us > 0 && came && what == WaitFor::frame) usleep(pause_us);
  return came;
}

}  // namespace canhil
