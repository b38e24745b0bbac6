#include "dbc/codegen/placement.hpp"

#include <algorithm>

namespace canhil::dbc {

std::vector<Piece> pieces_of(const Message& message, const Signal& signal) {
  const bool motorola = signal.byte_order == ByteOrder::big_endian;
  const unsigned start = motorola ? signal.start_bit / 8 * 8 + 7 - signal.start_bit % 8 : signal.start_bit;
  Word word{0, std::min(message.size, 8U), signal.byte_order};
  if (message.size > 8) word.first = std::min(start / 8, message.size - 8);
  const unsigned begin =
      start - 8 * word.first;  // number of bits of the word before the signal, in the bit order of the word
  const unsigned bits = 8 * word.bytes;
  if (begin + signal.length <= bits) {
    return {{word, motorola ? bits - begin - signal.length : begin, signal.length, 0}};
  }
  // The signal has bits in nine bytes. The bits that are not in `word` are in the last byte of `next`, which
  // is the word that starts one byte later.
  const Word next{word.first + 1, 8, word.order};
  const unsigned here = 64 - begin;
  const unsigned rest = signal.length - here;
  if (motorola) return {{word, 0, here, rest}, {next, 8 - rest, rest, 0}};
  return {{next, 56, rest, here}, {word, begin, here, 0}};
}

}  // namespace canhil::dbc
