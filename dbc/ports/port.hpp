// A Port is one node's access to a bus. Behind it: SocketCAN, the embedded bus, a recorded log, or a device
// in process.
#pragma once

#include <cstdint>
#include <ctime>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dbc/wire/bit_length.hpp"
#include "dbc/wire/frame.hpp"
#include "dbc/wire/result.hpp"
#include "dbc/wire/unrounded.hpp"

namespace canhil {

/// Where a time stamp was taken, best first.
enum class StampSource : std::uint8_t { hardware, kernel, hub, process, virtual_time };

/// A frame received from a bus.
struct Received {
  Frame frame;
  std::int64_t t_ns = 0;         ///< when it was on the bus, by the clock that Port::stamp_clock() names
  std::int64_t hardware_ns = 0;  ///< the controller's own stamp, on its own clock (differences only); 0: none
  StampSource source = StampSource::process;  ///< of the best stamp; hardware: hardware_ns is set too
  bool own = false;  ///< the echo of a frame that this port sent: its stamp is the transmit time
  bool foreign =
      false;  ///< an FD frame on a bus with the classic contract, or the reverse: not part of the contract
  std::uint8_t bus = 0;  ///< index among several buses behind one port, see Port::bus_name()
};

/// The outcome of Port::send() for a frame.
enum class SendOutcome : std::uint8_t {
  sent,        ///< the bus has accepted the frame
  queue_full,  ///< no room: wait(port, WaitFor::room, ...), then try again
  down,        ///< the bus is gone or the interface is down, see Port::up()
  refused      ///< the bus cannot carry the frame: FD on a classic bus, a size without DLC, an id too large
};

/// How to wait for room after SendOutcome::queue_full.
struct RoomWait {
  short events = 0;           ///< poll() events on Port::descriptor() that signal room; 0: none does
  std::int64_t pause_ns = 0;  ///< without such an event: try again after this time
};

/// What a port has counted since it was opened.
struct PortCounters {
  std::uint64_t sent = 0;
  std::uint64_t received = 0;
  std::uint64_t overflowed = 0;  ///< frames lost because the receive queue was full
  std::uint64_t error_frames = 0;
  std::uint64_t foreign = 0;  ///< see Received
};

/// How to open a port.
struct PortOptions {
  bool fd = false;                        ///< CAN FD frames too
  bool own_echo = false;                  ///< receive own frames back, with their transmit time stamps
  bool foreign = false;                   ///< SocketCAN without fd: receive FD frames too, marked as foreign
  std::vector<std::uint32_t> only_ids{};  ///< receive only these standard ids; empty: all
  std::string node_name{};                ///< own name, for messages and for the hub's list of nodes
  int receive_buffer_bytes = 0;           ///< SocketCAN: size of the receive queue; 0: up to 4 MiB
};

/// Known properties of a wire: how long a frame takes, and which frame a node sends first.
struct WireFacts {
  wire::BitRates rates{};     ///< nominal 0: unknown, or a frame takes no time
  bool urgent_first = false;  ///< each node sends its most urgent frame first; false: its oldest, like Linux
  bool fd = false;            ///< the contract on CAN FD: messages travel in wire::fd_carriers
};

/// The time that passes on a bus.
enum class BusTime : std::uint8_t {
  host,  ///< real time
  set,   ///< virtual: the time that Port::set_time() set last
  waits  ///< virtual: it advances while a caller waits
};

/// Properties of a bus. Ask its port for them; never infer them from the bus's name.
struct Capabilities {
  bool reports_errors = false;  ///< the port reports every bus error: without a report there was no error
  bool in_process = false;      ///< the port's other end is the device: there are no other nodes
  BusTime time = BusTime::host;
  WireFacts wire{};  ///< as far as the port knows; for a CAN controller ask the kernel
  Rounding rounding = Rounding::as_on_the_bus;  ///< of the frames that it carries
};

/// The current time of a clock of clock_gettime() [ns].
std::int64_t clock_ns(int clock);

/// One node's access to a bus. Not for several threads at once.
class Port {
 public:
  virtual ~Port() = default;
  /// Sends one frame; never blocks.
  virtual SendOutcome send(const Frame& frame) = 0;
  /// The next frame from the bus, if one is waiting; never blocks.
  virtual std::optional<Received> receive() = 0;
  /// For poll(): readable when receive() has something to do or the bus is gone. Then call receive() until it
  /// returns none. For room to send see room_wait().
  [[nodiscard]] virtual int descriptor() const = 0;
  /// How to wait for room after SendOutcome::queue_full.
  [[nodiscard]] virtual RoomWait room_wait() const = 0;
  /// Waits like wait() for a frame. A port may read the frame in the same system call.
  virtual bool wait_for_frame(std::int64_t deadline_ns);
  /// Waits like wait() for room.
  virtual bool wait_for_room(std::int64_t deadline_ns);
  /// True once the bus has ended (hub closed, end of the log).
  [[nodiscard]] virtual bool closed() const = 0;
  /// False while an interface is down or removed. send() and receive() check for its return; wait() wakes the
  /// caller often enough for that.
  [[nodiscard]] virtual bool up() const { return true; }
  /// The counters so far.
  [[nodiscard]] virtual PortCounters counters() const = 0;
  /// The properties of the bus.
  [[nodiscard]] virtual Capabilities capabilities() const { return {}; }
  /// The clock of Received::t_ns: CLOCK_REALTIME or CLOCK_MONOTONIC.
  [[nodiscard]] virtual int stamp_clock() const = 0;
  /// The current time of that clock [ns].
  [[nodiscard]] virtual std::int64_t now_ns() const { return clock_ns(stamp_clock()); }
  /// The current time of the clock of deadlines [ns]: CLOCK_MONOTONIC, unless the port simulates time that
  /// advances by waiting.
  [[nodiscard]] virtual std::int64_t monotonic_ns() const { return clock_ns(CLOCK_MONOTONIC); }
  /// Sets the virtual time since the start of the run, for ports with BusTime::set. Others ignore it.
  virtual void set_time(std::int64_t /*t_ns*/) {}
  /// The name of the bus, as given to --bus.
  [[nodiscard]] virtual const std::string& name() const = 0;
  /// If several buses are behind one port: the name of the bus with this index.
  [[nodiscard]] virtual const std::string& bus_name(std::uint8_t /*bus*/) const { return name(); }
  /// The index of the bus to which send() passes this frame.
  [[nodiscard]] virtual std::uint8_t bus_of(const Frame& /*frame*/) const { return 0; }
};

/// Opens `local:NAME`, `log:FILE`, or a SocketCAN interface by its name. Error: one line naming the bus and
/// what was expected.
Result<std::unique_ptr<Port>> open_port(std::string_view bus, const PortOptions& options);

/// What wait() waits for.
enum class WaitFor : std::uint8_t { frame, room };

/// A deadline that never comes.
constexpr std::int64_t no_deadline = std::numeric_limits<std::int64_t>::max();

/// Waits until another receive() or send() may succeed: true. False at deadline_ns on the clock of
/// Port::monotonic_ns(), or after a signal. May return true although receive() then finds no frame.
bool wait(Port& port, WaitFor what, std::int64_t deadline_ns);

}  // namespace canhil
