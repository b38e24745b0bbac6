// canhil's own protection (dbc/wire/e2e.hpp) and the preset of the same profile agree bit for bit.
#include "dbc/wire/e2e.hpp"

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>

#include "dbc/parser/parse.hpp"
#include "dbc/protection/profiles.hpp"
#include "dbc/protection/protection.hpp"

namespace canhil::protection {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// A message of a DBC that has a data id, with the protection of the preset.
struct ProtectedMessage {
  std::uint16_t data_id = 0;
  Protection protection;
};

std::vector<ProtectedMessage> messages_of(const std::string& file) {
  std::vector<ProtectedMessage> all;
  const dbc::Database database = dbc::read_file(file).value();
  for (const dbc::Message& message : database.messages) {
    if (message.e2e_data_id == 0) continue;
    ProfileChoice choice;
    choice.data_id = message.e2e_data_id;
    all.push_back(ProtectedMessage{
        message.e2e_data_id,
        Protection::make(profile("autosar-e2e-11a", choice, message.size).value(), {message.id, message.size})
            .value()});
  }
  return all;
}

const std::vector<ProtectedMessage>& contract() {
  static const std::vector<ProtectedMessage> all = messages_of(SOURCE_DIR "/dbc/canhil.dbc");
  return all;
}

TEST(OwnWire, HasAProtectedMessageForEachOfTheContract) {
  EXPECT_EQ(contract().size(), dbc::read_file(SOURCE_DIR "/dbc/canhil.dbc").value().messages.size());
}

RC_GTEST_PROP(OwnWire, IsThePresetBitForBitInEveryMessage, ()) {
  const auto counter = *rc::gen::inRange<std::uint8_t>(0, e2e::counter_period);
  for (const ProtectedMessage& message : contract()) {
    Bytes ours =
        *rc::gen::container<Bytes>(message.protection.subject().size, rc::gen::arbitrary<std::uint8_t>());
    Bytes preset = ours;
    e2e::protect(ours, message.data_id, counter);
    message.protection.protect(preset, counter);
    RC_ASSERT(ours == preset);
  }
}

/// Converts a verdict of canhil's own receiver to a verdict of protection's receiver. canhil's own receiver
/// reports a counter of 15 as a wrong CRC.
Check in_our_words(e2e::Check check) {
  switch (check) {
    case e2e::Check::ok:
      return Check::ok;
    case e2e::Check::some_lost:
      return Check::some_lost;
    case e2e::Check::repeated:
      return Check::repeated;
    case e2e::Check::wrong_crc:
      break;
  }
  return Check::wrong_checksum;
}

// Streams of messages, some of which are lost, repeated or damaged, or have a counter of 15.
RC_GTEST_PROP(OwnWire, ReceiversSayTheSame, ()) {
  const ProtectedMessage& message = contract()[*rc::gen::inRange<std::size_t>(0, contract().size())];
  Receiver receiver;
  e2e::Receiver wire;
  for (const unsigned fate : *rc::gen::container<std::vector<unsigned>>(50, rc::gen::inRange(0U, 64U))) {
    Bytes data(message.protection.subject().size);
    message.protection.protect(data, fate % 16);
    if (fate >= 48) data.back() ^= 1U;
    const Check said = receiver.check(message.protection, data);
    RC_ASSERT(in_our_words(wire.check(data, message.data_id)) ==
              (said == Check::counter_not_allowed ? Check::wrong_checksum : said));
    RC_ASSERT(receiver.lost() == static_cast<std::uint64_t>(wire.lost()));
    RC_ASSERT((said == Check::counter_not_allowed) == (fate % 16 == 15 && fate < 48));
  }
}

}  // namespace
}  // namespace canhil::protection
