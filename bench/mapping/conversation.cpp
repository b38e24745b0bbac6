#include "bench/mapping/conversation.hpp"

#include <algorithm>

#include "dbc/parser/codec.hpp"

namespace canhil::mapping {

std::optional<Passing::Whole> Passing::take(const Frame& frame) {
  for (std::size_t play = 0; play < passed_.size(); ++play) {
    if (conversation_.sent[play].empty()) continue;
    const Sent& sent = conversation_.sent[play].back();
    const auto found = std::ranges::find(sent.frames, frame);
    if (found == sent.frames.end()) continue;
    Passed& passed = passed_[play];
    if (passed.valid_us != sent.valid_us) {
      auto& in_part = in_part_[play];
      const bool is_part = !passed.frames.empty() && passed.frames.size() < passed.message_of.size();
      if (is_part) in_part.push_back(std::move(passed));
      if (in_part.size() > Conversation::remembered) in_part.pop_front();
      passed = {.valid_us = sent.valid_us, .frames = {}, .message_of = sent.message_of};
    }
    const bool another = passed.frames.insert(static_cast<std::size_t>(found - sent.frames.begin())).second;
    if (another && passed.frames.size() == sent.frames.size()) return Whole{.play = play, .sent = &sent};
    return std::nullopt;
  }
  return std::nullopt;
}

bool Passing::brought_in_part(std::size_t play, std::int64_t valid_us, std::size_t message) const {
  const auto brought = [&](const Passed& one) {
    if (one.valid_us != valid_us) return false;
    for (std::size_t i = 0; i < one.message_of.size(); ++i) {
      if (one.message_of[i] == message && !one.frames.contains(i)) return false;
    }
    return true;
  };
  const bool of_newest =
      brought(passed_[play]) && passed_[play].frames.size() < passed_[play].message_of.size();
  return of_newest || std::ranges::any_of(in_part_[play], brought);
}

namespace {

// A byte may repeat the lowest bits of a longer counter.
std::uint64_t common_bits(const Echo& echo) {
  const unsigned common = std::min(echo.repeated->length, echo.original->length);
  return common >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << common) - 1;
}

}  // namespace

std::uint64_t echoed_by(const Hear& hear, std::span<const std::uint8_t> answer) {
  if (!hear.echo) return 0;
  return dbc::raw_bits(*hear.echo->repeated, answer) & common_bits(*hear.echo);
}

std::uint64_t carried_by(const Hear& hear, const Sent& stimulus) {
  if (!hear.echo) return 0;
  return dbc::raw_bits(*hear.echo->original, stimulus.messages[hear.echo->message]) & common_bits(*hear.echo);
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
