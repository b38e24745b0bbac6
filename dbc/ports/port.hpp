// A Port is the access of one node to a bus. The bus is a SocketCAN interface, an embedded bus, a recorded
// log, or a device in the same process.
#pragma once

#include <cstdint>
#include <ctime>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dbc/wire/bit_length.hpp"
#include "dbc/wire/frame.hpp"
#include "dbc/wire/result.hpp"
#include "dbc/wire/unrounded.hpp"

namespace canhil {

/// Where a time stamp was taken. The sources are in order of quality, from the best to the worst.
enum class StampSource : std::uint8_t { hardware, kernel, hub, process, virtual_time };

/// A frame that was received from a bus.
struct Received {
  Frame frame;
  std::int64_t t_ns = 0;  ///< when the frame was on the bus, on the clock Port::stamp_clock()
  /// The stamp of the controller on its own clock; 0: none. Only differences of such stamps have a meaning.
  std::int64_t hardware_ns = 0;
  /// The source of the best stamp. If it is StampSource::hardware, hardware_ns is set too.
  StampSource source = StampSource::process;
  bool own =
      false;  ///< this is the echo of a frame that this port sent; the stamp is the time of transmission
  bool foreign = false;  ///< an FD frame on a bus with the classic contract, or a classic frame on a bus with
                         ///< the FD contract
  std::uint8_t bus = 0;  ///< if the port has several buses: index of the bus, see Port::bus_name()
};

/// The result of Port::send() for a frame.
enum class SendOutcome : std::uint8_t {
  sent,        ///< the bus has accepted the frame
  queue_full,  ///< no room; call wait(port, WaitFor::room, ...), then try again
  down,        ///< the bus has ended or the interface is down, see Port::up()
  /// The bus cannot carry the frame: an FD frame on a classic bus, a size that has no DLC, or too large an
  /// id.
  refused
};

/// How a caller waits for room after SendOutcome::queue_full.
struct RoomWait {
  short events = 0;           ///< poll() events of Port::descriptor() that signal room; 0: there are none
  std::int64_t pause_ns = 0;  ///< if there are no such events, try again after this time
};

/// The counters of a port since the port was opened.
struct PortCounters {
  std::uint64_t sent = 0;
  std::uint64_t received = 0;
  std::uint64_t overflowed = 0;  ///< frames that were lost because the receive queue was full
  std::uint64_t error_frames = 0;
  std::uint64_t foreign = 0;  ///< see Received::foreign
};

/// The options with which a port is opened.
struct PortOptions {
  bool fd = false;        ///< the bus carries CAN FD frames too
  bool own_echo = false;  ///< receive echoes of own frames, with the time of transmission
  bool foreign = false;   ///< only SocketCAN with fd = false: receive FD frames too, marked as foreign
  std::vector<std::uint32_t> only_ids{};  ///< receive only these standard ids; empty: all
  std::string node_name{};                ///< name of this node in messages and in the hub's list of nodes
  int receive_buffer_bytes = 0;           ///< SocketCAN: size of the receive queue; 0: up to 4 MiB
};

/// What is known about a wire: how long a frame takes, and which frame a node sends first.
struct WireFacts {
  wire::BitRates rates{};  ///< if nominal is 0, the rates are unknown or a frame takes no time
  /// true: each node sends its frame of highest priority first; false: its oldest frame first, as Linux does.
  bool urgent_first = false;
  bool fd = false;  ///< the bus has the FD contract: wire::fd_carriers carry the messages
};

/// The kind of time on a bus.
enum class BusTime : std::uint8_t {
  host,  ///< real time
  set,   ///< virtual time: the last value of Port::set_time()
  waits  ///< virtual time that advances when a caller waits
};

/// Properties of a bus. Get them from the port of the bus; never infer them from the name of the bus.
struct Capabilities {
  bool reports_errors = false;  ///< the port reports every bus error, so no report means no error
  bool in_process = false;      ///< the only other node is the device, which is in this process
  BusTime time = BusTime::host;
  WireFacts wire{};  ///< what the port knows about the wire; for a CAN controller, ask the kernel
  Rounding rounding = Rounding::as_on_the_bus;  ///< rounding of the frames that the bus carries
};

/// The current time of a clock that clock_gettime() knows [ns].
std::int64_t clock_ns(int clock);

/// The access of one node to a bus. Several threads must not use a Port at the same time.
class Port {
 public:
  virtual ~Port() = default;
  /// Sends one frame; never blocks.
  virtual SendOutcome send(const Frame& frame) = 0;
  /// Sends frames in order until the bus does not accept one; send() then tells why. Returns how many it
  /// accepted. A port may need only one system call for several frames.
  virtual std::size_t send_all(std::span<const Frame> frames);
  /// The next frame from the bus, if one is waiting; never blocks.
  virtual std::optional<Received> receive() = 0;
  /// A descriptor for poll(). It is readable when receive() has something to do or the bus has ended. Then
  /// call receive() until it returns nullopt. For room to send see room_wait().
  [[nodiscard]] virtual int descriptor() const = 0;
  /// How a caller waits for room after SendOutcome::queue_full.
  [[nodiscard]] virtual RoomWait room_wait() const = 0;
  /// wait() calls this function to wait for a frame; the result is that of wait(). A port may read the frame
  /// in the same system call.
  virtual bool wait_for_frame(std::int64_t deadline_ns);
  /// wait() calls this function to wait for room; the result is that of wait().
  virtual bool wait_for_room(std::int64_t deadline_ns);
  /// True if the bus has ended (the hub has closed it, or the log is at its end).
  [[nodiscard]] virtual bool closed() const = 0;
  /// False while the interface is down or removed. send() and receive() check whether the interface is up
  /// again; wait() returns often enough for these checks.
  [[nodiscard]] virtual bool up() const { return true; }
  /// The counters so far.
  [[nodiscard]] virtual PortCounters counters() const = 0;
  /// The properties of the bus.
  [[nodiscard]] virtual Capabilities capabilities() const { return {}; }
  /// The clock of Received::t_ns: CLOCK_REALTIME or CLOCK_MONOTONIC.
  [[nodiscard]] virtual int stamp_clock() const = 0;
  /// The current time of the clock stamp_clock() [ns].
  [[nodiscard]] virtual std::int64_t now_ns() const { return clock_ns(stamp_clock()); }
  /// The current time of the clock to which deadlines refer [ns]. This is CLOCK_MONOTONIC, except for ports
  /// with BusTime::waits.
  [[nodiscard]] virtual std::int64_t monotonic_ns() const { return clock_ns(CLOCK_MONOTONIC); }
  /// Sets the virtual time since the start of the run. Has an effect only for ports with BusTime::set.
  virtual void set_time(std::int64_t /*t_ns*/) {}
  /// The name of the bus, as the user gave it to --bus.
  [[nodiscard]] virtual const std::string& name() const = 0;
  /// If the port has several buses: the name of the bus with this index.
  [[nodiscard]] virtual const std::string& bus_name(std::uint8_t /*bus*/) const { return name(); }
  /// The index of the bus to which send() passes this frame.
  [[nodiscard]] virtual std::uint8_t bus_of(const Frame& /*frame*/) const { return 0; }
};

/// Opens the bus `local:NAME`, `log:FILE`, or a SocketCAN interface by its name. An error is one line with
/// the name of the bus and with what was expected.
Result<std::unique_ptr<Port>> open_port(std::string_view bus, const PortOptions& options);

/// What wait() waits for.
enum class WaitFor : std::uint8_t { frame, room };

/// A deadline that never comes.
constexpr std::int64_t no_deadline = std::numeric_limits<std::int64_t>::max();

/// Returns true when receive() or send() may succeed. Returns false when Port::monotonic_ns() reaches
/// deadline_ns, or when a signal interrupts the wait. May return true although receive() then finds no frame.
bool wait(Port& port, WaitFor what, std::int64_t deadline_ns);

}  // namespace canhil
