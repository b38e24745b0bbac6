#include "bench/checks/wire_bounds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "bench/checks/timing.hpp"
#include "bench/schedulability/analysis.hpp"
#include "dbc/wire/arbitration.hpp"
#include "dbc/wire/carriers.hpp"

namespace canhil::checks {
namespace {

using schedulability::Stream;

bool was_seen(const TimingRecord& timing, std::size_t index) {
  return timing.transmit[index].handed_over.count() > 0 || timing.answers[index].last_ns;
}

// The period for the analysis: the shorter one of the period in the DBC and the observed period.
std::int64_t period_ns(const Observations& seen, const MessageInfo& info) {
  const std::int64_t cycle_ns = info.cycle_time_us * 1000;
  double sent_s = nominal_period_s(seen, info.name);
  if (const auto stimuli = seen.stimuli.find(info.sample_group);
      stimuli != seen.stimuli.end() && stimuli->second.count > 1) {
    sent_s = static_cast<double>(stimuli->second.last_us - stimuli->second.first_us) * 1e-6 /
             static_cast<double>(stimuli->second.count - 1);
  }
  const auto sent_ns = static_cast<std::int64_t>(std::floor(sent_s * 1e9));
  if (cycle_ns == 0 || sent_ns == 0) return std::max(cycle_ns, sent_ns);
  return std::min(cycle_ns, sent_ns);
}

// The number of frames of a message that are queued together. Several estimators on one target each send a
// heartbeat, at the same time.
std::int64_t together(const Observations& seen, const AnswerTiming& timing, std::int64_t period_ns) {
  const std::int64_t run_ns = seen.last_ns - seen.first_ns;
  if (timing.count == 0 || run_ns <= 0) return 1;
  const double in_a_period =
      static_cast<double>(timing.count) * static_cast<double>(period_ns) / static_cast<double>(run_ns);
  return std::max<std::int64_t>(1, std::llround(in_a_period));
}

// All frames of the bench go through one queue. The messages of a container are sent together, at one rate.
Stream stream_of(const Observations& seen, const wire::Carrier& carrier) {
  const std::size_t index = carrier.first;
  const MessageInfo& info = seen.timing.messages[index];
  const std::int64_t period = period_ns(seen, info);
  const std::int64_t burst = info.answers.empty() ? together(seen, seen.timing.answers[index], period) : 1;
  return {.name = std::string(carrier.name),
          .id = info.id,
          .extended = info.extended,
          .sender = is_targets(info) ? "target" : "bench",
          .period_ns = period / burst,
          .jitter_ns = (burst - 1) * (period / burst),  // so that `burst` frames may be queued at once
          .length = carrier.longest};
}

// The analysis counts the response time from the release of a frame, and the jitter is the time from the
// release to the queueing. So the response time minus the jitter is the time from the queueing to the end of
// the frame.
std::optional<std::int64_t> from_queued(const Stream& stream, const schedulability::Response& response) {
  if (!response.response_ns) return std::nullopt;
  return *response.response_ns - stream.jitter_ns;
}

}  // namespace

std::vector<WireBound> wire_bounds(const Observations& seen) {
  const TimingRecord& timing = seen.timing;
  if (timing.wire.rates.nominal == 0) return {};
  const std::vector<wire::Carrier> all = wire::carriers_of(timing.messages, timing.wire.fd);
  // The carriers sorted by priority.
  std::map<std::uint32_t, wire::Carrier> carriers;
  for (std::size_t i = 0; i < timing.messages.size(); ++i) {
    const wire::Carrier& carrier = all[i];
    const MessageInfo& first = timing.messages[carrier.first];
    if (was_seen(timing, i)) carriers.emplace(wire::arbitration_rank(first.id, first.extended), carrier);
  }
  std::vector<Stream> streams;
  for (const auto& [rank, carrier] : carriers) streams.push_back(stream_of(seen, carrier));
  const auto responses = timing.wire.urgent_first
                             ? schedulability::responses(streams, {.rates = timing.wire.rates})
                             : schedulability::fifo_responses(streams, timing.wire.rates);
  std::vector<WireBound> bounds;
  std::size_t k = 0;
  for (const auto& [rank, carrier] : carriers) {
    const Stream& stream = streams[k];
    const schedulability::Response& response = responses[k++];
    const WireResponse& measured = timing.responses[carrier.first];
    if (measured.count == 0) continue;
    bounds.push_back({.message = carrier.name,
                      .of_target = is_targets(timing.messages[carrier.first]),
                      .count = measured.count,
                      .longest_ns = measured.max_ns,
                      .frame_ns = response.transmission_ns,
                      .bound_ns = from_queued(stream, response)});
  }
  return bounds;
}

std::string no_bounds(const Observations& seen) {
  if (seen.timing.wire.rates.nominal == 0) return "the bit rate of this bus is not known";
  if (seen.bus.errors.frames > 0) return fmt::format("{} errors on the bus", seen.bus.errors.frames);
  if (seen.bus.downs > 0) return "the interface was down";
  if (!seen.transmit_stamps_echoed) return "the bus does not echo the bench's own frames";
  return "";
}

}  // namespace canhil::checks
