#include "bench/drive/handshake.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>

#include "bench/drive/dialect.hpp"
#include "bench/drive/target_dialogue.hpp"
#include "bench/protocol/heartbeat_errors.hpp"
#include "target/device/device.hpp"

namespace canhil::drive {
namespace {

using namespace messages;

constexpr std::int64_t several_syncs_ns = 8 * Sync::info.cycle_time_us * 1000;

TargetCommand command(Command what, Estimator estimator, Algorithm algorithm) {
  return {.command = what,
          .estimator = estimator,
          .algorithm = algorithm,
          .dbc_hash = exchange_hash24(name_of(estimator))};
}

// The range in hil-target; another target may accept another range.
std::string range_of(Estimator estimator, Parameter parameter) {
  const auto range = target::Device().range(estimator, parameter);
  if (!range) return "a value in its range";
  return fmt::format("a {}number from {:g} to {:g}", range->whole ? "whole " : "", range->minimum,
                     range->maximum);
}

// The algorithms of hil-target; another target may have others.
std::string algorithms_of(Estimator estimator) {
  target::Device device;
  Outbox<1> out;
  std::vector<std::string_view> names;
  for (const Algorithm algorithm : enumerators<Algorithm>) {
    out.clear();
    out.send(command(Command::reset, estimator, algorithm));
    const auto answers = device.receive(out.frames().front());
    if (from_frame<TargetHeartbeat>(answers.front()).error_command == 0) names.push_back(name_of(algorithm));
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

// Explains why the target refused a parameter. Names the expected value and, if there is one, the value that
// stays in force.
std::string refusal(const ParamAck& ack, Estimator estimator) {
  const auto in_force = static_cast<double>(ack.value);
  switch (ack.status) {
    case ParameterStatus::out_of_range:
      return fmt::format("out_of_range, expected {}; {:g} stays in force", range_of(estimator, ack.parameter),
                         in_force);
    case ParameterStatus::unknown:
      return fmt::format("unknown, expected a parameter of {}", name_of(estimator));
    case ParameterStatus::wrong_state:
      return fmt::format("wrong_state, expected to be set before the start; {:g} stays in force", in_force);
    case ParameterStatus::accepted:
      break;
  }
  return fmt::format("status {}, which is not in the DBC", static_cast<int>(ack.status));
}

Result<void> set_parameter(Dialogue& dialogue, Estimator estimator, const scenario::Parameter& wanted) {
  const auto parameter = from_name<Parameter>(wanted.name);
  if (!parameter) return failure(fmt::format("{}: not in the DBC", wanted.where));
  const auto value = static_cast<float>(wanted.value);
  auto answered = dialogue.until(
      {.doing = fmt::format("setting parameter '{}'", wanted.name),
       .awaited = "ParamAck for it",
       .limit_ns = answer_limit_ns},
      [&](nodes::Transmission& out) { out.send(ParamSet{.parameter = *parameter, .value = value}); },
      [&](const Mailbox& box) {
        return box.acknowledgement && box.acknowledgement->parameter == *parameter;
      });
  if (!answered) return answered;
  const ParamAck& ack = *dialogue.mailbox().acknowledgement;
  if (wanted.stated && ack.status == ParameterStatus::unknown) return {};
  if (ack.status != ParameterStatus::accepted) {
    return failure(fmt::format("{}: {:g} was sent and refused by the target: {}", wanted.where,
                               static_cast<double>(value), refusal(ack, estimator)));
  }
  // The value that the target reads back must equal the value that the bench sent. Only a unit conversion in
  // the target may round the value.
  if (std::abs(ack.value - value) > 1e-6F * std::abs(value)) {
    return failure(fmt::format("{}: {:g} was sent, the target reads back {:g}", wanted.where,
                               static_cast<double>(value), static_cast<double>(ack.value)));
  }
  return {};
}

// Returns an error if the target exchanges other messages than the bench in a run with its estimator.
Result<void> same_messages(const TargetHeartbeat& heartbeat, const std::string& bus) {
  const std::string_view estimator = name_of(heartbeat.estimator);
  const std::uint32_t expected = exchange_hash24(estimator);
  if (heartbeat.dbc_hash == expected) return {};
  return failure(
      fmt::format("target on '{}': DBC hash {:06x}, expected {:06x}: target and bench are built from "
                  "different DBC files{}",
                  bus, heartbeat.dbc_hash, expected,
                  heartbeat.estimator == Estimator::none ? "" : fmt::format(" for '{}'", estimator)));
}

// Finds the target. Checks that the bus has no second target and no other bench, and that the target is built
// from the same messages.
Result<void> find(Dialogue& dialogue, const std::string& bus, BusFormat format) {
  const Mailbox& box = dialogue.mailbox();
  auto found = dialogue.until(
      {.doing = "waiting for its heartbeat", .awaited = "heartbeat", .limit_ns = find_limit_ns},
      [](nodes::Transmission&) {},
      [](const Mailbox& mailbox) { return mailbox.heartbeat || mailbox.foreign_heartbeat; });
  if (!found) return found;
  if (!box.heartbeat) {
    const BusFormat other = format == BusFormat::fd ? BusFormat::classic : BusFormat::fd;
    return failure(
        fmt::format("target on '{}': answers in {}, expected {}", bus, to_text(other), to_text(format)));
  }
  if (box.heartbeat->state == TargetState::running) dialogue.listen(several_syncs_ns);
  if (box.other_bench) {
    return failure(fmt::format("bus '{}': another bench runs on this bus, expected only one", bus));
  }
  // The messages of an estimator that is left from an earlier run may differ.
  return box.heartbeat->estimator == Estimator::none ? same_messages(*box.heartbeat, bus) : Result<void>{};
}

// Selects an estimator and configures it. `selection`: the command `reset`, which removes all other
// estimators, or the command `add`, which keeps them.
Result<void> prepare(Dialogue& dialogue, const std::string& bus, Command selection,
                     const scenario::TargetSetup& setup, const InitialState& initial) {
  const auto estimator = from_name<Estimator>(setup.estimator);
  const auto algorithm = from_name<Algorithm>(setup.algorithm);
  if (!estimator || !algorithm) {
    return failure(
        fmt::format("estimator '{}' with algorithm '{}': not in the DBC", setup.estimator, setup.algorithm));
  }
  const bool refused_before =
      dialogue.mailbox().heartbeat && dialogue.mailbox().heartbeat->error_dbc_mismatch != 0;
  dialogue.mailbox().forget_heartbeats();
  auto selected = dialogue.until(
      {.doing = selection == Command::reset ? "being reset" : fmt::format("adding '{}'", setup.estimator),
       .awaited = fmt::format("idle with {} of {}", setup.algorithm, setup.estimator),
       .limit_ns = answer_limit_ns},
      [&](nodes::Transmission& o) { o.send(command(selection, *estimator, *algorithm)); },
      [&](const Mailbox& box) {
        if (!box.heartbeat) return false;
        const bool as_commanded = box.heartbeat->estimator == *estimator &&
                                  box.heartbeat->algorithm == *algorithm &&
                                  box.heartbeat->state == TargetState::idle;
        return as_commanded || box.heartbeat->error_command != 0 ||
               (box.heartbeat->error_dbc_mismatch != 0 && !refused_before);
      });
  if (!selected) return selected;
  if (dialogue.mailbox().heartbeat->error_dbc_mismatch != 0) {
    return failure(fmt::format(
        "target on '{}': refuses the DBC hash {:06x} of the messages for '{}': target and bench are built "
        "from different DBC files",
        bus, exchange_hash24(setup.estimator), setup.estimator));
  }
  if (dialogue.mailbox().heartbeat->error_command != 0) {
    return failure(fmt::format(
        "{}: the target on '{}' does not offer '{}' for '{}'{}, expected one of: {}; its errors: {}",
        setup.algorithm_where, bus, setup.algorithm, setup.estimator,
        selection == Command::add ? " beside others" : "", algorithms_of(*estimator),
        protocol::errors_of(*dialogue.mailbox().heartbeat)));
  }
  if (auto same = same_messages(*dialogue.mailbox().heartbeat, bus); !same) return same;
  for (const scenario::Parameter& parameter : setup.parameters) {
    if (auto set = set_parameter(dialogue, *estimator, parameter); !set) return set;
  }
  return dialogue.until(
      {.doing = "taking its initial state", .awaited = "ready", .limit_ns = answer_limit_ns},
      [&](nodes::Transmission& o) { drive::send(initial, o); },
      [&](const Mailbox& box) { return box.is(*estimator, TargetState::ready); });
}

}  // namespace

Result<void> configure(Link& link, nodes::Transmission& out,
                       std::span<const scenario::TargetSetup> estimators,
                       std::span<const InitialState> initial,
                       const std::function<std::optional<std::string>()>& gone, BusFormat format) {
  Dialogue dialogue(link, out, gone);
  const std::string& bus = link.port().name();
  if (auto found = find(dialogue, bus, format); !found) return found;
  for (std::size_t i = 0; i < estimators.size(); ++i) {
    const Command selection = i == 0 ? Command::reset : Command::add;
    if (auto ready = prepare(dialogue, bus, selection, estimators[i], initial[i]); !ready) return ready;
  }
  return dialogue.until(
      {.doing = "starting", .awaited = "running", .limit_ns = answer_limit_ns},
      [](nodes::Transmission& o) { o.send(command(Command::start, Estimator::none, Algorithm::kalman)); },
      [&](const Mailbox& box) {
        return std::ranges::all_of(estimators, [&](const scenario::TargetSetup& setup) {
          return box.is(*from_name<Estimator>(setup.estimator), TargetState::running);
        });
      });
}

void stop(Link& link, nodes::Transmission& out, std::span<const scenario::TargetSetup> estimators) {
  Mailbox box;
  const Attached attached(link, box);
  out.clear();
  out.send(command(Command::stop, Estimator::none, Algorithm::kalman));
  for (const Frame& frame : out.frames()) static_cast<void>(link.send(frame, repeat_ns));
  const auto stopped = [&](const scenario::TargetSetup& setup) {
    const auto estimator = from_name<Estimator>(setup.estimator);
    return !estimator || box.has_stopped(*estimator);
  };
  const std::int64_t deadline_ns = link.now_ns() + repeat_ns;
  while (link.drain() == LinkState::up && !std::ranges::all_of(estimators, stopped)) {
    if (link.now_ns() >= deadline_ns) return;
    link.wait_until(deadline_ns);
  }
}

}  // namespace canhil::drive
