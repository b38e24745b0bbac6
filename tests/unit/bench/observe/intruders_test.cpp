#include "bench/observe/intruders.hpp"

#include <gmock/gmock.h>

#include "dbc/wire/transmit.hpp"
#include "messages/canhil.hpp"

namespace canhil::observe {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pair;

template <class Message>
Frame frame_of(const Message& message) {
  Outbox<1> out;
  out.send(message);
  return out.frames().front();
}

TEST(IntrudersOnTheBus, AreThoseWhoSendWhatTheBenchSends) {
  const Frame sync = frame_of(messages::Sync{});
  const Frame command = frame_of(messages::TargetCommand{});
  Intruders intruders{messages::all_messages};
  intruders.received({.frame = command});  // the bench has not yet sent a command
  intruders.transmitted(sync, 0, 0);
  intruders.transmitted(command, 0, 0);
  for (int n = 0; n < 2; ++n) intruders.received({.frame = sync});
  intruders.received({.frame = command});
  EXPECT_THAT(intruders.frames(), ElementsAre(Pair("Sync", 2U), Pair("TargetCommand", 1U)));
}

TEST(IntrudersOnTheBus, AreNeitherEchoesNorTheTargetNorErrors) {
  const Frame sync = frame_of(messages::Sync{});
  Intruders intruders{messages::all_messages};
  intruders.transmitted(sync, 0, 0);
  intruders.received({.frame = sync, .own = true});
  intruders.received({.frame = frame_of(messages::TargetHeartbeat{})});
  intruders.received({.frame = {.id = sync.id, .size = 8, .error = true}});
  intruders.received({.frame = {.id = sync.id, .size = 8, .extended = true}});
  EXPECT_THAT(intruders.frames(), IsEmpty());
}

}  // namespace
}  // namespace canhil::observe
