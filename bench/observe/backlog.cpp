#include "bench/observe/backlog.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace canhil::observe {
namespace {

// A backlog that lasts at least this long is a flood. A bench that had no CPU for a while also finds a
// backlog, but the bench processes such a backlog in a fraction of this time.
constexpr std::int64_t flood_ns = 100'000'000;
// The longest pause within a flood. The flooding program may share CPUs with the bench, so the backlog may be
// empty for a moment.
constexpr std::int64_t break_ns = 20'000'000;

}  // namespace

std::string to_text(const Flood& flood) {
  return fmt::format("the bus was flooded by {} in {:.2f} s", flood.whose,
                     static_cast<double>(flood.duration_ns) * 1e-9);
}

void Shares::add(const Frame& frame) {
  ++frames_;
  if (frame.error) {
    ++error_frames_;
    return;
  }
  const std::pair id{frame.id, frame.extended};
  if (const auto known = by_id_.find(id); known != by_id_.end())
    ++known->second;
  else if (by_id_.size() < most_ids)
    by_id_.emplace(id, 1);
}

void Shares::clear() { *this = {}; }

std::string Shares::to_text() const {
  if (2 * error_frames_ >= frames_)
    return fmt::format("error frames: {} of {} frames", error_frames_, frames_);
  const auto most = std::ranges::max_element(by_id_, {}, [](const auto& one) { return one.second; });
  const auto [id, extended] = most->first;
  const std::string all =
      fmt::format(", the most of {}{} ids", by_id_.size() == most_ids ? "more than " : "", by_id_.size());
  return fmt::format("id {:0{}X}: {} of {} frames{}", id, extended ? 8 : 3, most->second, frames_,
                     2 * most->second < frames_ ? all : "");
}

void Backlog::pause(bool more, bool overflowed, std::int64_t now_ns) {
  more_ = more;
  if (since_ns_ && !overflowed && now_ns - last_ns_ > break_ns) {
    since_ns_.reset();
    shares_.clear();
  }
  if (!more) return;
  last_ns_ = now_ns;
  if (!since_ns_) since_ns_ = now_ns;
  const std::int64_t duration_ns = now_ns - *since_ns_;
  if (duration_ns < flood_ns || (longest_ && duration_ns <= longest_->duration_ns)) return;
  longest_ = Flood{.duration_ns = duration_ns, .whose = shares_.to_text()};
}

}  // namespace canhil::observe
