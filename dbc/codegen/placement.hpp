// Where the bits of a signal lie in 64-bit words of its message.
#pragma once

#include <utility>
#include <vector>

#include "dbc/parser/database.hpp"

namespace canhil::dbc {

/// Up to 8 bytes of a message that generated code loads at once. The first byte is the least significant one
/// (little-endian) or the most significant one (big-endian).
struct Word {
  unsigned first = 0;
  unsigned bytes = 8;
  ByteOrder order = ByteOrder::little_endian;
  /// Words of one message differ in their first byte and byte order.
  friend bool operator<(const Word& a, const Word& b) {
    return std::pair(a.first, a.order) < std::pair(b.first, b.order);
  }
};

/// Maps `length` bits of a word, starting at `shift`, to the bits of the raw value that start at `raw_shift`.
struct Piece {
  Word word;
  unsigned shift = 0;
  unsigned length = 0;
  unsigned raw_shift = 0;
};

/// One piece, or two (most significant first) for a signal that touches nine bytes.
/// A message of up to 8 bytes is one word. In a longer message the word starts at the signal's first byte,
/// but at the latest 8 bytes before the end of the message.
std::vector<Piece> pieces_of(const Message& message, const Signal& signal);

}  // namespace canhil::dbc
