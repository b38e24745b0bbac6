#include "bench/mapping/player.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "bench/estimators/los_rate/quantities.hpp"
#include "bench/mapping/range.hpp"
#include "bench/mapping/reading.hpp"
#include "bench/nodes/registry.hpp"
#include "bench/sensors/program.hpp"
#include "bench/sensors/registry.hpp"
#include "dbc/parser/codec.hpp"

namespace canhil::mapping {
namespace {

bool plays(const Play& play, const sensors::Kind* sensor) {
  return std::ranges::any_of(play.messages, [&](const PlayedMessage& message) {
    return std::ranges::any_of(message.sources, [&](const Source& source) {
      return source.measurand != nullptr && source.measurand->sensor == sensor;
    });
  });
}

// The sensors that a mapping plays, in the order of precedence.
std::vector<const sensors::Kind*> played_by(const Mapping& mapping) {
  std::vector<const sensors::Kind*> all(sensors::all().begin(), sensors::all().end());
  all.insert(all.end(), mapping.sensors.begin(), mapping.sensors.end());
  std::erase_if(all, [&](const sensors::Kind* kind) {
    return std::ranges::none_of(mapping.plays, [&](const Play& play) { return plays(play, kind); });
  });
  return all;
}

// The value that the signal gets: an angle that it cannot hold is sent as the equal angle that it can hold.
double held(const Source& source, double value) {
  if (source.measurand == nullptr || !source.measurand->output().turns) return value;
  const double turn = 2 * std::numbers::pi * std::abs(source.factor);
  for (const double one : {value, value + turn, value - turn}) {
    if (dbc::holds(*source.signal, one)) return one;
  }
  return value;
}

double ms(std::int64_t t_us) { return static_cast<double>(t_us) * 1e-3; }

bool is_constant(const Source& source) { return source.measurand == nullptr && !source.time; }

}  // namespace

Result<void> Player::check(const Mapping& mapping, const scenario::Scenario& scenario) {
  for (const sensors::Kind* kind : played_by(mapping)) {
    const scenario::NodeSettings* node = scenario.node(kind->key);
    for (const Play& play : mapping.plays) {
      if (!plays(play, kind)) continue;
      if (node == nullptr)
        return failure(fmt::format("key '{}': is missing, expected {}: its samples are sent in {}", kind->key,
                                   kind->of == nullptr ? "a table" : "a [[sensor]] with this name",
                                   play.name));
      if (node->table().sensor != kind)
        return failure(fmt::format("key 'sensor': '{}' has another kind than in {}, expected '{}'", kind->key,
                                   to_text(mapping.files), kind->of->key));
      if (const std::string why = sensors::why_no_truth(*node, scenario); !why.empty())
        return failure(fmt::format("key '{}': {}", kind->key, why));
      if (play.sensor == kind && play.period_us % node->period_us() != 0)
        return failure(
            fmt::format("key '{}.period_ms': {:g} does not divide the {:g} ms of {}, expected a "
                        "whole fraction of it",
                        kind->key, ms(node->period_us()), ms(play.period_us), play.name));
    }
  }
  return {};
}

Player::Player(Conversation& conversation, const nodes::Run& run)
    : conversation_(conversation),
      end_us_(run.flight.end_us()),
      values_(conversation.mapping.plays.size()),
      samples_(conversation.mapping.plays.size(), 0),
      places_(conversation.mapping) {
  for (const sensors::Kind* kind : played_by(conversation.mapping)) {
    const scenario::NodeSettings* node = run.scenario.node(kind->key);
    sensors_.push_back(
        {.sensor = nodes::make_sensor(*node, run), .kind = kind, .period_us = node->period_us()});
  }
  for (std::size_t i = 0; i < values_.size(); ++i) {
    for (const PlayedMessage& message : conversation.mapping.plays[i].messages) {
      for (const Source& source : message.sources) {
        if (source.measurand != nullptr) values_[i][source.measurand];
      }
    }
  }
}

std::int64_t Player::due_us() const {
  std::int64_t due_us = due_.empty() ? nodes::never_us : due_.front().sent.due_us;
  for (const Played& played : sensors_) due_us = std::min(due_us, played.sensor->due_us());
  for (std::size_t i = 0; i < samples_.size(); ++i) due_us = std::min(due_us, next_without_sensor_us(i));
  return due_us;
}

// The time of the next transmission of a play that no sensor triggers, for example of a message that only
// says that its sender is there.
std::int64_t Player::next_without_sensor_us(std::size_t play) const {
  const Play& one = conversation_.mapping.plays[play];
  if (one.sensor != nullptr) return nodes::never_us;
  const std::int64_t due_us = (samples_[play] + 1) * one.period_us + one.latency_us;
  return due_us > end_us_ ? nodes::never_us : due_us;
}

void Player::send_without_sensor(std::int64_t now_us) {
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    if (next_without_sensor_us(i) != now_us) continue;
    ++samples_[i];
    const std::int64_t valid_us = now_us - conversation_.mapping.plays[i].latency_us;
    insert({.play = i, .sent = put_together(i, {.valid_us = valid_us, .stamp_us = valid_us}, now_us)});
  }
}

void Player::insert(Due due) {
  const auto after =
      std::ranges::upper_bound(due_, due.sent.due_us, {}, [](const Due& one) { return one.sent.due_us; });
  due_.insert(after, std::move(due));
}

// All samples of this time are taken first, because a play may carry values of several sensors.
void Player::transmit(nodes::Transmission& out) {
  const std::int64_t now_us = due_us();
  std::vector<Triggered> triggered;
  for (Played& played : sensors_) {
    if (played.sensor->due_us() == now_us) sample(played, triggered);
  }
  for (const auto& [play, sample] : triggered) {
    const std::int64_t sent_us = now_us + conversation_.mapping.plays[play].latency_us;
    insert({.play = play,
            .sent = put_together(play, sample, sent_us),
            .lost = sample.fate == sensors::Sample::Fate::lost});
  }
  send_without_sensor(now_us);
  out.clipped().add(std::exchange(clipped_, {}));
  if (due_.empty() || due_.front().sent.due_us > now_us) return;
  Due& due = due_.front();
  // A transmission with many frames is put out in parts, at the same time.
  const std::size_t end = std::min(due.next + nodes::Transmission::most, due.sent.frames.size());
  if (!due.lost && due.next == 0) conversation_.add(due.play, due.sent);
  for (; !due.lost && due.next < end; ++due.next) out.put(due.sent.frames[due.next]);
  if (due.lost || due.next == due.sent.frames.size()) due_.pop_front();
}

bool Player::listens() const {
  return std::ranges::any_of(sensors_, [](const Played& played) { return played.sensor->is_guided(); });
}

// The guidance takes a LOS rate when both planes answer the same sample. It holds its command while an answer
// has no value.
bool Player::hear(const Frame& frame, std::int64_t /*now_us*/) {
  for (const std::size_t index : places_.hears(frame)) {
    const Hear& hear = conversation_.mapping.hears[index];
    const bool guides = &conversation_.mapping.targets[hear.target] == conversation_.mapping.guide;
    if (!guides || !hear.answers) continue;
    const Receiver::Taken taken = receivers_[&hear].take(hear.of, frame);
    if (taken.outcome != Receiver::Outcome::whole) continue;
    const Sent* cause = cause_of(conversation_, hear, taken.bytes);
    if (cause == nullptr) continue;
    if (cause->valid_us != los_rate_.cause_us) los_rate_ = {.cause_us = cause->valid_us};
    read(hear, taken.bytes, heard_, [&](const ReportedSignal& signal, double value, bool /*invalid*/) {
      if (signal.what != ReportedSignal::What::value || !std::isfinite(value)) return;
      if (signal.quantity->quantity == &quantities::los_rate_pitch) los_rate_.pitch = value;
      if (signal.quantity->quantity == &quantities::los_rate_yaw) los_rate_.yaw = value;
    });
    if (!los_rate_.pitch || !los_rate_.yaw) continue;
    const sensors::Guidance answer{.cause_us = los_rate_.cause_us,
                                   .los_rate = {.pitch = *los_rate_.pitch, .yaw = *los_rate_.yaw}};
    for (const Played& played : sensors_) {
      if (played.sensor->is_guided()) played.sensor->guide(answer);
    }
    los_rate_ = {};
  }
  return false;
}

void Player::sample(Played& played, std::vector<Triggered>& triggered) {
  using Fate = sensors::Sample::Fate;
  const std::int64_t due_us = played.sensor->due_us();
  const sensors::Sample sample = played.sensor->measure();
  if (sample.fate == Fate::none) return;
  if (sample.fate == Fate::sent) take(*played.kind, sample);
  for (std::size_t i = 0; i < values_.size(); ++i) {
    const Play& play = conversation_.mapping.plays[i];
    if (play.sensor != played.kind) continue;
    if (sample.restarted) restart(play);
    if (++samples_[i] % (play.period_us / played.period_us) != 0) continue;
    // An answer to what is sent after the end of the run would not be observed.
    if (due_us + play.latency_us <= end_us_) triggered.push_back({i, sample});
  }
}

void Player::take(const sensors::Kind& kind, const sensors::Sample& sample) {
  for (auto& of_play : values_) {
    for (auto& [measurand, kept] : of_play) {
      if (measurand->sensor != &kind) continue;
      kept.valid = (sample.invalid & measurand->output().flags) == 0;
      kept.newest = sample.values[measurand->index];
      kept.sum += kept.newest;
      kept.over_us += sample.interval_us;
    }
  }
}

// The counters of a play's messages begin anew.
void Player::restart(const Play& play) {
  for (const PlayedMessage& one : play.messages) {
    own_.erase(one.of.message);
    if (one.of.protection && one.of.protection->settings().counter)
      shared_.erase(one.of.protection->settings().counter->shared_as);
  }
}

double Player::value_of(std::size_t play, const Source& source, std::int64_t stamp_us) {
  if (source.time) return 1e-6 * static_cast<double>(stamp_us);
  Value& value = values_[play][source.measurand];
  switch (source.measurand->over) {
    case sensors::Over::newest:
      return value.newest;
    case sensors::Over::sum:
      return value.sum;
    case sensors::Over::rate:
      if (value.over_us > 0) value.rate = value.sum / (1e-6 * value.over_us);
      return value.rate;
  }
  return 0;
}

// Adds a message to a transmission, in one frame or in several.
void Player::add_frames(Sent& sent, const Mapped& of, std::vector<std::uint8_t> bytes) {
  const auto add = [&](std::span<const std::uint8_t> data) {
    sent.frames.push_back(of.frame(data));
    sent.message_of.push_back(sent.messages.size());
  };
  if (of.message->fast_packet) {
    for (const auto& frame : transport::split_fast_packet(bytes, sequences_[of.message]++)) add(frame);
  } else {
    add(bytes);
  }
  sent.messages.push_back(std::move(bytes));
}

// A valid value that is rounded to the raw value for "invalid" does not fit, as one beyond the range does
// not.
void Player::add_clipped(const dbc::Message& message, const Source& source, double value) {
  auto [lowest, highest] = physical_range(*source.signal).value_or(std::pair(0.0, 0.0));
  const double reserved = source.invalid ? dbc::to_physical(*source.signal, *source.invalid) : std::nan(""),
               step = std::abs(source.signal->scale);
  if (std::abs(reserved - highest) < std::abs(reserved - lowest)) highest = reserved - step;
  if (std::abs(reserved - lowest) < std::abs(reserved - highest)) lowest = reserved + step;
  clipped_.add(message.name, source.signal->name, value, {lowest, highest, source.signal->unit});
}

Sent Player::put_together(std::size_t index, const sensors::Sample& sample, std::int64_t due_us) {
  Sent sent{.valid_us = sample.valid_us, .due_us = due_us};
  for (const PlayedMessage& one : conversation_.mapping.plays[index].messages) {
    const dbc::Message& message = *one.of.message;
    std::vector<double> values(one.of.plan.signals(), 0.0);
    for (const Source& source : one.sources) {
      double& value = values[one.of.number(*source.signal)];
      value = is_constant(source) ? source.value
                                  : held(source, value_of(index, source, sample.stamp_us) * source.factor);
      if (conversation_.on_value) conversation_.on_value(source, value);
      if (!dbc::holds(*source.signal, value)) add_clipped(message, source, value);
    }
    std::vector<std::uint8_t> bytes(message.size);
    static_cast<void>(one.of.plan.encode(values, bytes));  // the sizes match
    for (const Source& source : one.sources) {
      const auto is_invalid = [](const auto& kept) { return !kept.second.valid; };
      const bool invalid = source.measurand != nullptr ? !values_[index][source.measurand].valid
                                                       : std::ranges::any_of(values_[index], is_invalid);
      if (source.invalid && invalid) dbc::put_raw_bits(*source.signal, *source.invalid, bytes);
      if (!invalid && !is_constant(source) && says_invalid(*source.signal, source.invalid, bytes))
        add_clipped(message, source, values[one.of.number(*source.signal)]);
    }
    if (one.of.protection) {
      const auto& counter = one.of.protection->settings().counter;
      const bool shared = counter && !counter->shared_as.empty();
      protection::Sender& sender = shared ? shared_[counter->shared_as] : own_[&message];
      sender.protect(*one.of.protection, bytes);
    }
    add_frames(sent, one.of, std::move(bytes));
  }
  for (auto& [measurand, value] : values_[index])
    value = {.newest = value.newest, .rate = value.rate, .valid = value.valid};
  return sent;
}

}  // namespace canhil::mapping
