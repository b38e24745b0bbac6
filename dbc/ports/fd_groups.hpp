// The FD contract on a bus: nodes exchange classic frames, the wire carries containers.
//
// A container (dbc/codegen/fd.hpp) is an envelope: unpacking restores the packed frames in order, byte for
// byte, so codecs, sample groups and E2E do not depend on it. An all-zero slot means an absent message; no
// valid message is all zeros. A lost frame therefore stays lost, and its receiver detects the loss by the E2E
// counter as on a classic bus.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>

#include "dbc/logs/log.hpp"
#include "dbc/ports/local_bus.hpp"
#include "dbc/ports/port.hpp"
#include "dbc/wire/fd_container.hpp"

namespace canhil {

/// What a bus carries: one of the project's two contracts, or unmodified CAN FD frames of another contract.
enum class BusFormat : std::uint8_t { classic, fd, fd_frames };

/// The name of the contract, as for `--dbc`.
constexpr std::string_view name_of(BusFormat format) {
  return format == BusFormat::fd ? "canhil-fd" : "canhil";
}
/// "CAN FD frames (canhil-fd)".
constexpr std::string_view to_text(BusFormat format) {
  return format == BusFormat::fd          ? "CAN FD frames (canhil-fd)"
         : format == BusFormat::fd_frames ? "CAN FD frames"
                                          : "classic frames (canhil)";
}

/// Collects the frames of a group into their container. At most one container is open at a time. Before a
/// frame that does not continue the open container, the container is sent incomplete. So frames keep their
/// order on the bus.
class FdPacker {
 public:
  /// The container that must go on the bus before this frame, or none.
  [[nodiscard]] std::optional<Frame> due_before(const Frame& frame) const;
  /// Discards the open container.
  void clear() { container_ = none; }
  /// Takes a frame for which due_before() is none. Returns what to send: the container that it completes, the
  /// frame itself as an FD frame if it belongs to no container, or nothing yet.
  std::optional<Frame> put(const Frame& frame);
  /// Takes a frame, and calls `out` with each frame to send now: due_before(), then what put() returns.
  template <class Out>
  void pack(const Frame& frame, const Out& out) {
    if (const auto due = due_before(frame)) {
      out(*due);
      clear();
    }
    if (const auto full = put(frame)) out(*full);
  }

 private:
  static constexpr std::uint8_t none = wire::FdPlace::nowhere;

  std::uint8_t container_ = none;
  std::uint8_t next_slot_ = 0;
  std::array<std::uint8_t, Frame::max_size> data_{};
};

/// The content of a frame of an FD bus: the messages of a container, or the frame itself. A frame of at most
/// 8 bytes becomes a classic one.
class FdUnpacked {
 public:
  FdUnpacked() = default;
  /// Unpacks a frame of an FD bus.
  explicit FdUnpacked(const Frame& frame);
  /// The frames, in the order in which they were packed.
  [[nodiscard]] std::span<const Frame> frames() const { return {frames_.data(), count_}; }

 private:
  std::array<Frame, wire::FdContainer::max_slots> frames_{};
  std::size_t count_ = 0;
};

/// A node of an FD bus: packs sent frames and unpacks received ones, own echoes included; each unpacked frame
/// has the stamp of its container. A frame that waits for other frames of its group counts as sent. If these
/// frames do not follow, the container is sent incomplete before the next frame outside the group, which is
/// at the latest a Sync or heartbeat. Received classic frames are marked foreign and counted. `inner` must
/// have been opened with fd; its only_ids, if any, are ids on the wire.
std::unique_ptr<Port> in_fd_groups(std::unique_ptr<Port> inner);

/// Reads a log of either contract as classic frames: `hil-bench run --log` records classic frames on both
/// kinds of bus, candump on an FD bus records containers.
class ClassicLogReader {
 public:
  /// Takes over an open log.
  explicit ClassicLogReader(LogReader reader) : reader_(std::move(reader)) {}
  /// The next entry; at the end and on errors the same as LogReader::next().
  Result<std::optional<LogEntry>> next();

 private:
  LogReader reader_;
  FdUnpacked unpacked_;
  std::size_t next_ = 0;  // the first of unpacked_ that has not been returned
  LogEntry envelope_;
};

/// open_port() for a contract.
Result<std::unique_ptr<Port>> open_bus(std::string_view bus, PortOptions options, BusFormat format);

/// open_bus(); hosts an embedded bus, with these rules, if no process hosts it.
Result<std::unique_ptr<Port>> join_or_host(std::string_view bus, PortOptions options, BusFormat format,
                                           HubRules rules = {});

/// The contract that `--dbc` names: canhil, canhil-fd, or a file with the text of one of these two, identical
/// to the text that this program was built from. Error: one line.
Result<BusFormat> named_contract(const std::string& name_or_file);

}  // namespace canhil
