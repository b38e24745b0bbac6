// Faults of frames on their way to the bus, and the other faults of the bus and of the target.
#include <algorithm>

#include "bench/protocol/receiver_model.hpp"
#include "tests/unit/bench/faults/flown_with_faults.hpp"

namespace canhil::faults {
namespace {

using messages::SlaveImuDeltaTheta;
using messages::SlaveImuDeltaV;
using messages::SlaveImuStatus;
using testing::ElementsAre;
using testing::SizeIs;

const std::vector<Frame> imu_frames{
    to_frame(SlaveImuDeltaTheta{.delta_theta_x_rad = 0.01, .gyro_validity = messages::Validity::valid}, 3),
    to_frame(SlaveImuDeltaV{}, 3)};

std::string of_rates(const std::string& kind, const std::string& more = "") {
  return "[[fault]]\nkind = \"" + kind + "\"\nmessages = [\"SlaveImuDeltaTheta\"]\n" + more;
}

// Applies the fault `times` times to the two IMU frames. Returns the frames that the last application leaves.
std::vector<Frame> left_of(const std::string& fault, std::int64_t t_us, int times = 1) {
  const auto scenario = parsed(fault).value();
  Place on_fd = everything;
  on_fd.fd = true;
  Faults faults(scenario, 0, messages::all_messages, on_fd);
  std::vector<Frame> left;
  for (int i = 0; i < times; ++i) {
    left = imu_frames;
    faults.injectors().front()->apply(left, t_us);
  }
  return left;
}

bool crc_is_right(const Frame& frame) {
  return frame.data[0] == e2e::crc(frame.payload(), SlaveImuDeltaTheta::info.e2e_data_id);
}

TEST(BusFaults, AffectTheirMessageInTheirTime) {
  const std::string lost = of_rates("lost", "from_s = 1\nto_s = 2");
  EXPECT_THAT(left_of(lost, 1'000'000), ElementsAre(imu_frames[1]));
  EXPECT_EQ(left_of(lost, 999'999), imu_frames);
  EXPECT_EQ(left_of(lost, 2'000'001), imu_frames);
}

TEST(BusFaults, EachKindDoesWhatItSays) {
  const auto damaged = left_of(of_rates("damaged"), 0);
  EXPECT_FALSE(crc_is_right(damaged.at(0)));
  EXPECT_NE(from_frame<SlaveImuDeltaTheta>(damaged.at(0)).delta_theta_x_rad,
            from_frame<SlaveImuDeltaTheta>(imu_frames[0]).delta_theta_x_rad);
  EXPECT_THAT(left_of(of_rates("repeated"), 0), ElementsAre(imu_frames[0], imu_frames[0], imu_frames[1]));
  EXPECT_EQ(left_of(of_rates("too_short"), 0).at(0).size, 7);
  EXPECT_EQ(left_of(of_rates("too_long"), 0).at(0).size, 12);
  EXPECT_TRUE(left_of(of_rates("foreign"), 0).at(0).extended);
  const Frame wrong = left_of(of_rates("wrong_crc"), 0).at(0);
  EXPECT_FALSE(crc_is_right(wrong));
  EXPECT_TRUE(std::equal(wrong.data.begin() + 1, wrong.data.begin() + 8, imu_frames[0].data.begin() + 1));
  const Frame ahead = left_of(of_rates("counter_jump", "by = 13"), 0).at(0);
  EXPECT_TRUE(crc_is_right(ahead));
  EXPECT_EQ(e2e::counter(ahead.payload()), (3 + 13) % 15);
}

TEST(BusFaults, SoManyBitsAreDamaged) {
  const Frame damaged = left_of(of_rates("damaged", "bits = 5"), 0).at(0);
  int flipped = 0;
  for (std::size_t i = 0; i < 8; ++i)
    flipped += std::popcount(static_cast<unsigned>(damaged.data[i] ^ imu_frames[0].data[i]));
  EXPECT_EQ(flipped, 5);
}

TEST(BusFaults, AffectEverySoManythOrSomeByChanceOrInPeriods) {
  const auto lost = [](const std::string& more) {
    std::vector<std::int64_t> missing_ms;
    const Flight flight(of_rates("lost", more));
    const auto sent = flight.of(SlaveImuStatus::info.id), left = flight.of(SlaveImuDeltaTheta::info.id);
    for (const auto& [t_us, frame] : sent) {
      if (std::ranges::find(left, t_us, &Timed::value_type::first) == left.end())
        missing_ms.push_back(t_us / 1000);
    }
    EXPECT_EQ(flight.count(), missing_ms.size());
    return missing_ms;
  };
  EXPECT_THAT(lost("every = 3\nfrom_s = 1\nto_s = 1.07"), ElementsAre(1000, 1030, 1060));
  EXPECT_THAT(lost("from_s = 1\nto_s = 1.3\nfor_s = 0.02\neach_s = 0.2"),
              ElementsAre(1000, 1010, 1200, 1210));
  EXPECT_THAT(lost("from_s = 1\nfor_s = 0.02"), ElementsAre(1000, 1010, 1020)) << "its end is in it";
  const auto by_chance = lost("percent = 20");
  EXPECT_GT(by_chance.size(), 30U);
  EXPECT_LT(by_chance.size(), 90U);
  EXPECT_EQ(by_chance, lost("percent = 20")) << "same seed, same bits";
  EXPECT_NE(by_chance, lost("percent = 20\nname = \"another\"")) << "each fault has its own chance";
}

TEST(BusFaults, AFrameIsDelayedOrChangesPlacesWithTheNext) {
  const Flight delayed(of_rates("delayed", "by_ms = 3.5\nfrom_s = 1\nto_s = 1"));
  EXPECT_EQ(std::ranges::count(delayed.of(SlaveImuDeltaTheta::info.id), 1'003'500, &Timed::value_type::first),
            1);
  EXPECT_EQ(delayed.of(SlaveImuDeltaTheta::info.id).size(), delayed.of(SlaveImuDeltaV::info.id).size());
  const Flight reordered(of_rates("reordered", "from_s = 1\nto_s = 1"));
  const auto frames = reordered.of(SlaveImuDeltaTheta::info.id);
  const auto at = std::ranges::find(frames, 1'010'000, &Timed::value_type::first) - frames.begin();
  const auto counter = [&](std::ptrdiff_t i) {
    return int{e2e::counter(frames.at(static_cast<std::size_t>(i)).second.payload())};
  };
  EXPECT_EQ(frames.at(static_cast<std::size_t>(at + 1)).first, 1'010'000) << "both with the second's time";
  EXPECT_EQ((counter(at + 1) + 1) % 15, counter(at)) << "the second one first";
}

TEST(BusFaults, ACounterThatStaysIsRepeatedForWhoReceivesIt) {
  const Flight flight(of_rates("counter_stuck", "from_s = 1\nto_s = 1.04"));
  e2e::Receiver receiver;
  int repeated = 0;
  for (const auto& [t_us, frame] : flight.of(SlaveImuDeltaTheta::info.id))
    repeated += receiver.check(frame.payload(), SlaveImuDeltaTheta::info.e2e_data_id) == e2e::Check::repeated;
  EXPECT_EQ(repeated, 4);
}

TEST(BusFaults, StrangersAndFloodsComeBetween) {
  const Flight stranger("[[fault]]\nkind = \"stranger\"\nperiod_ms = 50\nfrom_s = 1\nto_s = 1.2");
  EXPECT_EQ(stranger.count(), 5U);
  EXPECT_THAT(stranger.of(0x7FF), SizeIs(5)) << "the highest id is free";
  // 8 zero bytes: 111 bits and the stuff bits of a frame of zeros, at 500 kbit/s.
  const Flight flood("[[fault]]\nkind = \"flood\"\nload_percent = 50\nfrom_s = 1\nto_s = 1.1");
  const double bits = static_cast<double>(wire::bit_length(Frame{.id = 0, .size = 8}).bits());
  EXPECT_NEAR(static_cast<double>(flood.of(0).size()), 0.1 * 0.5 * 500e3 / bits, 2);
}

TEST(BusFaults, TheControllersStateIsReportedAndEnds) {
  for (const char* kind : {"error_passive", "bus_off"}) {
    const Flight flight(std::string("[[fault]]\nkind = \"") + kind + "\"\nfrom_s = 1\nfor_s = 0.1");
    EXPECT_THAT(flight.hands.errors, SizeIs(2)) << kind;
    EXPECT_EQ(flight.count(), 1U);
  }
  const Flight errors("[[fault]]\nkind = \"error_frame\"\nperiod_ms = 100\nfrom_s = 1\nto_s = 1.5");
  EXPECT_THAT(errors.hands.errors, SizeIs(6));
  const Flight down("[[fault]]\nkind = \"interface_down\"\nfrom_s = 1\nfor_s = 0.1");
  EXPECT_THAT(down.hands.done, ElementsAre("down for 100000", "up"));
}

TEST(TargetFaults, LayHandsOnItsProcess) {
  const Flight paused("[[fault]]\nkind = \"paused\"\nfrom_s = 1\nfor_s = 0.1\neach_s = 1");
  EXPECT_THAT(paused.hands.done, ElementsAre("pause", "resume", "pause", "resume"));
  EXPECT_EQ(paused.schedule.silent_until_us(), 2'100'000) << "until then silence is no fault of the target";
  const Flight slowed("[[fault]]\nkind = \"slowed\"\ncpu_percent = 30\nfrom_s = 1\nto_s = 1.02");
  EXPECT_THAT(slowed.hands.done, ElementsAre("pause", "resume", "pause", "resume"));
  const Flight restarted("[[fault]]\nkind = \"restarted\"\nfrom_s = 1");
  EXPECT_THAT(restarted.hands.done, ElementsAre("restart at 1000000"));
}

TEST(TargetFaults, LetGoWhenARunEndsEarly) {
  const auto scenario = parsed("[[fault]]\nkind = \"paused\"\nfrom_s = 1\nfor_s = 0.1").value();
  Noted hands;
  Faults faults(scenario, 0, messages::all_messages, everything, &hands);
  std::vector<Frame> none;
  faults.injectors().front()->transmit(none);
  faults.injectors().front()->end();
  EXPECT_THAT(hands.done, ElementsAre("pause", "resume"));
}

}  // namespace
}  // namespace canhil::faults
