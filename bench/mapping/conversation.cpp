#include "bench/mapping/conversation.hpp"

#include <algorithm>

#include "dbc/parser/codec.hpp"

namespace canhil::mapping {

const Sent* cause_of(const Conversation& conversation, const Hear& hear, const Frame& frame) {
  const std::deque<Sent>& sent = conversation.sent[*hear.answers];
  if (sent.empty()) return nullptr;
  if (!hear.echo) return &sent.back();
  // The shorter of the two decides: a byte may repeat the lowest bits of a longer count.
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
