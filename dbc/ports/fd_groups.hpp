// The FD contract on a bus: a node sends and receives classic frames, but the frames on the wire are
// containers.
//
// Unpacking a container (dbc/codegen/fd.hpp) restores the packed classic frames in order, byte for byte. So
// codecs, sample groups and E2E protection do not depend on containers. A slot of zeros means that its
// message is absent; no valid message consists of zeros. So a message that was lost before packing remains
// absent, and the receiver detects the loss by the E2E counter, as on a classic bus.
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

/// What a bus carries: frames of one of the project's two contracts (classic, fd), or CAN FD frames of
/// another contract, which are not changed (fd_frames).
enum class BusFormat : std::uint8_t { classic, fd, fd_frames };

/// The name of the contract in the option `--dbc`.
constexpr std::string_view name_of(BusFormat format) {
  return format == BusFormat::fd ? "canhil-fd" : "canhil";
}
/// The format as text, such as "CAN FD frames (canhil-fd)".
constexpr std::string_view to_text(BusFormat format) {
  return format == BusFormat::fd          ? "CAN FD frames (canhil-fd)"
         : format == BusFormat::fd_frames ? "CAN FD frames"
                                          : "classic frames (canhil)";
}

/// Collects the frames of a group in a container. At most one container is open, i.e. waits for more frames.
/// If the next frame cannot be added to the open container, the container is sent incomplete before that
/// frame. So frames keep their order on the bus.
class FdPacker {
 public:
  /// The open container, if it must be sent before `frame`; otherwise nullopt.
  [[nodiscard]] std::optional<Frame> due_before(const Frame& frame) const;
  /// Discards the open container.
  void clear() { container_ = none; }
  /// Adds a frame, for which due_before() must be nullopt. Returns the frame that must be sent now: the
  /// container, if the frame completes it, or the frame itself as an FD frame, if it belongs to no container.
  /// nullopt: nothing must be sent yet.
  std::optional<Frame> put(const Frame& frame);
  /// Adds a frame. Calls `out` with each frame that must be sent now: first due_before(), then the result of
  /// put().
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

/// The content of a frame from an FD bus: the messages of a container, or the frame itself. If the frame is
/// no container and has at most 8 bytes, it becomes a classic frame.
class FdUnpacked {
 public:
  FdUnpacked() = default;
  /// Unpacks a frame from an FD bus.
  explicit FdUnpacked(const Frame& frame);
  /// The frames, in the order in which they were packed.
  [[nodiscard]] std::span<const Frame> frames() const { return {frames_.data(), count_}; }

 private:
  std::array<Frame, wire::FdContainer::max_slots> frames_{};
  std::size_t count_ = 0;
};

/// Makes the port of a node of an FD bus from the port `inner`. The new port packs sent frames into
/// containers and unpacks received containers, including the echoes of its own containers. Each unpacked
/// frame has the stamp of its container. send() returns `sent` also for a frame that still waits in a
/// container for the other frames of its group. If these frames do not follow, the container is sent
/// incomplete before the next frame that does not belong to the group. At the latest, a Sync or a heartbeat
/// is such a frame. Received classic frames are marked as foreign and counted. `inner` must have been opened
/// with PortOptions::fd. If `inner` was opened with only_ids, these ids must be those of containers.
std::unique_ptr<Port> in_fd_groups(std::unique_ptr<Port> inner);

/// Reads a log of one of the two contracts and returns classic frames. Logs of `hil-bench run --log` contain
/// classic frames, also on an FD bus. Logs that candump recorded on an FD bus contain containers.
class ClassicLogReader {
 public:
  /// `reader` is an open log.
  explicit ClassicLogReader(LogReader reader) : reader_(std::move(reader)) {}
  /// The next entry. At the end and on errors, returns the same as LogReader::next().
  Result<std::optional<LogEntry>> next();

 private:
  LogReader reader_;
  FdUnpacked unpacked_;
  std::size_t next_ = 0;  // index of the first frame of unpacked_ that has not been returned
  LogEntry envelope_;
};

/// Opens a bus like open_port(), for a given contract.
Result<std::unique_ptr<Port>> open_bus(std::string_view bus, PortOptions options, BusFormat format);

/// Opens a bus like open_bus(). If `bus` is an embedded bus that no process hosts, hosts this bus with
/// `rules`.
Result<std::unique_ptr<Port>> join_or_host(std::string_view bus, PortOptions options, BusFormat format,
                                           HubRules rules = {});

/// The contract for the value of `--dbc`: canhil, canhil-fd, or a file. This program was built with the texts
/// of the contracts canhil and canhil-fd. The text of the file must be identical to one of these two texts.
/// An error is one line.
Result<BusFormat> named_contract(const std::string& name_or_file);

}  // namespace canhil
