#include "bench/accept/talk.hpp"

#include "bench/drive/session.hpp"

namespace canhil::accept {
namespace {

using namespace messages;

}  // namespace

Result<std::unique_ptr<Talk>> Talk::open(const scenario::Scenario& scenario, const std::string& target) {
  auto truth = drive::make_truth(scenario);
  if (!truth) return tl::unexpected(truth.error());
  auto flight = drive::make_flight(scenario, *truth, 0);
  if (!flight) return tl::unexpected(flight.error());
  const drive::Options options = drive::in_lockstep_against(target);
  auto buses = drive::open_buses(options.bus, {}, BusFormat::classic);
  if (!buses) return tl::unexpected(buses.error());
  auto started = drive::TargetProcess::start(target, options.bus.text);
  if (!started) return tl::unexpected(started.error());
  auto talk = std::make_unique<Talk>(scenario, std::move(*truth), std::move(*flight), std::move(*buses),
                                     std::move(*started));
  for (int second = 0; second < 5; ++second) {  // it may still be starting
    if (talk->hear<TargetHeartbeat>([](const auto&) { return true; })) return talk;
  }
  return failure(fmt::format("{}: no heartbeat within 5 s, expected a target", target));
}

Talk::Talk(const scenario::Scenario& scenario, world::FlightRecord truth, drive::Flight flight,
           drive::OpenBuses buses, drive::TargetProcess target)
    : scenario_(scenario),
      truth_(std::move(truth)),
      flight_(std::move(flight)),
      notes_(std::move(buses.notes)),
      port_(std::move(buses.port)),
      link_(*port_),
      target_(std::move(target)),
      attached_(link_, ear_) {}

TargetCommand Talk::command(Command what) const {
  const scenario::TargetSetup& setup = scenario_.targets.front();
  return {.command = what,
          .estimator = from_name<Estimator>(setup.estimator).value_or(Estimator::none),
          .algorithm = from_name<Algorithm>(setup.algorithm).value_or(Algorithm::kalman),
          .dbc_hash = dbc_hash24};
}

void Talk::send() {
  for (const Frame& frame : out_.frames()) {
    if (frame.id == TargetCommand::info.id) last_counter_ = e2e::counter(frame.payload());
    static_cast<void>(link_.send(frame, patience_ns));
  }
}

void Talk::tell_state() {
  ear_.frames.clear();
  out_.clear();
  drive::send(flight_.initial.front(), out_);
  send();
}

void Talk::tell_damaged(int frames) {
  Frame frame = to_frame(Sync{}, 0);
  frame.data[0] ^= 0xFFU;
  for (int i = 0; i < frames; ++i) {
    static_cast<void>(link_.send(frame, patience_ns));
    if (i % 64 == 0) static_cast<void>(link_.drain());
  }
}

bool Talk::waits_for(TargetState state) {
  return hear<TargetHeartbeat>([&](const auto& one) { return one.state == state; }).has_value();
}

std::optional<ParamAck> Talk::set(const std::string& parameter, double value) {
  const auto name = from_name<messages::Parameter>(parameter);
  if (!name) return std::nullopt;
  tell(ParamSet{.parameter = *name, .value = static_cast<float>(value)});
  return hear<ParamAck>([&](const auto& one) { return one.parameter == *name; });
}

std::string Talk::reset() {
  const TargetCommand wanted = command(Command::reset);
  tell(wanted);
  const auto beat = hear<TargetHeartbeat>([&](const auto& one) {
    return one.state == TargetState::idle && one.estimator == wanted.estimator &&
           one.algorithm == wanted.algorithm;
  });
  if (!beat) return "reset: no heartbeat says idle with the estimator and algorithm told";
  for (const scenario::Parameter& parameter : scenario_.targets.front().parameters) {
    const auto ack = set(parameter.name, parameter.value);
    if (!ack || ack->status != ParameterStatus::accepted)
      return fmt::format("{} = {:g}: {}", parameter.name, parameter.value,
                         ack ? name_of(ack->status) : "no answer");
  }
  begin_flight();
  return "";
}

std::string Talk::make_ready() {
  if (auto wrong = reset(); !wrong.empty()) return wrong;
  tell_state();
  return waits_for(TargetState::ready) ? "" : "the initial state: no heartbeat says ready";
}

std::string Talk::start() {
  tell(command(Command::start));
  return waits_for(TargetState::running) ? "" : "start: no heartbeat says running";
}

void Talk::begin_flight() {
  schedule_.reset(new drive::Schedule(drive::make_schedule(scenario_, truth_, flight_.own_truth, 0, true)));
  flown_us_ = 0;
}

int Talk::fly(std::int64_t duration_us) {
  ear_.frames.clear();
  flown_us_ += duration_us;
  while (schedule_->due_us() <= flown_us_) {
    std::optional<std::uint16_t> step;
    for (const Frame& frame : schedule_->take()) {
      if (frame.id == Sync::info.id) step = from_frame<Sync>(frame).step;
      static_cast<void>(link_.send(frame, patience_ns));
    }
    if (!step) continue;
    const std::int64_t deadline_ns = link_.now_ns() + step_ns;
    const auto closed = [&] {
      for (auto one = ear_.frames.rbegin(); one != ear_.frames.rend(); ++one) {
        if (const auto done = observe::heard<StepDone>(*one)) return done->step == *step;
      }
      return false;
    };
    for (static_cast<void>(link_.drain()); !closed() && link_.now_ns() < deadline_ns;
         static_cast<void>(link_.drain()))
      link_.wait_until(deadline_ns);
  }
  return static_cast<int>(answers().size());
}

std::vector<Frame> Talk::answers() const {
  std::vector<Frame> all;
  for (const Received& received : ear_.frames) {
    const MessageInfo* info = find_message(received.frame.id, received.frame.extended);
    if (info != nullptr && !info->answers.empty()) all.push_back(received.frame);
  }
  return all;
}

}  // namespace canhil::accept
