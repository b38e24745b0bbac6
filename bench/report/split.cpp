#include "bench/report/split.hpp"

namespace canhil::report {
namespace {

std::optional<double> mean_s(std::int64_t sum_ns, std::uint64_t count) {
  if (count == 0) return std::nullopt;
  return static_cast<double>(sum_ns) / static_cast<double>(count) * 1e-9;
}

}  // namespace

std::vector<SplitPart> parts(const checks::TimingRecord& timing) {
  const checks::LatencySplit& split = timing.split;
  const bool wire_known = timing.wire.rates.nominal > 0;
  const auto on_wire = [&](std::int64_t sum_ns, std::uint64_t count) {
    return wire_known ? mean_s(sum_ns, count) : std::nullopt;
  };
  const auto stimulus_wire = on_wire(split.stimulus_wire_ns, split.echoed);
  const auto to_echo = mean_s(split.to_echo_ns, split.echoed);
  const auto queue = mean_s(split.target_queue_ns, split.told);
  const auto compute = mean_s(split.target_compute_ns, split.told);
  const auto reply_wire = on_wire(split.reply_wire_ns, split.stimuli);
  std::optional<double> wait, rest = mean_s(split.latency_ns, split.stimuli);
  if (to_echo) wait = *to_echo - stimulus_wire.value_or(0);
  if (rest) rest = *rest - queue.value_or(0) - compute.value_or(0) - reply_wire.value_or(0);
  return {{"stimulus_wait", "stimulus: driver of the bench, wait for the bus", wait},
          {"stimulus_wire", "stimulus: its last frame on the wire", stimulus_wire},
          {"target_queue", "target: from its stamp to its turn", queue},
          {"target_compute", "target: computing", compute},
          {"reply_wire", "answer: its frames on the wire", reply_wire},
          {"not_explained", "not explained: drivers, sending, wait for the bus", rest}};
}

std::string_view what_of(std::string_view key) {
  for (const SplitPart& part : parts({})) {
    if (part.key == key) return part.what;
  }
  return key;
}

double total_s(const checks::LatencySplit& split) {
  return mean_s(split.to_echo_ns, split.echoed).value_or(0) +
         mean_s(split.latency_ns, split.stimuli).value_or(0);
}

}  // namespace canhil::report
