// The FD contract on a bus: classic frames to its nodes, containers on the wire.
//
// A container (dbc/codegen/fd.hpp) is an envelope: what is packed into it comes out again in the same order,
// with the same bytes, so codecs, sample groups and E2E know nothing of it. A slot of zeros is a message that
// is not there; no message of the contract looks like that, so nothing is ever made up: a lost frame stays
// lost, and its receiver sees it by the E2E counter as on a classic bus.
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

/// What a bus carries: one of the project's two contracts, or the CAN FD frames of another one, as they are.
enum class BusFormat : std::uint8_t { classic, fd, fd_frames };

constexpr std::string_view name_of(BusFormat format) {
  return format == BusFormat::fd ? "canhil-fd" : "canhil";
}
/// "CAN FD (canhil-fd)".
constexpr std::string_view to_text(BusFormat format) {
  return format == BusFormat::fd          ? "CAN FD frames (canhil-fd)"
         : format == BusFormat::fd_frames ? "CAN FD frames"
                                          : "classic frames (canhil)";
}

/// Collects the frames of a group for their container. At most one container is begun at a time, so frames
/// keep their order on the bus: one that does not continue it sends it off first, as it is.
class FdPacker {
 public:
  /// The container that must go on the bus before this frame, or none.
  [[nodiscard]] std::optional<Frame> due_before(const Frame& frame) const;
  /// Forgets the container begun.
  void clear() { container_ = none; }
  /// Takes a frame that nothing is due before; gives what goes on the bus with it: the container that it
  /// completes, itself as an FD frame if it belongs to none, or nothing yet.
  std::optional<Frame> put(const Frame& frame);
  /// All of it: gives what goes on the bus before the frame, and with it, to `out`.
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

/// What a frame of an FD bus holds: the messages of a container, or itself as a classic frame.
class FdUnpacked {
 public:
  FdUnpacked() = default;
  explicit FdUnpacked(const Frame& frame);
  [[nodiscard]] std::span<const Frame> frames() const { return {frames_.data(), count_}; }

 private:
  std::array<Frame, wire::FdContainer::max_slots> frames_{};
  std::size_t count_ = 0;
};

/// A node of an FD bus: packs what is sent, unpacks what comes, own echoes too, with the stamp of their
/// container. A frame that waits for others of its group counts as sent; should they never come it goes with
/// the next frame of another kind, which on this bus is the next Sync or heartbeat. Classic frames of others
/// are marked foreign and counted. `inner` must have been opened with fd; only_ids, if any, are ids of the
/// wire.
std::unique_ptr<Port> in_fd_groups(std::unique_ptr<Port> inner);

/// A log as classic frames, whichever contract's bus was recorded: `hil-bench run --log` writes classic
/// frames in both, candump on an FD bus the containers.
class ClassicLogReader {
 public:
  explicit ClassicLogReader(LogReader reader) : reader_(std::move(reader)) {}
  /// As LogReader::next().
  Result<std::optional<LogEntry>> next();

 private:
  LogReader reader_;
  FdUnpacked unpacked_;
  std::size_t next_ = 0;  // the first of unpacked_ that was not given yet
  LogEntry envelope_;
};

/// open_port() for a contract.
Result<std::unique_ptr<Port>> open_bus(std::string_view bus, PortOptions options, BusFormat format);

/// open_bus(); an embedded bus that nobody hosts is hosted here, by these rules.
Result<std::unique_ptr<Port>> join_or_host(std::string_view bus, PortOptions options, BusFormat format,
                                           HubRules rules = {});

/// The contract that `--dbc` names: canhil, canhil-fd, or a file that holds the text of one of the two as
/// this program was built with. Error: one line.
Result<BusFormat> named_contract(const std::string& name_or_file);

}  // namespace canhil
