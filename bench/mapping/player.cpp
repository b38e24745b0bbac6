#include "bench/mapping/player.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "bench/mapping/range.hpp"
#include "bench/nodes/recorded_group.hpp"
#include "bench/nodes/registry.hpp"
#include "bench/observe/values.hpp"
#include "dbc/parser/codec.hpp"
#include "messages/canhil.hpp"

namespace canhil::mapping {
namespace {

bool plays(const Play& play, std::string_view node) {
  return std::ranges::any_of(play.messages, [&](const PlayedMessage& message) {
    return std::ranges::any_of(message.sources, [&](const Source& source) {
      return source.stimulus != nullptr && source.stimulus->node == node;
    });
  });
}

// The value that the signal gets: an angle that it cannot hold is sent as the equal angle that it can hold.
double held(const Source& source, double value) {
  if (source.stimulus == nullptr || !source.stimulus->turns) return value;
  const double turn = 2 * std::numbers::pi * std::abs(source.factor);
  for (const double one : {value, value + turn, value - turn}) {
    if (dbc::holds(*source.signal, one)) return one;
  }
  return value;
}

double ms(std::int64_t t_us) { return static_cast<double>(t_us) * 1e-3; }

}  // namespace

Result<void> Player::check(const Mapping& mapping, const scenario::Scenario& scenario) {
  for (const nodes::Kind* kind : nodes::all()) {
    const std::string_view key = kind->table.key;
    const scenario::NodeSettings* node = scenario.node(key);
    for (const Play& play : mapping.plays) {
      if (!plays(play, key)) continue;
      if (node == nullptr)
        return failure(
            fmt::format("key '{}': is missing, and {} plays it, expected a table", key, play.name));
      if (play.node == key && play.period_us % node->period_us() != 0)
        return failure(
            fmt::format("key '{}.period_ms': {:g} does not divide the {:g} ms of {}, expected a "
                        "whole fraction of it",
                        key, ms(node->period_us()), ms(play.period_us), play.name));
    }
  }
  return {};
}

Player::Player(Conversation& conversation, const nodes::Run& run)
    : conversation_(conversation),
      end_us_(run.flight.end_us()),
      values_(conversation.mapping.plays.size()),
      samples_(conversation.mapping.plays.size(), 0) {
  for (const nodes::Kind* kind : nodes::all()) {
    const scenario::NodeSettings* node = run.scenario.node(kind->table.key);
    const auto& all = conversation.mapping.plays;
    if (node == nullptr ||
        std::ranges::none_of(all, [&](const Play& play) { return plays(play, kind->table.key); }))
      continue;
    nodes_.push_back({.node = nodes::make(*kind, *node, run),
                      .table = &kind->table,
                      .period_us = node->period_us(),
                      .latency_us = node->latency_us()});
  }
  for (std::size_t i = 0; i < values_.size(); ++i) {
    for (const PlayedMessage& message : conversation.mapping.plays[i].messages) {
      for (const Source& source : message.sources) {
        if (source.stimulus != nullptr) values_[i][source.stimulus];
      }
    }
  }
}

std::int64_t Player::due_us() const {
  std::int64_t due_us = due_.empty() ? nodes::never_us : due_.front().sent.due_us;
  for (const Played& played : nodes_) due_us = std::min(due_us, played.node->due_us());
  for (std::size_t i = 0; i < samples_.size(); ++i) due_us = std::min(due_us, next_without_node_us(i));
  return due_us;
}

// The time of the next transmission of a play that no node triggers, for example of a message that only says
// that its sender is there.
std::int64_t Player::next_without_node_us(std::size_t play) const {
  const Play& one = conversation_.mapping.plays[play];
  if (!one.node.empty()) return nodes::never_us;
  const std::int64_t due_us = (samples_[play] + 1) * one.period_us + one.latency_us;
  return due_us > end_us_ ? nodes::never_us : due_us;
}

void Player::send_without_node(std::int64_t now_us) {
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    if (next_without_node_us(i) != now_us) continue;
    ++samples_[i];
    insert({.play = i, .sent = put_together(i, now_us - conversation_.mapping.plays[i].latency_us, now_us)});
  }
}

void Player::insert(Due due) {
  const auto after =
      std::ranges::upper_bound(due_, due.sent.due_us, {}, [](const Due& one) { return one.sent.due_us; });
  due_.insert(after, std::move(due));
}

// Take samples first, because a play may be due at the same time as its sample.
void Player::transmit(nodes::Transmission& out) {
  const std::int64_t now_us = due_us();
  for (Played& played : nodes_) {
    if (played.node->due_us() == now_us) sample(played);
  }
  send_without_node(now_us);
  out.clipped().add(std::exchange(clipped_, {}));
  if (due_.empty() || due_.front().sent.due_us > now_us) return;
  Due due = std::move(due_.front());
  due_.pop_front();
  if (due.lost) return;
  for (const Frame& frame : due.sent.frames) out.put(frame);
  conversation_.add(due.play, std::move(due.sent));
}

void Player::sample(Played& played) {
  const std::int64_t due_us = played.node->due_us();
  nodes::Transmission own(Rounding::none);
  played.node->transmit(own);
  clipped_.add(own.clipped());
  played.valid_us = due_us - played.latency_us;
  played.lost = own.frames().empty();
  bool closed = played.lost;  // a node that replays a log sends one frame at a time
  for (const Frame& frame : own.frames()) {
    take(played, frame);
    closed = closed || frame.id == played.table->closes.id;
  }
  if (!closed) return;
  for (std::size_t i = 0; i < values_.size(); ++i) {
    const Play& play = conversation_.mapping.plays[i];
    if (play.node != played.table->key) continue;
    if (++samples_[i] % (play.period_us / played.period_us) != 0) continue;
    const std::int64_t sent_us = due_us + play.latency_us;
    if (sent_us > end_us_) continue;  // an answer would come after the end of the run
    insert({.play = i, .sent = put_together(i, played.valid_us, sent_us), .lost = played.lost});
  }
}

void Player::take(const Played& played, const Frame& frame) {
  const std::vector<observe::Value> values = observe::values_of(frame);
  bool flagged = false, valid = true;
  double interval_us = 0;
  for (const observe::Value& value : values) {
    const nodes::Role role = nodes::role_of(*value.signal);
    if (role == nodes::Role::interval) interval_us = value.value;
    if (role != nodes::Role::validity) continue;
    flagged = true;
    valid = valid && value.enumerator != name_of(messages::Validity::invalid);
  }
  for (auto& of_play : values_) {
    for (auto& [stimulus, kept] : of_play) {
      if (stimulus->node != played.table->key) continue;
      const bool own = stimulus->message->id == frame.id;
      if (flagged && (own || !stimulus->flagged)) kept.valid = valid;
      kept.over_us += interval_us;
      if (!own) continue;
      const auto value = std::ranges::find(values, stimulus->signal,
                                           [](const observe::Value& one) { return one.signal->name; });
      if (value == values.end()) continue;
      kept.newest = value->value * stimulus->factor;
      kept.sum += kept.newest;
    }
  }
}

double Player::value_of(std::size_t play, const Source& source, std::int64_t valid_us) {
  if (source.time) return 1e-6 * static_cast<double>(valid_us);
  const Value& value = values_[play][source.stimulus];
  switch (source.stimulus->over) {
    case Over::newest:
      return value.newest;
    case Over::sum:
      return value.sum;
    case Over::rate:
      return value.over_us == 0 ? 0 : value.sum / (1e-6 * value.over_us);
  }
  return 0;
}

Sent Player::put_together(std::size_t index, std::int64_t valid_us, std::int64_t due_us) {
  Sent sent{.valid_us = valid_us, .due_us = due_us, .frames = {}};
  for (const PlayedMessage& one : conversation_.mapping.plays[index].messages) {
    const dbc::Message& message = *one.of.message;
    std::vector<double> values(one.of.plan.signals(), 0.0);
    for (const Source& source : one.sources) {
      const bool constant = source.stimulus == nullptr && !source.time;
      double& value = values[one.of.number(*source.signal)];
      value = constant ? source.value : held(source, value_of(index, source, valid_us) * source.factor);
      if (dbc::holds(*source.signal, value)) continue;
      const auto [lowest, highest] = physical_range(*source.signal).value_or(std::pair(0.0, 0.0));
      clipped_.add(message.name, source.signal->name, value, {lowest, highest, source.signal->unit});
    }
    Frame frame{.id = message.id,
                .size = static_cast<std::uint8_t>(message.size),
                .extended = message.extended,
                .fd = message.fd,
                .brs = message.fd};
    static_cast<void>(one.of.plan.encode(values, {frame.data.data(), frame.size}));  // the sizes match
    for (const Source& source : one.sources) {
      const auto says_invalid = [](const auto& kept) { return !kept.second.valid; };
      const bool invalid = source.stimulus != nullptr ? !values_[index][source.stimulus].valid
                                                      : std::ranges::any_of(values_[index], says_invalid);
      if (source.invalid && invalid)
        dbc::put_raw_bits(*source.signal, *source.invalid, {frame.data.data(), frame.size});
    }
    if (one.of.protection) {
      const auto& counter = one.of.protection->settings().counter;
      const bool shared = counter && !counter->shared_as.empty();
      protection::Sender& sender = shared ? shared_[counter->shared_as] : own_[&message];
      sender.protect(*one.of.protection, {frame.data.data(), frame.size});
    }
    sent.frames.push_back(frame);
  }
  for (auto& [stimulus, value] : values_[index]) value = {.newest = value.newest};
  return sent;
}

}  // namespace canhil::mapping
