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
    if (passed.valid_us != sent.valid_us) passed = {.valid_us = sent.valid_us, .frames = {}};
    const bool another = passed.frames.insert(static_cast<std::size_t>(found - sent.frames.begin())).second;
    if (another && passed.frames.size() == sent.frames.size()) return Whole{.play = play, .sent = &sent};
    return std::nullopt;
  }
  return std::nullopt;
}

const Sent* cause_of(const Conversation& conversation, const Hear& hear, const Frame& frame) {
  const std::deque<Sent>& sent = conversation.sent[*hear.answers];
  if (sent.empty()) return nullptr;
  if (!hear.echo) return &sent.back();
  // Compare only the bits that both signals have: a byte may repeat the lowest bits of a longer counter.
  const unsigned common = std::min(hear.echo->repeated->length, hear.echo->original->length);
  const std::uint64_t mask = common >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << common) - 1;
  const std::uint64_t repeated = dbc::raw_bits(*hear.echo->repeated, frame.payload()) & mask;
  const auto found = std::find_if(sent.rbegin(), sent.rend(), [&](const Sent& one) {
    const Frame& original = one.frames[hear.echo->message];
    return (dbc::raw_bits(*hear.echo->original, original.payload()) & mask) == repeated;
  });
  return found == sent.rend() ? nullptr : &*found;
}

}  // namespace canhil::mapping
