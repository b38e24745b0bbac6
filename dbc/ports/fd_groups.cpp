#include "dbc/ports/fd_groups.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "dbc/parser/parse.hpp"
#include "dbc/wire/frame_rules.hpp"
#include "messages/canhil_fd.hpp"

namespace canhil {
namespace {

using wire::FdContainer;
using wire::FdPlace;

FdPlace place_of(const Frame& frame) {
  if (frame.fd || frame.error || frame.extended || frame.size != FdContainer::slot_bytes) return {};
  return messages_fd::places[frame.id & max_standard_id];
}

const FdContainer* container_of(const Frame& frame) {
  if (frame.extended) return nullptr;
  const FdPlace place = messages_fd::places[frame.id & max_standard_id];
  if (place.container == FdPlace::nowhere || place.slot != 0) return nullptr;
  const FdContainer& container = messages_fd::containers[place.container];
  return container.size == frame.size ? &container : nullptr;
}

Frame container_frame(const FdContainer& container, std::span<const std::uint8_t, Frame::max_size> data) {
  Frame frame{.id = container.id, .size = container.size, .fd = true, .brs = true};
  std::ranges::copy(data.first(container.size), frame.data.begin());
  return frame;
}

class FdGroups final : public Port {
 public:
  explicit FdGroups(std::unique_ptr<Port> inner) : inner_(std::move(inner)) {}

  SendOutcome send(const Frame& frame) override {
    if (frame.fd || frame.error) return inner_->send(frame);
    if (const auto due = packer_.due_before(frame)) {
      if (const SendOutcome outcome = inner_->send(*due); outcome != SendOutcome::sent) return outcome;
      packer_.clear();
    }
    FdPacker packer = packer_;  // a copy, which replaces packer_ only if the bus accepts the container
    if (const auto full = packer.put(frame)) {
      if (const SendOutcome outcome = inner_->send(*full); outcome != SendOutcome::sent) return outcome;
    }
    packer_ = packer;
    return SendOutcome::sent;
  }

  std::optional<Received> receive() override {
    while (next_ == unpacked_.frames().size()) {
      auto received = inner_->receive();
      if (!received || received->frame.error) return received;
      if (!received->frame.fd) {
        received->foreign = true;
        ++foreign_;
        return received;
      }
      unpacked_ = FdUnpacked(received->frame);
      next_ = 0;
      envelope_ = *received;
    }
    envelope_.frame = unpacked_.frames()[next_++];
    return envelope_;
  }

  [[nodiscard]] int descriptor() const override { return inner_->descriptor(); }
  [[nodiscard]] RoomWait room_wait() const override { return inner_->room_wait(); }
  [[nodiscard]] bool closed() const override { return inner_->closed(); }
  [[nodiscard]] bool up() const override { return inner_->up(); }
  /// A container counts as one frame; the messages in it are not counted.
  [[nodiscard]] PortCounters counters() const override {
    PortCounters counters = inner_->counters();
    counters.foreign += foreign_;
    return counters;
  }
  [[nodiscard]] Capabilities capabilities() const override { return inner_->capabilities(); }
  [[nodiscard]] int stamp_clock() const override { return inner_->stamp_clock(); }
  [[nodiscard]] std::int64_t now_ns() const override { return inner_->now_ns(); }
  [[nodiscard]] std::int64_t monotonic_ns() const override { return inner_->monotonic_ns(); }
  bool wait_for_frame(std::int64_t deadline_ns) override { return inner_->wait_for_frame(deadline_ns); }
  bool wait_for_room(std::int64_t deadline_ns) override { return inner_->wait_for_room(deadline_ns); }
  [[nodiscard]] const std::string& name() const override { return inner_->name(); }

 private:
  std::unique_ptr<Port> inner_;
  FdPacker packer_;
  FdUnpacked unpacked_;
  std::size_t next_ = 0;  // index of the first frame of unpacked_ that has not been received
  Received envelope_;
  std::uint64_t foreign_ = 0;
};

}  // namespace

std::optional<Frame> FdPacker::due_before(const Frame& frame) const {
  if (container_ == none) return std::nullopt;
  const FdPlace place = place_of(frame);
  if (place.container == container_ && place.slot >= next_slot_) return std::nullopt;
  return container_frame(messages_fd::containers[container_], data_);
}

std::optional<Frame> FdPacker::put(const Frame& frame) {
  const FdPlace place = place_of(frame);
  if (place.container == FdPlace::nowhere) {
    Frame alone = frame;
    alone.fd = alone.brs = true;
    return alone;
  }
  const FdContainer& container = messages_fd::containers[place.container];
  if (container_ == none) {
    container_ = place.container;
    data_.fill(0);
  }
  std::memcpy(&data_[place.slot * FdContainer::slot_bytes], frame.data.data(), FdContainer::slot_bytes);
  next_slot_ = static_cast<std::uint8_t>(place.slot + 1);
  if (next_slot_ < container.count) return std::nullopt;
  clear();
  return container_frame(container, data_);
}

FdUnpacked::FdUnpacked(const Frame& frame) {
  const FdContainer* container = container_of(frame);
  if (container == nullptr) {
    Frame& alone = frames_[count_++];
    alone = frame;
    if (frame.size <= FdContainer::slot_bytes) alone.fd = alone.brs = alone.esi = false;
    return;
  }
  for (std::size_t slot = 0; slot < container->count; ++slot) {
    const auto bytes = frame.payload().subspan(slot * FdContainer::slot_bytes, FdContainer::slot_bytes);
    if (std::ranges::all_of(bytes, [](std::uint8_t byte) { return byte == 0; })) continue;
    Frame& message = frames_[count_++];
    message.id = container->slots[slot];
    message.size = FdContainer::slot_bytes;
    std::ranges::copy(bytes, message.data.begin());
  }
}

std::unique_ptr<Port> in_fd_groups(std::unique_ptr<Port> inner) {
  return std::make_unique<FdGroups>(std::move(inner));
}

Result<std::optional<LogEntry>> ClassicLogReader::next() {
  while (next_ == unpacked_.frames().size()) {
    auto entry = reader_.next();
    if (!entry || !*entry || !(*entry)->frame.fd) return entry;
    unpacked_ = FdUnpacked((*entry)->frame);
    next_ = 0;
    envelope_ = std::move(**entry);
  }
  envelope_.frame = unpacked_.frames()[next_++];
  return std::optional(envelope_);
}

Result<std::unique_ptr<Port>> open_bus(std::string_view bus, PortOptions options, BusFormat format) {
  options.fd = format != BusFormat::classic;
  auto port = open_port(bus, options);
  if (!port || format != BusFormat::fd) return port;
  return in_fd_groups(std::move(*port));
}

Result<std::unique_ptr<Port>> join_or_host(std::string_view bus, PortOptions options, BusFormat format,
                                           HubRules rules) {
  auto joined = open_bus(bus, options, format);
  if (joined || !is_local(bus)) return joined;
  options.fd = format != BusFormat::classic;
  auto hosted = host_local_bus(bus, options, std::move(rules));
  // If joining and hosting both fail, the more helpful error is returned. If no process hosts the bus, the
  // error of hosting is more helpful, otherwise the error of joining.
  if (!hosted && joined.error().message.starts_with(nobody_hosts)) return tl::unexpected(hosted.error());
  if (!hosted) return joined;
  return format == BusFormat::fd ? in_fd_groups(std::move(*hosted)) : std::move(*hosted);
}

Result<BusFormat> named_contract(const std::string& name_or_file) {
  for (const BusFormat format : {BusFormat::classic, BusFormat::fd}) {
    if (name_or_file == name_of(format)) return format;
  }
  const auto contract = dbc::read_file(name_or_file);
  if (!contract) return failure(fmt::format("--dbc: {}", contract.error().message));
  if (contract->hash == messages_fd::classic_hash) return BusFormat::classic;
  if (contract->hash == messages_fd::fd_hash) return BusFormat::fd;
  return failure(
      fmt::format("--dbc: {}: hash {:016x}, expected that of canhil.dbc ({:016x}) or of canhil-fd.dbc "
                  "({:016x}), which this program was built with",
                  name_or_file, contract->hash, messages_fd::classic_hash, messages_fd::fd_hash));
}

}  // namespace canhil
