// The frames of a log with canhil's DBC, and the node that sends them again.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/nodes/is_whole.hpp"
#include "bench/nodes/recorded.hpp"
#include "bench/nodes/recorded_group.hpp"
#include "bench/scenario/table.hpp"
#include "dbc/ports/fd_groups.hpp"
#include "dbc/wire/time_base.hpp"

namespace canhil::nodes {
namespace {

using messages::Sync;

double seconds(std::int64_t us) { return 1e-6 * static_cast<double>(us); }

/// A Sync of the log: the bench's time and the log's stamp.
struct TimeMark {
  std::int64_t t_us = 0;
  std::int64_t stamp_ns = 0;
};

/// Frames between two Syncs are due between the times of the two Syncs, interpolated by time stamp. They are
/// due strictly after the earlier Sync: a frame that is due at the same time as the Sync would be sent before
/// it.
std::int64_t due_us(const TimeMark& before, const TimeMark& after, std::int64_t stamp_ns) {
  const auto whole = static_cast<double>(after.stamp_ns - before.stamp_ns);
  const double share = whole > 0 ? static_cast<double>(stamp_ns - before.stamp_ns) / whole : 1;
  const std::int64_t t_us = before.t_us + std::llround(share * static_cast<double>(after.t_us - before.t_us));
  return std::clamp(t_us, before.t_us + 1, std::max(after.t_us, before.t_us + 1));
}

/// Reads a log frame by frame.
class Reading {
 public:
  Reading(const NodeTable& table, std::string log) : closes_(table.closes), log_(std::move(log)) {
    each_message(closes_, [&]<class Message>() { ids_.push_back(Message::info.id); });
  }

  Result<void> take(const LogEntry& entry) {
    const std::size_t index = index_++;
    if (is_whole<Sync>(entry.frame)) return synchronise(entry);
    if (entry.frame.extended || entry.frame.error || std::ranges::find(ids_, entry.frame.id) == ids_.end())
      return {};
    group_.frames.frames.push_back({.due_us = entry.t_ns, .index = index, .frame = entry.frame});
    if (is_closing_whole(entry.frame)) valid_us_.push_back(valid_us(entry.frame));
    return {};
  }

  Result<LoggedGroup> finish(std::int64_t end_us) && {
    if (!synchronised_)
      return failure(fmt::format("{}: has no Sync, expected the log of a run, which has a time base", log_));
    group_.frames.frames.resize(placed_);  // drops frames after the last Sync: their time is unknown
    if (valid_us_.size() < 2)
      return failure(fmt::format("{}: has {} samples of {}, expected those of a run", log_, valid_us_.size(),
                                 closes_.sample_group.empty() ? closes_.name : closes_.sample_group));
    if (last_.t_us < end_us)
      return failure(fmt::format("{}: ends at {:g} s of its time base, expected the {:g} s of the run", log_,
                                 seconds(last_.t_us), seconds(end_us)));
    group_.median_us = scenario::median_step(valid_us_);
    return std::move(group_);
  }

 private:
  Result<void> synchronise(const LogEntry& entry) {
    const TimeMark now{.t_us = static_cast<std::int64_t>(from_frame<Sync>(entry.frame).time_us),
                       .stamp_ns = entry.t_ns};
    if (synchronised_ && now.t_us <= last_.t_us)
      return failure(fmt::format("{}: Sync goes from {:g} s back to {:g} s, expected the log of one run",
                                 log_, seconds(last_.t_us), seconds(now.t_us)));
    const TimeMark before = synchronised_ ? last_ : TimeMark{.t_us = now.t_us - 1, .stamp_ns = now.stamp_ns};
    for (; placed_ < group_.frames.frames.size(); ++placed_) {
      auto& frame = group_.frames.frames[placed_];
      frame.due_us = due_us(before, now, frame.due_us);
    }
    last_ = now;
    synchronised_ = true;
    return {};
  }

  [[nodiscard]] bool is_closing_whole(const Frame& frame) const {
    bool whole = false;
    each_message(closes_, [&]<class Message>() {
      whole = whole || (Message::info.id == closes_.id && is_whole<Message>(frame));
    });
    return whole;
  }

  /// The full time of validity. The frame carries this time modulo a period; the previous time of validity
  /// determines the number of whole periods.
  std::int64_t valid_us(const Frame& frame) {
    std::int64_t t_us = 0;
    each_message(closes_, [&]<class Message>() {
      if (Message::info.id != closes_.id) return;
      const auto message = from_frame<Message>(frame);
      Message::visit(message, [&](const SignalInfo& signal, const auto& member) {
        using Member = std::remove_cvref_t<decltype(member)>;
        if (role_of(signal) != Role::time_of_validity) return;
        constexpr std::int64_t period_us =
            std::is_floating_point_v<Member> ? short_period_us : std::int64_t{1} << 32U;
        const std::int64_t before_us = valid_us_.empty() ? 0 : valid_us_.back();
        const std::int64_t on_us = (static_cast<std::int64_t>(member) - before_us) % period_us;
        t_us = before_us + (on_us < 0 ? on_us + period_us : on_us);
      });
    });
    return t_us;
  }

  const MessageInfo& closes_;
  std::string log_;
  std::vector<std::uint32_t> ids_;
  LoggedGroup group_;
  std::vector<std::int64_t> valid_us_;  // of complete samples
  std::size_t index_ = 0;
  std::size_t placed_ = 0;  // number of frames whose due time is known
  TimeMark last_;
  bool synchronised_ = false;
};

/// Sends the frames of one log. All recorded nodes of the log share this node, so the frames keep the order
/// of the log.
class Frames final : public Node {
 public:
  Frames(const std::vector<const RecordedFrames*>& of_one_log, const Run& run)
      : end_us_(run.flight.end_us()) {
    for (const RecordedFrames* own : of_one_log)
      frames_.insert(frames_.end(), own->frames.begin(), own->frames.end());
    std::ranges::sort(frames_, {}, &RecordedFrames::At::index);
  }

  [[nodiscard]] std::int64_t due_us() const override {
    return next_ == frames_.size() || frames_[next_].due_us > end_us_ ? never_us : frames_[next_].due_us;
  }
  void transmit(Transmission& out) override { out.put(frames_[next_++].frame); }

 private:
  std::vector<RecordedFrames::At> frames_;
  std::int64_t end_us_;
  std::size_t next_ = 0;
};

}  // namespace

Result<LoggedGroup> read_frames(const NodeTable& table, const std::string& log, std::int64_t end_us) {
  auto opened = LogReader::open(log);
  if (!opened) return tl::unexpected(opened.error());
  ClassicLogReader reader(std::move(*opened));
  Reading reading(table, log);
  for (;;) {
    const auto entry = reader.next();
    if (!entry) return tl::unexpected(entry.error());
    if (!*entry) return std::move(reading).finish(end_us);
    if (auto taken = reading.take(**entry); !taken) return tl::unexpected(taken.error());
  }
}

std::unique_ptr<Node> make_frames(const std::vector<const RecordedFrames*>& of_one_log, const Run& run) {
  return std::make_unique<Frames>(of_one_log, run);
}

}  // namespace canhil::nodes
