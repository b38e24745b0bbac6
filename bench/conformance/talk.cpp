#include "bench/conformance/talk.hpp"

#include "bench/drive/session.hpp"

#include "bench/conformance/groups.hpp"
#include "bench/world/stoppable.hpp"

namespace canhil::conformance {
namespace {

using namespace messages;

}  // namespace

Result<std::unique_ptr<Talk>> Talk::open(const scenario::Scenario& scenario, const std::string& target,
                                         const std::atomic<bool>& stop) {
  const world::Stoppable stoppable(stop);
  auto truth = drive::make_truth(scenario);
  if (!truth) return tl::unexpected(truth.error());
  auto flight = drive::make_flight(scenario, *truth, 0);
  if (!flight) return tl::unexpected(flight.error());
  const drive::Options options = drive::in_lockstep_against(target);
  auto buses = drive::open_buses(options.bus, {}, BusFormat::classic);
  if (!buses) return tl::unexpected(buses.error());
  auto started = drive::start_target(target, options.bus.text);
  if (!started) return tl::unexpected(started.error());
  auto talk = std::make_unique<Talk>(scenario, std::move(*truth), std::move(*flight), std::move(*buses),
                                     std::move(*started), stop);
  constexpr int attempts = 3;  // the target may still be starting
  for (int i = 0; i < attempts; ++i) {
    if (talk->hear<TargetHeartbeat>([](const auto&) { return true; })) return talk;
    if (const auto end = talk->target_.ended())
      return failure(fmt::format("target '{}': {} before its first heartbeat", target, to_text(*end)));
    if (stop) return failure("interrupted");
  }
  return failure(fmt::format("target '{}': no heartbeat within {} s, expected a target", target,
                             attempts * answer_ns / 1'000'000'000));
}

Talk::Talk(const scenario::Scenario& scenario, world::FlightRecord truth, drive::Flight flight,
           drive::OpenBuses buses, processes::ChildProcess target, const std::atomic<bool>& stop)
    : scenario_(scenario),
      truth_(std::move(truth)),
      flight_(std::move(flight)),
      notes_(std::move(buses.notes)),
      port_(std::move(buses.port)),
      link_(*port_),
      target_(std::move(target)),
      stop_(stop),
      attached_(link_, listener_) {}

TargetCommand Talk::command(Command what) const {
  const scenario::TargetSetup& setup = scenario_.targets.front();
  return {.command = what,
          .estimator = from_name<Estimator>(setup.estimator).value_or(Estimator::none),
          .algorithm = from_name<Algorithm>(setup.algorithm).value_or(Algorithm::kalman),
          .dbc_hash = exchange_hash24(setup.estimator)};
}

void Talk::send() {
  for (const Frame& frame : out_.frames()) {
    if (frame.id == TargetCommand::info.id) last_counter_ = e2e::counter(frame.payload());
    send(frame);
  }
}

void Talk::send(Frame frame) {
  if (shift_us_ != 0) conformance::shift_time(frame, shift_us_);
  static_cast<void>(link_.send(frame, patience_ns));
}

void Talk::send_state(const std::function<bool(const Frame&)>& sent) {
  listener_.frames.clear();
  out_.clear();
  drive::send(flight_.initial.front(), out_);
  for (const Frame& frame : out_.frames()) {
    if (sent(frame)) send(frame);
  }
}

void Talk::send_time() {
  listener_.frames.clear();
  send(to_frame(Sync{.lockstep = 1},
                e2e::counter_period - 1));  // so that the first counter of the flight is 0
}

void Talk::send_damaged(int frames) {
  Frame frame = to_frame(ParamSet{}, 0);
  frame.data[0] ^= 0xFFU;
  // Each time that this number of frames has been sent, waits until the target has read them: the embedded
  // bus drops a node that blocks the bus.
  constexpr int at_once = 128;
  for (int i = 0; i < frames; ++i) {
    static_cast<void>(link_.send(frame, patience_ns));
    if (stop_) return;
    if (i % at_once != at_once - 1) continue;
    send(command(Command::none));
    static_cast<void>(hear<TargetHeartbeat>([](const auto&) { return true; }));
  }
}

bool Talk::waits_for(TargetState state) {
  return hear<TargetHeartbeat>([&](const auto& one) { return one.state == state; }).has_value();
}

std::optional<ParamAck> Talk::set(messages::Parameter parameter, double value) {
  send(ParamSet{.parameter = parameter, .value = static_cast<float>(value)});
  return hear<ParamAck>([&](const auto& one) { return one.parameter == parameter; });
}

std::string Talk::reset() {
  const TargetCommand wanted = command(Command::reset);
  send(wanted);
  const auto beat = hear<TargetHeartbeat>([&](const auto& one) {
    return one.state == TargetState::idle && one.estimator == wanted.estimator &&
           one.algorithm == wanted.algorithm;
  });
  if (!beat) return "reset: no heartbeat says idle with the commanded estimator and algorithm";
  for (const scenario::Parameter& parameter : scenario_.targets.front().parameters) {
    const auto name = from_name<messages::Parameter>(parameter.name);
    const auto ack = name ? set(*name, parameter.value) : std::nullopt;
    // A target need not have a parameter that only a sensor's data sheet sets, as in drive::handshake.
    if (ack && parameter.stated && ack->status == ParameterStatus::unknown) continue;
    if (!ack || ack->status != ParameterStatus::accepted)
      return fmt::format("{} = {:g}: {}", parameter.name, parameter.value,
                         ack ? name_of(ack->status) : "no answer");
  }
  begin_flight();
  return "";
}

std::string Talk::make_ready() {
  if (auto wrong = reset(); !wrong.empty()) return wrong;
  send_state();
  return waits_for(TargetState::ready) ? "" : "the initial state: no heartbeat says ready";
}

std::string Talk::start() {
  send(command(Command::start));
  return waits_for(TargetState::running) ? "" : "start: no heartbeat says running";
}

void Talk::begin_flight() {
  schedule_.reset(
      new drive::Schedule(drive::make_schedule(scenario_, truth_, flight_.per_run_truth, 0, true)));
  flown_us_ = 0;
  closed_ = true;
}

// Waits until the target has completed the step (StepDone); false: it did not do so within `step_ns`.
bool Talk::closes(std::uint16_t step) {
  const std::int64_t deadline_ns = link_.now_ns() + step_ns;
  const auto closed = [&] {
    // Clang 14 cannot compile std::views::reverse. NOLINTNEXTLINE(modernize-loop-convert)
    for (auto one = listener_.frames.rbegin(); one != listener_.frames.rend(); ++one) {
      if (const auto done = protocol::decode_from_target<StepDone>(*one)) return done->step == step;
    }
    return false;
  };
  for (static_cast<void>(link_.drain()); !closed(); static_cast<void>(link_.drain())) {
    if (over(deadline_ns)) return false;
  }
  return true;
}

bool Talk::over(std::int64_t deadline_ns) {
  constexpr std::int64_t look_period_ns = 50'000'000;
  const std::int64_t now_ns = link_.now_ns();
  if (stop_ || now_ns >= deadline_ns) return true;
  link_.wait_until(std::min(deadline_ns, now_ns + look_period_ns));
  return false;
}

std::string Talk::gone() {
  const auto end = target_.ended();
  return end ? "target: " + to_text(*end) : "";
}

std::string Talk::end() {
  if (std::string why = gone(); !why.empty()) return why;
  const std::string wrong = drive::wrong_end(target_.end(processes::ChildProcess::usual_patience));
  return wrong.empty() ? "" : "target: " + wrong;
}

int Talk::fly(std::int64_t duration_us, const Tamper& tamper) {
  listener_.frames.clear();
  flown_.clear();
  flown_us_ += duration_us;
  std::vector<Frame> instead;
  while (closed_ && schedule_->due_us() <= flown_us_) {
    std::optional<std::uint16_t> step;
    for (const Frame& frame : schedule_->take()) {
      flown_.push_back(frame);
      if (shift_us_ != 0) conformance::shift_time(flown_.back(), shift_us_);
      if (frame.id == Sync::info.id) step = from_frame<Sync>(frame).step;
      instead.clear();
      if (tamper) {
        tamper(frame, instead);
      } else {
        instead.push_back(frame);
      }
      for (const Frame& one : instead) send(one);
    }
    if (step) closed_ = closes(*step);
  }
  return static_cast<int>(answers().size());
}

std::vector<Frame> Talk::heard() const {
  std::vector<Frame> all;
  for (const Received& received : listener_.frames) all.push_back(received.frame);
  while (!all.empty() && all.back().id != StepDone::info.id) all.pop_back();
  return all;
}

std::vector<Frame> Talk::answers() const {
  std::vector<Frame> all;
  for (const Received& received : listener_.frames) {
    const MessageInfo* info = find_message(received.frame.id, received.frame.extended);
    if (info != nullptr && !info->answers.empty()) all.push_back(received.frame);
  }
  return all;
}

}  // namespace canhil::conformance
