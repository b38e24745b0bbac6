// The bench can play every node of the DBC except bench and target.
#include "bench/nodes/registry.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cctype>
#include <set>

#include "bench/quantities/wire_unit.hpp"
#include "bench/sensors/registry.hpp"
#include "dbc/wire/turns.hpp"
#include "messages/canhil.hpp"

namespace canhil::nodes {
namespace {

// The table key of a sender: MasterIns becomes master_ins.
std::string key_of(std::string_view sender) {
  std::string key;
  for (const char c : sender) {
    if (std::isupper(c) != 0 && !key.empty()) key += '_';
    key += static_cast<char>(std::tolower(c));
  }
  return key;
}

TEST(Registry, HasANodeForEverySenderOfTheDbcAndItsTableHasItsName) {
  std::set<std::string> senders, keys;
  for (const MessageInfo& message : messages::all_messages) senders.insert(key_of(message.sender));
  senders.erase("bench");
  senders.erase("target");
  for (const Kind* kind : all()) {
    EXPECT_TRUE(keys.emplace(kind->table.key).second) << kind->table.key;
    EXPECT_EQ(key_of(kind->table.closes->sender), kind->table.key);
  }
  EXPECT_EQ(keys, senders);
}

TEST(Registry, WhatClosesAGroupIsTheLastOfItAndHasACycle) {
  for (const Kind* kind : all()) {
    const MessageInfo& closes = *kind->table.closes;
    EXPECT_GT(closes.cycle_time_us, 0) << closes.name;
    for (const MessageInfo& message : messages::all_messages) {
      if (message.sample_group == closes.sample_group) {
        EXPECT_LE(message.id, closes.id) << message.name;
      }
    }
  }
}

// What a sensor says of its values agrees with the signals that carry them.
TEST(Registry, EachValueAndFlagOfASensorHasASignal) {
  for (const Kind* kind : all()) {
    std::multiset<std::size_t> values, flags;
    for (const SampleSignal& signal : kind->signals) {
      if (signal.role == sensors::Role::validity) flags.insert(signal.index);
      if (signal.role != sensors::Role::value) continue;
      values.insert(signal.index);
      const sensors::Output& output = kind->table.sensor->outputs.values[signal.index];
      EXPECT_EQ(output.turns, wire::turns(signal.info)) << output.name;
      EXPECT_EQ(!output.rate.empty(), signal.info.carries_remainder) << output.name;
      const auto unit = quantities::wire_unit(signal.info.unit);
      if (!output.si.empty()) {
        EXPECT_EQ(output.si, unit.value().si) << output.name;
      }
    }
    const sensors::Outputs& outputs = kind->table.sensor->outputs;
    for (std::size_t i = 0; i < outputs.values.size(); ++i) EXPECT_EQ(values.count(i), 1U);
    for (std::size_t i = 0; i < outputs.flags.size(); ++i) EXPECT_EQ(flags.count(i), 1U);
    EXPECT_LE(outputs.values.size(), sensors::Sample::most_values);
  }
}

TEST(Registry, BindsEachSensor) {
  for (const sensors::Kind* sensor : sensors::all()) {
    EXPECT_EQ(bound(*sensor).table.sensor, sensor);
    EXPECT_GT(bound(*sensor).table.period_us, 0) << sensor->key;
  }
}

// The truth has a single sampling interval, so only one kind of node can be sampled at every epoch.
TEST(Registry, OneNodeSamplesEveryEpoch) {
  EXPECT_EQ(
      std::ranges::count(all(), true, [](const Kind* kind) { return kind->table.sensor->at_every_epoch; }),
      1);
}

}  // namespace
}  // namespace canhil::nodes
