#include "dbc/ports/several.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <ctime>
#include <utility>

#include "dbc/ports/descriptor.hpp"
#include "dbc/ports/local_bus.hpp"

namespace canhil {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// Two hubs as one port: even ids on the first bus, odd ids on the second, and a node on each bus.
class Several : public testing::Test {
 protected:
  void SetUp() override {
    std::vector<std::unique_ptr<Port>> hubs;
    for (int i = 0; i < 2; ++i) {
      buses_.push_back(fmt::format("local:several-{}-{}", getpid(), i));
      auto hub = host_local_bus(buses_.back(), {.own_echo = true});
      ASSERT_TRUE(hub) << hub.error().message;
      hubs.push_back(std::move(*hub));
      auto node = join_local_bus(buses_.back(), {});
      ASSERT_TRUE(node) << node.error().message;
      nodes_.push_back(std::move(*node));
    }
    auto joined = join_ports(std::move(hubs), [](const Frame& frame) { return std::size_t{frame.id % 2}; });
    ASSERT_TRUE(joined) << joined.error().message;
    port_ = std::move(*joined);
    for (int look = 0; look < 10; ++look) port_->receive();
  }
  std::vector<std::uint32_t> waiting(Port& port) {
    std::vector<std::uint32_t> ids;
    while (const auto received = port.receive()) ids.push_back(received->frame.id);
    return ids;
  }
  std::vector<std::string> buses_;
  std::vector<std::unique_ptr<Port>> nodes_;
  std::unique_ptr<Port> port_;
};

TEST_F(Several, EachFrameGoesToTheBusOfItsRoute) {
  for (const std::uint32_t id : {2U, 3U, 4U, 5U}) ASSERT_EQ(port_->send({.id = id}), SendOutcome::sent);
  EXPECT_THAT(waiting(*nodes_[0]), ElementsAre(2, 4));
  EXPECT_THAT(waiting(*nodes_[1]), ElementsAre(3, 5));
  EXPECT_EQ(port_->counters().sent, 4U);
}

TEST_F(Several, WhatWaitsComesInTheOrderOfItsStamps) {
  for (const std::uint32_t id : {3U, 5U, 2U, 7U, 4U}) ASSERT_EQ(port_->send({.id = id}), SendOutcome::sent);
  EXPECT_THAT(waiting(*port_), ElementsAre(3, 5, 2, 7, 4)) << "the echoes";
}

TEST_F(Several, AFrameOnAnyBusEndsTheWait) {
  for (const auto& node : nodes_) {
    EXPECT_FALSE(wait(*port_, WaitFor::frame, clock_ns(CLOCK_MONOTONIC)));
    ASSERT_EQ(node->send({.id = 9}), SendOutcome::sent);
    EXPECT_TRUE(wait(*port_, WaitFor::frame, clock_ns(CLOCK_MONOTONIC) + 10'000'000'000));
    EXPECT_THAT(waiting(*port_), ElementsAre(9));
  }
}

TEST_F(Several, NamesTheFirstAndEndsWithAny) {
  EXPECT_EQ(port_->name(), buses_[0]);
  auto both = open_buses(buses_, {});
  ASSERT_TRUE(both) << both.error().message;
  for (int look = 0; look < 10; ++look) port_->receive();
  ASSERT_EQ((*both)->send({.id = 3}), SendOutcome::sent);
  EXPECT_THAT(waiting(*nodes_[1]), ElementsAre()) << "all goes to the first bus";
  EXPECT_FALSE((*both)->closed());
  port_.reset();
  while ((*both)->receive()) {
  }
  EXPECT_TRUE((*both)->closed());
}

TEST_F(Several, ABusThatIsNotThereIsNamed) {
  const auto missing = open_buses({buses_[0], "local:nobody-hosts-this"}, {});
  ASSERT_FALSE(missing);
  EXPECT_THAT(missing.error().message, HasSubstr("local:nobody-hosts-this"));
}

// A controller that delivers one frame, with a time stamp of a separate clock.
class Controller final : public Port {
 public:
  explicit Controller(std::int64_t hardware_ns) {
    one_ = Received{
        .frame = {.id = 5}, .t_ns = 1'000, .hardware_ns = hardware_ns, .source = StampSource::hardware};
  }
  SendOutcome send(const Frame& /*frame*/) override { return SendOutcome::sent; }
  std::optional<Received> receive() override { return std::exchange(one_, std::nullopt); }
  [[nodiscard]] int descriptor() const override { return event_.get(); }
  [[nodiscard]] RoomWait room_wait() const override { return {}; }
  [[nodiscard]] bool closed() const override { return false; }
  [[nodiscard]] PortCounters counters() const override { return {}; }
  [[nodiscard]] int stamp_clock() const override { return CLOCK_REALTIME; }
  [[nodiscard]] const std::string& name() const override { return name_; }

 private:
  std::optional<Received> one_;
  Descriptor event_{::eventfd(0, EFD_CLOEXEC)};
  std::string name_ = "can0";
};

// The difference between stamps of two controllers would contain the difference of their clocks.
TEST(SeveralControllers, AreStampedByTheOneClockOfTheKernel) {
  std::vector<std::unique_ptr<Port>> ports;
  for (const std::int64_t hardware_ns : {std::int64_t{7'000'000}, std::int64_t{9'000'000'000}})
    ports.push_back(std::make_unique<Controller>(hardware_ns));
  const auto joined = join_ports(std::move(ports), [](const Frame&) { return std::size_t{0}; });
  ASSERT_TRUE(joined);
  for (int i = 0; i < 2; ++i) {
    const auto received = (*joined)->receive();
    ASSERT_TRUE(received);
    EXPECT_EQ(received->hardware_ns, 0);
    EXPECT_EQ(received->source, StampSource::kernel);
    EXPECT_EQ(received->t_ns, 1'000);
  }
}

}  // namespace
}  // namespace canhil
