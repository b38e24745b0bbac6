// Tests the packing of classic frames into CAN FD containers. If a container is unpacked and its frames are
// packed again, the result must be the same container. If frames are packed and unpacked, their order must
// stay the same.
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "dbc/ports/fd_groups.hpp"
#include "dbc/wire/frame_rules.hpp"
#include "messages/canhil_fd.hpp"
#include "tests/fuzz/expect.hpp"

namespace {

using canhil::Frame;
using canhil::fuzz::expect;

bool is_empty(const Frame& frame) {
  return std::ranges::all_of(frame.payload(), [](std::uint8_t byte) { return byte == 0; });
}

std::vector<Frame> packed(std::span<const Frame> frames) {
  canhil::FdPacker packer;
  std::vector<Frame> wire;
  for (const Frame& frame : frames) packer.pack(frame, [&](const Frame& out) { wire.push_back(out); });
  // A frame that belongs to no container makes the packer send the containers that it has begun to fill.
  packer.pack({.id = canhil::max_standard_id, .size = 1}, [&](const Frame& out) { wire.push_back(out); });
  wire.pop_back();
  return wire;
}

std::vector<Frame> unpacked(std::span<const Frame> wire) {
  std::vector<Frame> frames;
  for (const Frame& frame : wire) {
    const canhil::FdUnpacked inside(frame);
    frames.insert(frames.end(), inside.frames().begin(), inside.frames().end());
  }
  return frames;
}

}  // namespace

// For each frame, the input contains a byte for the kind of the frame, two bytes that select its id and its
// size, and its data.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  enum Kind : std::uint8_t { any_id = 1, fd = 2, any_size = 4, extended = 8 };
  std::span<const std::uint8_t> rest(data, size);
  std::vector<Frame> classic, wire, containers;
  while (rest.size() >= 3) {
    const std::uint8_t kind = rest[0], which = rest[1];
    const canhil::wire::FdContainer& container =
        canhil::messages_fd::containers[which % canhil::messages_fd::containers.size()];
    const std::size_t slot = (which / canhil::messages_fd::containers.size()) % container.count;
    Frame frame{.id = container.slots[slot], .size = 8};
    frame.fd = frame.brs = (kind & fd) != 0;
    if (frame.fd) frame = {.id = container.id, .size = container.size, .fd = true, .brs = true};
    if ((kind & any_id) != 0) frame.id = (which * 8U + rest[2]) & canhil::max_standard_id;
    if ((kind & any_size) != 0) frame.size = static_cast<std::uint8_t>(rest[2] % (frame.fd ? 65 : 9));
    frame.extended = (kind & extended) != 0;
    rest = rest.subspan(3);
    const auto taken = rest.first(std::min<std::size_t>(frame.size, rest.size()));
    std::ranges::copy(taken, frame.data.begin());
    rest = rest.subspan(taken.size());
    // Bytes after the last slot are not unpacked, so they must be 0 for the comparison below.
    if (kind == fd) std::fill(frame.data.begin() + container.count * 8, frame.data.end(), std::uint8_t{0});
    if (!canhil::can_carry(frame, true)) continue;
    if (frame.fd) wire.push_back(frame);
    if (is_empty(frame)) continue;  // in a container, such a frame means that the slot has no message
    if (!frame.fd) classic.push_back(frame);
    if (kind == fd) containers.push_back(frame);
  }
  expect(unpacked(packed(classic)) == classic);
  for (const Frame& container : containers) {
    const auto again = packed(unpacked({&container, 1}));
    expect(again.size() == 1 && again.front() == container);
  }
  // `wire` contains all CAN FD frames of the input in one stream, as a bus delivers them. Packing and
  // unpacking must not change the classic frames inside.
  auto inside = unpacked(wire);
  std::erase_if(inside, is_empty);
  expect(unpacked(packed(inside)) == inside);
  return 0;
}
