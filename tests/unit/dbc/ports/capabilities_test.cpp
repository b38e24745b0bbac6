// The capabilities that a port reports for its bus.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "dbc/ports/fd_groups.hpp"
#include "dbc/ports/local_bus.hpp"
#include "dbc/ports/several.hpp"

namespace canhil {
namespace {

std::string bus_named(std::string_view name) { return fmt::format("local:can-{}-{}", name, getpid()); }

std::unique_ptr<Port> hub_of(const std::string& bus, const PortOptions& options = {}) {
  return host_local_bus(bus, options).value();
}

TEST(Capabilities, ABusWithoutAWireReportsNothingOfItself) {
  const auto hub = hub_of(bus_named("a"));
  EXPECT_FALSE(hub->capabilities().reports_errors);
  EXPECT_FALSE(hub->capabilities().in_process);
  EXPECT_EQ(hub->capabilities().time, BusTime::host);
  EXPECT_EQ(hub->capabilities().wire.rates.nominal, 0);
}

TEST(Capabilities, AWireIsReportedByBothItsEnds) {
  const std::string bus = bus_named("b") + "?bitrate=500000&data-bitrate=2000000&queue=priority";
  const auto hub = hub_of(bus);
  const auto node = open_port(bus, {}).value();
  for (const Port* port : {hub.get(), node.get()}) {
    const Capabilities can = port->capabilities();
    EXPECT_TRUE(can.reports_errors);
    EXPECT_EQ(can.wire.rates.nominal, 500'000);
    EXPECT_EQ(can.wire.rates.data, 2'000'000);
    EXPECT_TRUE(can.wire.urgent_first);
  }
}

TEST(Capabilities, ContainersOfCanFdHideNothing) {
  const auto host = in_fd_groups(hub_of(bus_named("c") + "?bitrate=250000", {.fd = true}));
  EXPECT_TRUE(host->capabilities().reports_errors);
  EXPECT_EQ(host->capabilities().wire.rates.nominal, 250'000);
}

TEST(Capabilities, OfSeveralBusesAllMustTellOfErrorsAndNoneIsTheWire) {
  const auto joined = [](const std::string& second) {
    std::vector<std::unique_ptr<Port>> hubs;
    hubs.push_back(hub_of(bus_named("d") + "?bitrate=500000"));
    hubs.push_back(hub_of(second));
    return join_ports(std::move(hubs), [](const Frame&) { return std::size_t{0}; }).value();
  };
  EXPECT_FALSE(joined(bus_named("e"))->capabilities().reports_errors);
  const Capabilities both = joined(bus_named("e") + "?bitrate=500000")->capabilities();
  EXPECT_TRUE(both.reports_errors);
  EXPECT_EQ(both.wire.rates.nominal, 0);
}

TEST(LocalName, OnlyABusWithoutANameIsGivenOne) {
  EXPECT_EQ(named_local("local:", "x"), "local:x");
  EXPECT_EQ(named_local("local:?bitrate=500000", "x"), "local:x?bitrate=500000");
  for (const std::string other : {"local:y", "local:y?bitrate=500000", "can0", "in-process", ""})
    EXPECT_EQ(named_local(other, "x"), other);
}

TEST(JoinOrHost, TheFirstHostsAndTheSecondJoins) {
  const std::string bus = bus_named("f");
  const auto host = join_or_host(bus, {}, BusFormat::classic).value();
  const auto node = join_or_host(bus, {}, BusFormat::classic).value();
  for (int twice = 0; twice < 2; ++twice) EXPECT_FALSE(host->receive());
  ASSERT_EQ(node->send({.id = 5}), SendOutcome::sent);
  EXPECT_EQ(host->receive()->frame.id, 5U);
  // The bus is already hosted in the other format. The error states why the port cannot join it, which is
  // more useful than "hosted already".
  EXPECT_NE(join_or_host(bus, {}, BusFormat::fd).error().message.find("is classic CAN"), std::string::npos);
}

}  // namespace
}  // namespace canhil
