#include "bench/mapping/conversation.hpp"

#include <algorithm>

#include "dbc/parser/codec.hpp"

namespace canhil::mapping {

std::optional<Passing::Whole> Passing::take(const Frame& frame) {
  bool any = true;
  for (std::size_t age = 0; any; ++age) {  // the newest transmission of each play first
    any = false;
    for (std::size_t play = 0; play < passed_.size(); ++play) {
      const auto& all = conversation_.sent[play];
      if (all.size() <= age) continue;
      any = true;
      const Sent& sent = all[all.size() - 1 - age];
      const auto found = std::ranges::find(sent.frames, frame);
      if (found == sent.frames.end()) continue;
      Passed& one = passed(play, sent);
      const bool another = one.frames.insert(static_cast<std::size_t>(found - sent.frames.begin())).second;
      if (!another) continue;  // an earlier transmission may have had the same bytes
      one.whole = &one == &passed_[play].back() && one.frames.size() == sent.frames.size();
      return one.whole ? std::optional(Whole{.play = play, .sent = &sent}) : std::nullopt;
    }
  }
  take_changed(frame);
  return std::nullopt;
}

// A target can tell that a frame was changed only by a checksum, by the size, or by the transport protocol.
void Passing::take_changed(const Frame& frame) {
  for (std::size_t play = 0; play < passed_.size(); ++play) {
    if (conversation_.sent[play].empty()) continue;
    const Sent& sent = conversation_.sent[play].back();
    for (std::size_t i = 0; i < sent.frames.size(); ++i) {
      const Frame& made = sent.frames[i];
      const Mapped& of = conversation_.mapping.plays[play].messages[sent.message_of[i]].of;
      const bool has_checksum = of.protection && of.protection->settings().checksum;
      if (made.id != frame.id || made.extended != frame.extended || made.size != frame.size || has_checksum ||
          of.has_several_frames())
        continue;
      Passed& one = passed(play, sent);
      if (!one.frames.contains(i)) one.changed.insert_or_assign(i, frame);
    }
  }
}

Passing::Passed& Passing::passed(std::size_t play, const Sent& sent) {
  auto& all = passed_[play];
  auto place = all.end();
  while (place != all.begin() && std::prev(place)->valid_us >= sent.valid_us) --place;
  if (place == all.end() || place->valid_us != sent.valid_us)
    place = all.insert(place, {.valid_us = sent.valid_us, .message_of = sent.message_of});
  if (all.size() <= Conversation::remembered || place == all.begin()) return *place;
  const auto after = std::distance(place, all.end());
  all.pop_front();
  return *(all.end() - after);
}

bool Passing::may_answer(std::size_t play, std::int64_t valid_us, std::size_t message) const {
  return std::ranges::any_of(passed_[play], [&](const Passed& one) {
    if (one.valid_us != valid_us || one.whole) return false;
    for (std::size_t i = 0; i < one.message_of.size(); ++i) {
      if (one.message_of[i] == message && !one.frames.contains(i) && !one.changed.contains(i)) return false;
    }
    return true;
  });
}

namespace {

// A byte may repeat the lowest bits of a longer counter.
std::uint64_t common_bits(const Echo& echo) {
  const unsigned common = std::min(echo.repeated->length, echo.original->length);
  return common >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << common) - 1;
}

std::uint64_t carried_in(const Echo& echo, std::span<const std::uint8_t> stimulus) {
  return dbc::raw_bits(*echo.original, stimulus) & common_bits(echo);
}

}  // namespace

bool Passing::carried_changed(const Hear& hear, std::uint64_t echoed) const {
  if (!hear.echo) return false;
  return std::ranges::any_of(passed_[*hear.answers], [&](const Passed& one) {
    return std::ranges::any_of(one.changed, [&](const auto& changed) {
      const auto& [index, frame] = changed;
      return one.message_of[index] == hear.echo->message && carried_in(*hear.echo, frame.payload()) == echoed;
    });
  });
}

std::uint64_t echoed_by(const Hear& hear, std::span<const std::uint8_t> answer) {
  if (!hear.echo) return 0;
  return dbc::raw_bits(*hear.echo->repeated, answer) & common_bits(*hear.echo);
}

std::uint64_t carried_by(const Hear& hear, const Sent& stimulus) {
  if (!hear.echo) return 0;
  return carried_in(*hear.echo, stimulus.messages[hear.echo->message]);
}

const Sent* cause_of(const Conversation& conversation, const Hear& hear,
                     std::span<const std::uint8_t> answer) {
  const std::deque<Sent>& sent = conversation.sent[*hear.answers];
  const std::uint64_t echoed = echoed_by(hear, answer);
  const auto found = std::find_if(sent.rbegin(), sent.rend(),
                                  [&](const Sent& one) { return carried_by(hear, one) == echoed; });
  return found == sent.rend() ? nullptr : &*found;
}

}  // namespace canhil::mapping
