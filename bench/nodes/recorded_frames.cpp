// The frames of a log with canhil's DBC, and the node that sends them again.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/nodes/is_whole.hpp"
#include "bench/nodes/recorded.hpp"
#include "bench/nodes/registry.hpp"
#include "bench/nodes/sample_decoder.hpp"
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
  Reading(const NodeTable& table, std::string log)
      : closes_(*table.closes), log_(std::move(log)), samples_(kind_of(table)) {}

  Result<void> take(const LogEntry& entry) {
    const std::size_t index = index_++;
    if (is_whole<Sync>(entry.frame)) return synchronise(entry);
    if (!samples_.has(entry.frame)) return {};
    group_.frames.frames.push_back({.due_us = entry.t_ns, .index = index, .frame = entry.frame});
    if (const auto sample = samples_.take(entry.frame)) valid_us_.push_back(sample->valid_us);
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

  const MessageInfo& closes_;
  std::string log_;
  SampleDecoder samples_;
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

/// The samples that the frames of a log carry.
class Logged final : public sensors::Sensor {
 public:
  Logged(const NodeSettings& node, const Run& run) {
    SampleDecoder decoder(kind_of(node.table()));
    for (const RecordedFrames::At& at : node.own<RecordedSettings>()->frames->frames) {
      if (at.due_us > run.flight.end_us()) break;
      const auto sample = decoder.take(at.frame);
      if (!sample) continue;
      for (int lost = 0; lost < decoder.lost(); ++lost) {
        samples_.emplace_back(at.due_us, *sample);
        samples_.back().second.fate = sensors::Sample::Fate::lost;
      }
      samples_.emplace_back(at.due_us, *sample);
    }
  }

  [[nodiscard]] std::int64_t due_us() const override {
    return next_ == samples_.size() ? never_us : samples_[next_].first;
  }
  sensors::Sample measure() override { return samples_[next_++].second; }

 private:
  std::vector<std::pair<std::int64_t, sensors::Sample>> samples_;  // with the times at which they were sent
  std::size_t next_ = 0;
};

}  // namespace

std::unique_ptr<sensors::Sensor> make_logged(const NodeSettings& node, const Run& run) {
  return std::make_unique<Logged>(node, run);
}

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
