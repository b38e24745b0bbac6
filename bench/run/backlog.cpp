#include "bench/run/backlog.hpp"

#include <fmt/format.h>

#include <tuple>

namespace canhil::run {
namespace {

// A bench that had no CPU for a while finds frames too, but has looked at them all in a fraction of this.
constexpr std::int64_t flood_ns = 100'000'000;
// Who floods a bus shares CPUs with the bench: it may have seen them all for a moment.
constexpr std::int64_t break_ns = 20'000'000;

}  // namespace

std::string words(const Flood& flood) {
  const std::string id = flood.extended ? fmt::format("{:08X}", flood.id) : fmt::format("{:03X}", flood.id);
  return fmt::format("the bus was flooded by id {}: {} of {} frames in {:.2f} s", id, flood.of_id,
                     flood.frames, static_cast<double>(flood.duration_ns) * 1e-9);
}

void Backlog::pause(bool more, std::int64_t now_ns) {
  more_ = more;
  if (since_ns_ && now_ns - last_ns_ > break_ns) {
    since_ns_.reset();
    frames_.clear();
  }
  if (!more) return;
  last_ns_ = now_ns;
  if (!since_ns_) since_ns_ = now_ns;
  const std::int64_t duration_ns = now_ns - *since_ns_;
  if (duration_ns < flood_ns || (longest_ && duration_ns <= longest_->duration_ns)) return;
  Flood flood{.duration_ns = duration_ns};
  for (const auto& [id, count] : frames_) {
    flood.frames += count;
    if (count <= flood.of_id) continue;
    flood.of_id = count;
    std::tie(flood.id, flood.extended) = id;
  }
  longest_ = flood;
}

}  // namespace canhil::run
