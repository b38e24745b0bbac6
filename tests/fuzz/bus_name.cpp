// Tests the functions that read the name of a bus (`--bus`). For any text, these functions must return either
// settings with permitted values, or one error line that states what was expected.
#include <cstdint>

#include "bench/drive/buses.hpp"
#include "dbc/ports/local_wire.hpp"
#include "tests/fuzz/expect.hpp"

namespace {

using namespace canhil;

// The error message must contain the bus name exactly as it was typed.
void expect_one_line(const Error& error, std::string_view name) {
  fuzz::expect(error.message.find(name) != std::string::npos &&
               error.message.find("expected") != std::string::npos);
  if (std::ranges::none_of(name, [](char c) { return static_cast<unsigned char>(c) < ' '; }))
    fuzz::expect_one_line(error.message);
}

void check(const WireSettings& wire) {
  const auto within = [](auto value, auto least, auto most) { return value >= least && value <= most; };
  fuzz::expect(wire.rates.nominal == 0 || within(wire.rates.nominal, 1'000, 1'000'000));
  fuzz::expect(wire.rates.data == 0 || within(wire.rates.data, wire.rates.nominal, 20'000'000));
  fuzz::expect(within(wire.bit_error_rate, 0.0, 1.0));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string name(reinterpret_cast<const char*>(data), size);
  const auto local = local::bus_name(name);
  if (local) {
    fuzz::expect(is_local(name) && !local->name.empty() && local->name.size() <= 64);
    fuzz::expect(local->name.find_first_of("/.") == std::string::npos);  // the name becomes a file name
    check(local->wire);
  } else {
    expect_one_line(local.error(), name);
  }
  const drive::BusName bus(named_local(name, "other"));
  if (!bus.wire) {
    expect_one_line(bus.wire.error(), bus.text);
  } else {
    check(*bus.wire);
    // A bus within this process can be opened here, because it needs no hub and no interface.
    if (bus.in_process) {
      const auto opened = drive::open_buses(bus, {}, size % 2 == 0 ? BusFormat::classic : BusFormat::fd);
      fuzz::expect(opened && opened->port->name() == bus.text);
    }
  }
  return 0;
}
