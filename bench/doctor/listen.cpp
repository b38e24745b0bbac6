#include "bench/doctor/listen.hpp"

#include <fmt/format.h>

#include <ctime>
#include <optional>

#include "dbc/wire/transmit.hpp"
#include "messages/canhil.hpp"

namespace canhil::doctor {
namespace {

using messages::TargetHeartbeat;

Line target_line(const std::optional<TargetHeartbeat>& beat) {
  if (!beat)
    return {
        Grade::weak, "target", "no heartbeat received",
        "start it (`hil-target --bus ...`), or let the bench start one; then look at wiring and bit rate"};
  const std::string found =
      fmt::format("{}, DBC hash {:06x}", messages::name_of(beat->state), beat->dbc_hash);
  const std::uint32_t own = messages::exchange_hash24(messages::name_of(beat->estimator));
  if (beat->dbc_hash == own) return {Grade::good, "target", found + " as in this bench"};
  return {Grade::bad, "target", fmt::format("{}, this bench has {:06x}", found, own),
          "build target and bench from the same DBC file"};
}

}  // namespace

std::vector<Line> listen(Port& port, std::int64_t duration_ns, const std::function<bool()>& stop) {
  const std::int64_t end_ns = clock_ns(CLOCK_MONOTONIC) + duration_ns;
  std::uint64_t frames = 0, errors = 0;
  std::optional<TargetHeartbeat> beat;
  while (!stop() && clock_ns(CLOCK_MONOTONIC) < end_ns && !port.closed()) {
    const auto received = port.receive();
    if (!received) {
      wait(port, WaitFor::frame, end_ns);
      continue;
    }
    ++(received->frame.error ? errors : frames);
    if (!received->frame.error && !received->frame.extended && received->frame.id == TargetHeartbeat::info.id)
      beat = from_frame<TargetHeartbeat>(received->frame);
  }
  const double per_s = static_cast<double>(frames) / (static_cast<double>(duration_ns) * 1e-9);
  std::vector<Line> lines{
      {Grade::good, "traffic", fmt::format("{:.0f} frames/s, {} error frames", per_s, errors)}};
  if (errors > 0) {
    lines.front().grade = Grade::weak;
    lines.front().remedy = "look at wiring, termination, bit rate and sample point";
  }
  lines.push_back(target_line(beat));
  return lines;
}

}  // namespace canhil::doctor
