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

/// A frame as it came from a bus.
struct Received {
  Frame frame;
  std::int64_t t_ns = 0;         ///< when it was on the bus, by the clock that Port::stamp_clock() names
  std::int64_t hardware_ns = 0;  ///< the controller's own stamp, on its own clock (differences only); 0: none
  StampSource source = StampSource::process;  ///< the best stamp at hand; hardware: hardware_ns is set too
  bool own = false;  ///< the echo of a frame that this port sent: its stamp is the transmit time
  bool foreign =
      false;  ///< FD where the bus's contract is classic, or classic where it is FD: not part of it
  std::uint8_t bus = 0;  ///< of several buses behind one port: which, see Port::bus_name()
};

enum class SendOutcome : std::uint8_t {
  sent,        ///< taken over by the bus
  queue_full,  ///< no room now and nothing was taken: wait(port, WaitFor::room, ...), then try again
  down,        ///< the bus is gone or the interface is down, see Port::up()
  refused  ///< this bus cannot carry such a frame: FD on a classic bus, a size without DLC, an id too large
};

/// How to wait for room after SendOutcome::queue_full.
struct RoomWait {
  short events = 0;           ///< poll() events on Port::descriptor() that tell of it; 0: none does
  std::int64_t pause_ns = 0;  ///< where none does: try again after this time
};

struct PortCounters {
  std::uint64_t sent = 0;
  std::uint64_t received = 0;
  std::uint64_t overflowed = 0;  ///< frames the receive queue lost
  std::uint64_t error_frames = 0;
  std::uint64_t foreign = 0;  ///< see Received
};

struct PortOptions {
  bool fd = false;                        ///< CAN FD frames too
  bool own_echo = false;                  ///< receive own frames back, with their transmit time stamps
  bool foreign = false;                   ///< SocketCAN without fd: FD frames too, marked as foreign
  std::vector<std::uint32_t> only_ids{};  ///< receive just these standard ids; empty: all
  std::string node_name{};                ///< who we are, for messages and for the hub's list of nodes
  int receive_buffer_bytes = 0;  ///< SocketCAN: size of the receive queue; 0: 4 MiB, or what is permitted
};

/// What is known of a wire: how long a frame takes, and which one a node sends first.
struct WireFacts {
  wire::BitRates rates{};     ///< nominal 0: not known, or a frame takes no time
  bool urgent_first = false;  ///< false: the oldest first, as Linux does
  bool fd = false;            ///< the contract on CAN FD: messages travel in wire::fd_carriers
};

/// Whose time passes on a bus.
enum class BusTime : std::uint8_t {
  host,  ///< the host's
  told,  ///< virtual: what Port::tell_time() said last
  waits  ///< virtual: it passes while somebody waits
};

/// What a bus can do and what is known of it: asked of its port, never read from its name.
struct Capabilities {
  bool reports_errors = false;  ///< of itself: where none was seen there was none
  bool in_process = false;      ///< the port's other end is the device: nobody else can be there
  BusTime time = BusTime::host;
  WireFacts wire{};                             ///< as far as the port knows; of a controller the kernel does
  Rounding rounding = Rounding::as_on_the_bus;  ///< of the frames that it carries
};

/// Now on a clock of clock_gettime() [ns].
std::int64_t clock_ns(int clock);

class Port {
 public:
  virtual ~Port() = default;
  /// Hands one frame to the bus; never blocks.
  virtual SendOutcome send(const Frame& frame) = 0;
  /// The next frame from the bus, if one is waiting; never blocks.
  virtual std::optional<Received> receive() = 0;
  /// For poll(): readable when receive() has something to do or the bus is gone. Then call receive() until it
  /// gives nothing. For room to send see room_wait().
  [[nodiscard]] virtual int descriptor() const = 0;
  [[nodiscard]] virtual RoomWait room_wait() const = 0;
  /// Waits like wait() for a frame: a port that can take it by the same call does.
  virtual bool wait_for_frame(std::int64_t deadline_ns);
  /// Waits like wait() for room.
  virtual bool wait_for_room(std::int64_t deadline_ns);
  /// True once the bus is gone for good (hub closed, log at its end).
  [[nodiscard]] virtual bool closed() const = 0;
  /// False while an interface is down or removed: send() and receive() look for its return, wait() gives them
  /// the occasion.
  [[nodiscard]] virtual bool up() const { return true; }
  [[nodiscard]] virtual PortCounters counters() const = 0;
  [[nodiscard]] virtual Capabilities capabilities() const { return {}; }
  /// The clock of Received::t_ns: CLOCK_REALTIME or CLOCK_MONOTONIC.
  [[nodiscard]] virtual int stamp_clock() const = 0;
  /// Now on that clock [ns].
  [[nodiscard]] virtual std::int64_t now_ns() const { return clock_ns(stamp_clock()); }
  /// Now on the clock of deadlines [ns]: CLOCK_MONOTONIC, except where the port simulates time and waiting
  /// moves it.
  [[nodiscard]] virtual std::int64_t monotonic_ns() const { return clock_ns(CLOCK_MONOTONIC); }
  /// Virtual time has come to `t_ns` since the start of the run; for a port that is told the time. Others
  /// know it.
  virtual void tell_time(std::int64_t /*t_ns*/) {}
  /// As given to --bus.
  [[nodiscard]] virtual const std::string& name() const = 0;
  /// Of several buses behind one port: the name of one, and which of them send() gives a frame to.
  [[nodiscard]] virtual const std::string& bus_name(std::uint8_t /*bus*/) const { return name(); }
  [[nodiscard]] virtual std::uint8_t bus_of(const Frame& /*frame*/) const { return 0; }
};

/// Opens `local:NAME`, `log:FILE`, or a SocketCAN interface by its name. Error: one line naming the bus and
/// what was expected.
Result<std::unique_ptr<Port>> open_port(std::string_view bus, const PortOptions& options);

enum class WaitFor : std::uint8_t { frame, room };

constexpr std::int64_t no_deadline = std::numeric_limits<std::int64_t>::max();

/// Waits until the port is worth another receive() or send(): true; or until deadline_ns on the clock of
/// Port::monotonic_ns(), or a signal came: false. A frame may turn out not to be there: receive() decides.
bool wait(Port& port, WaitFor what, std::int64_t deadline_ns);

}  // namespace canhil
