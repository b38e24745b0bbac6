// The CAN FD version of the DBC, which dbcgen derives from the classic one.
#include "dbc/codegen/fd.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <random>

#include "dbc/codegen/json.hpp"
#include "dbc/codegen/write.hpp"
#include "dbc/parser/codec.hpp"
#include "dbc/parser/parse.hpp"
#include "dbc/ports/fd_groups.hpp"
#include "messages/canhil_fd.hpp"

namespace canhil::dbc {
namespace {

using testing::HasSubstr;

std::string text_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

Database classic() { return read_file(SOURCE_DIR "/dbc/canhil.dbc").value(); }
Database committed() { return read_file(SOURCE_DIR "/dbc/canhil-fd.dbc").value(); }

TEST(FdContract, TheCommittedFileIsWhatDbcgenMakes) {
  EXPECT_TRUE(fd_text(classic(), "canhil.dbc").value() == text_of(SOURCE_DIR "/dbc/canhil-fd.dbc"))
      << "dbc/canhil.dbc has changed: dbcgen dbc/canhil.dbc --fd -o dbc/canhil-fd.dbc";
  EXPECT_EQ(committed().hash, messages_fd::fd_hash);
  EXPECT_EQ(classic().hash, messages_fd::classic_hash);
}

TEST(FdContract, WhatIsWrittenReadsAsTheSame) {
  for (const Database& database : {classic(), committed()})
    EXPECT_EQ(to_json(parse(dbc_text(database), "written").value()), to_json(database));
}

TEST(FdContract, EveryFrameIsFdWithBitRateSwitchAndASizeThatHasADlc) {
  const Database database = committed();
  for (const Message& message : database.messages) {
    EXPECT_TRUE(message.fd) << message.name;
    EXPECT_THAT((std::array{8U, 16U, 24U, 32U, 48U, 64U}), testing::Contains(message.size)) << message.name;
    EXPECT_EQ(std::get<std::string>(message.attributes.at("CANFD_BRS")), "1") << message.name;
  }
}

TEST(FdContract, OneFrameASampleGroupOfUpToEightMessages) {
  const Database fd = committed();
  std::map<std::string, int> members, frames;
  for (const Message& message : classic().messages) ++members[message.sample_group];
  for (const Message& message : fd.messages) ++frames[message.sample_group];
  ASSERT_EQ(members.size(), frames.size());
  for (const auto& [group, count] : members) {
    if (group.empty()) continue;
    EXPECT_EQ(frames[group], (count + 7) / 8) << group;
  }
  EXPECT_EQ(members[""], frames[""]);
  EXPECT_EQ(find_message(fd, "SlaveImu")->id, find_message(classic(), "SlaveImuDeltaTheta")->id);
  EXPECT_EQ(find_message(fd, "SlaveImu")->size, 24U);
  EXPECT_EQ(find_message(fd, "FixFilter1")->size, 64U);
  EXPECT_EQ(find_message(fd, "FixFilter2")->size, 48U);
}

// The classic messages of each container get random bytes. The FD DBC must decode the same values from the
// container that the port packs.
TEST(FdContract, AContainerHoldsTheValuesOfItsMessages) {
  const Database old = classic();
  const Database fd = committed();
  std::mt19937 random(7);
  std::size_t values = 0;
  for (const wire::FdContainer& container : messages_fd::containers) {
    FdPacker packer;
    std::optional<Frame> packed;
    std::vector<Frame> frames;
    for (std::size_t slot = 0; slot < container.count; ++slot) {
      Frame frame{.id = container.slots[slot], .size = 8};
      for (std::size_t i = 0; i < 8; ++i) frame.data[i] = static_cast<std::uint8_t>(random() | 1U);
      frames.push_back(frame);
      packed = packer.put(frame);
    }
    ASSERT_TRUE(packed);
    const Message& message = *find_message(fd, container.id);
    EXPECT_EQ(message.name, container.name);
    const auto all = decode(message, packed->payload());
    auto next = all->begin();
    for (const Frame& frame : frames) {
      const auto alone = decode(*find_message(old, frame.id), frame.payload());
      for (const DecodedSignal& signal : *alone) {
        ASSERT_NE(next, all->end());
        EXPECT_THAT(next->signal->name, testing::StartsWith(signal.signal->name));
        EXPECT_EQ(next->value, signal.value) << message.name << '.' << next->signal->name;
        EXPECT_EQ(next->signal->values, signal.signal->values);
        ++next;
        ++values;
      }
    }
    EXPECT_EQ(next, all->end());
  }
  EXPECT_GT(values, 300U);
}

Result<Database> with(void (*change)(Database&)) {
  Database database = classic();
  change(database);
  return on_fd(database, "my.dbc");
}

Message& message(Database& database, std::string_view name) {
  return *std::ranges::find(database.messages, name, &Message::name);
}

TEST(FdContract, AContractThatNoContainerCanCarryIsRefused) {
  const auto late = with([](Database& d) { message(d, "SlaveImuStatus").id = 127; });
  ASSERT_FALSE(late);
  EXPECT_THAT(late.error().message,
              HasSubstr("message SlaveImuStatus: on CAN FD expected with the highest id"));
  const auto open = with([](Database& d) { message(d, "GpsTime").e2e_data_id = 0; });
  ASSERT_FALSE(open);
  EXPECT_THAT(open.error().message, HasSubstr("message GpsTime: on CAN FD expected of 8 bytes"));
  const auto slow = with([](Database& d) { message(d, "SeekerAngles").cycle_time_us = 20'000; });
  ASSERT_FALSE(slow);
  EXPECT_THAT(slow.error().message, HasSubstr("expected with sender and cycle time of SeekerRange"));
  const auto wide = with([](Database& d) { message(d, "Sync").fd = true; });
  ASSERT_FALSE(wide);
  EXPECT_THAT(wide.error().message, testing::StartsWith("my.dbc:"));
  // A slot of zeros means that its message is missing; with this data id, zeros would have a correct CRC.
  const auto zero = with([](Database& d) { message(d, "SeekerAngles").e2e_data_id = 0x183; });
  ASSERT_FALSE(zero);
  EXPECT_THAT(zero.error().message, HasSubstr("its CRC of zeros is 0"));
}

}  // namespace
}  // namespace canhil::dbc
