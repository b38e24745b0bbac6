// The positions of a signal's bits in 64-bit words of the message.
#pragma once

#include <utility>
#include <vector>

#include "dbc/parser/database.hpp"

namespace canhil::dbc {

/// Up to 8 bytes of a message that the generated code loads at once. The first byte is the least significant
/// one if the order is little-endian, and the most significant one if it is big-endian.
struct Word {
  unsigned first = 0;
  unsigned bytes = 8;
  ByteOrder order = ByteOrder::little_endian;
  /// Compares the first bytes and, if these are equal, the byte orders. Two different words of a message
  /// always differ in the first byte or in the byte order.
  friend bool operator<(const Word& a, const Word& b) {
    return std::pair(a.first, a.order) < std::pair(b.first, b.order);
  }
};

/// A piece of a signal: `length` bits of a word from bit `shift` upwards. In the raw value of the signal,
/// these bits are at bit `raw_shift` and upwards.
struct Piece {
  Word word;
  unsigned shift = 0;
  unsigned length = 0;
  unsigned raw_shift = 0;
};

/// The pieces of a signal: one piece, or two pieces (most significant first) if the signal has bits in nine
/// bytes. A message of up to 8 bytes is one word. In a longer message, the word starts with the first byte of
/// the signal, but not later than 8 bytes before the end of the message.
std::vector<Piece> pieces_of(const Message& message, const Signal& signal);

}  // namespace canhil::dbc
