// Faults of sensors and nodes: each kind is compared with the same flight without a fault.
#include <cmath>
#include <set>

#include "dbc/wire/time_base.hpp"
#include "tests/unit/bench/faults/flown_with_faults.hpp"

namespace canhil::faults {
namespace {

using messages::MasterInsAttitude;
using messages::MasterInsVelocityD;
using messages::MasterInsVelocityNE;
using messages::SlaveImuDeltaTheta;
using messages::SlaveImuDeltaV;
using messages::SlaveImuStatus;

const Flight& right() {
  static const Flight flight("");
  return flight;
}

// Two increments may differ by two steps of their signal although their sensors measure the same: each is
// sent with the remainder of the increments before it and without its own, and a remainder is half a step at
// most.
constexpr double rate_steps = 2.001 * 2e-6 / 0.01, force_steps = 2.001 * 2e-5 / 0.01;  // [rad/s], [m/s^2]
double rate_z(const SlaveImuDeltaTheta& one) { return one.delta_theta_z_rad / 0.01; }
double force_x(const SlaveImuDeltaV& one) { return one.delta_v_x_mps / 0.01; }

// For each sample in a time window, passes to `look` the value of a number without the fault, its value with
// the fault, and the time. Outside the window, the difference of the two values must be at most `tolerance`.
template <class Message, class Number>
void each(const Flight& faulty, double from_s, double to_s, Number number,
          const std::function<void(double was, double is, double t_s)>& look, double tolerance) {
  const auto before = said<Message>(right()), after = said<Message>(faulty);
  ASSERT_EQ(before.size(), after.size());
  int looked = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const double t_s = 1e-6 * static_cast<double>(before[i].first);
    if (t_s < from_s - 1e-9 || t_s > to_s + 1e-9) {
      EXPECT_NEAR(number(before[i].second), number(after[i].second), tolerance) << t_s;
      continue;
    }
    look(number(before[i].second), number(after[i].second), t_s);
    ++looked;
  }
  EXPECT_GT(looked, 0);
}

const std::string rate = "quantity = \"imu.rate.z\"\nfrom_s = 1\nto_s = 2\n";
constexpr double degps = M_PI / 180;

TEST(SensorFaults, ABiasOfARateIsInItsIncrementsAndNothingIsLostByRounding) {
  // 1e-3 deg/s gives 1.7e-7 rad per sample, which is a twelfth of the resolution of the signal. Such an
  // increment reaches the bus only because the remainder of each rounding is carried to the next sample.
  double sum = 0;
  each<SlaveImuDeltaTheta>(
      Flight(fault("bias", rate + "by_degps = 1e-3")), 1, 2, rate_z,
      [&](double was, double is, double) { sum += 0.01 * (is - was); }, rate_steps);
  EXPECT_NEAR(sum, 1.01 * 1e-3 * degps, 2e-6) << "within a step after 101 samples";
}

TEST(SensorFaults, EachKindChangesTheNumberAsItSays) {
  const double step = rate_steps;
  each<SlaveImuDeltaTheta>(
      Flight(fault("drift", rate + "by_degps = 2")), 1, 2, rate_z,
      [&](double was, double is, double t) { EXPECT_NEAR(is - was, 2 * degps * (t - 1), step); }, rate_steps);
  each<SlaveImuDeltaTheta>(
      Flight(fault("reversed", rate)), 1, 2, rate_z,
      [&](double was, double is, double) { EXPECT_NEAR(is, -was, step); }, rate_steps);
  std::optional<double> first;
  each<SlaveImuDeltaTheta>(
      Flight(fault("stuck", rate)), 1, 2, rate_z,
      [&](double was, double is, double) {
        if (!first) first = was;
        EXPECT_NEAR(is, *first, step);
      },
      rate_steps);
  int sample = 0, changed = 0;
  each<SlaveImuDeltaTheta>(
      Flight(fault("stuck", rate + "every = 5")), 1, 2, rate_z,
      [&](double was, double is, double) {
        const bool affected = sample++ % 5 == 0;
        EXPECT_NEAR(is, affected ? *first : was, step);
        changed += is != was ? 1 : 0;
      },
      rate_steps);
  EXPECT_GT(changed, 0) << "the samples between affected ones do not end the fault";
  each<SlaveImuDeltaV>(
      Flight(fault("saturated", "quantity = \"imu.specific_force.x\"\nat_mps2 = 5")), 0, 9, force_x,
      [&](double was, double is, double) { EXPECT_NEAR(is, std::min(was, 5.0), force_steps); }, force_steps);
  double squares = 0;
  int count = 0;
  each<SlaveImuDeltaTheta>(
      Flight(fault("noise", rate + "sigma_degps = 1")), 1, 2, rate_z,
      [&](double was, double is, double) {
        squares += std::pow((is - was) / degps, 2);
        ++count;
      },
      rate_steps);
  EXPECT_NEAR(std::sqrt(squares / count), 1, 0.3);
  int spikes = 0;
  each<SlaveImuDeltaTheta>(
      Flight(fault("spike", rate + "by_degps = 10\nevery = 25")), 1, 2, rate_z,
      [&](double was, double is, double) { spikes += std::abs(is - was) > 9 * degps; }, rate_steps);
  EXPECT_EQ(spikes, 5);
  each<MasterInsAttitude>(
      Flight(fault("bias", "quantity = \"master_ins.heading\"\nby_deg = 190")), 0, 9,
      [](const MasterInsAttitude& one) { return one.heading_deg; },
      [](double was, double is, double) { EXPECT_NEAR(std::remainder(is - was - 190, 360), 0, 0.01); }, 0);
  each<SlaveImuDeltaTheta>(
      Flight(fault("changed",
                   "messages = [\"SlaveImuDeltaTheta\"]\nsignal = \"delta_theta_y_rad\"\n"
                   "value = -0.05\nfrom_s = 1\nto_s = 2")),
      1, 2, [](const SlaveImuDeltaTheta& one) { return one.delta_theta_y_rad; },
      [](double, double is, double) { EXPECT_NEAR(is, -0.05, 1e-12); }, 0.01 * rate_steps);
}

TEST(SensorFaults, ChangeFramesThatRoundNothing) {
  const Flight flight(fault("bias", rate + "by_degps = 1e-4"), 0, Rounding::none);
  const Flight without("", 0, Rounding::none);
  const auto before = said<SlaveImuDeltaTheta>(without), after = said<SlaveImuDeltaTheta>(flight);
  EXPECT_NEAR(rate_z(after.at(150).second) - rate_z(before.at(150).second), 1e-4 * degps, 1e-12);
  EXPECT_EQ(after.at(150).second.delta_theta_x_rad, before.at(150).second.delta_theta_x_rad);
}

TEST(SensorFaults, TwoAxesAreSwapped) {
  const Flight flight(fault("swapped",
                            "quantity = \"imu.specific_force.x\"\nwith = \"imu.specific_force.z\"\n"
                            "from_s = 2"));
  const auto before = said<SlaveImuDeltaV>(right()), after = said<SlaveImuDeltaV>(flight);
  EXPECT_NEAR(after.back().second.delta_v_x_mps, before.back().second.delta_v_z_mps, 4.001e-5);
  EXPECT_NEAR(after.back().second.delta_v_z_mps, before.back().second.delta_v_x_mps, 4.001e-5);
}

TEST(SensorFaults, AnInvalidSampleSaysSo) {
  const Flight flight(fault("invalid", "node = \"slave_imu\"\nfrom_s = 1\nto_s = 1"));
  int gyro = 0, accel = 0;
  for (const auto& [t_us, one] : said<SlaveImuDeltaTheta>(flight))
    gyro += one.gyro_validity == messages::Validity::invalid;
  for (const auto& [t_us, one] : said<SlaveImuDeltaV>(flight))
    accel += one.accel_validity == messages::Validity::invalid;
  EXPECT_EQ(gyro, 1);
  EXPECT_EQ(accel, 1);
}

TEST(SensorFaults, ALateSampleCarriesItsOwnTime) {
  const Flight flight(fault("late", "node = \"master_ins\"\nby_ms = 30\nfrom_s = 1\nto_s = 1"));
  for (const auto& [t_us, one] : said<MasterInsVelocityD>(flight))
    EXPECT_EQ(t_us - one.time_of_validity_us, one.time_of_validity_us == 1'000'000 ? 30'000 : 0);
}

// The number of frames that a receiver of one message must count as lost.
template <class Message>
int lost(const Flight& flight) {
  e2e::Receiver receiver;
  int lost = 0;
  for (const auto& [t_us, frame] : flight.of(Message::info.id)) {
    receiver.check(frame.payload(), Message::info.e2e_data_id);
    lost += receiver.lost();
  }
  return lost;
}

TEST(NodeFaults, ASilentNodeGoesOnCountingWhereItStopped) {
  const Flight flight(fault("silent", "node = \"slave_imu\"\nfrom_s = 1\nto_s = 1.05"));
  EXPECT_EQ(flight.of(SlaveImuStatus::info.id).size() + 6, right().of(SlaveImuStatus::info.id).size());
  EXPECT_EQ(lost<SlaveImuStatus>(flight), 0);
  EXPECT_EQ(flight.count(), 6U);
}

TEST(NodeFaults, ARestartedNodeCountsFromZero) {
  const Flight flight(fault("restart", "node = \"slave_imu\"\nfrom_s = 1\nsilent_s = 0.1"));
  for (const auto& [t_us, frame] : flight.of(SlaveImuStatus::info.id)) {
    if (t_us <= 1'100'000) continue;
    EXPECT_EQ(e2e::counter(frame.payload()), 0);
    break;
  }
}

TEST(NodeFaults, ASlowNodeLosesNoIncrement) {
  const Flight flight(fault("slow", "node = \"slave_imu\"\nlonger_percent = 50\nfrom_s = 1"));
  double was = 0, is = 0, interval_us = 0;
  for (const auto& [t_us, one] : said<SlaveImuDeltaV>(right())) was += one.delta_v_x_mps;
  for (const auto& [t_us, one] : said<SlaveImuDeltaV>(flight)) is += one.delta_v_x_mps;
  for (const auto& [t_us, one] : said<SlaveImuStatus>(flight)) interval_us += one.interval_us;
  const auto last = said<SlaveImuStatus>(flight).back().second;
  EXPECT_EQ(interval_us, last.time_of_validity_us) << "the intervals reach from one sample to the next";
  EXPECT_NEAR(is, was, 0.11) << "but for a sample that is not sent before the end";
  EXPECT_EQ(lost<SlaveImuStatus>(flight), 0);
  EXPECT_EQ(flight.of(SlaveImuStatus::info.id).size() + flight.count(),
            right().of(SlaveImuStatus::info.id).size());
  EXPECT_NEAR(static_cast<double>(flight.count()), 200.0 / 3, 2) << "two in three are sent";
}

TEST(NodeFaults, AClockIsOff) {
  const Flight step(fault("clock_step", "node = \"master_ins\"\nby_ms = -40\nfrom_s = 1"));
  for (const auto& [t_us, one] : said<MasterInsVelocityD>(step))
    EXPECT_EQ(one.time_of_validity_us - t_us, t_us < 1'000'000 ? 0 : -40'000);
  const Flight drift(fault("clock_drift", "node = \"slave_imu\"\nby_ppm = 1000\nfrom_s = 1"));
  const auto last = said<SlaveImuStatus>(drift).back();
  EXPECT_EQ(last.second.time_of_validity_us - last.first, 2000) << "1e-3 of 2 s";
}

TEST(NodeFaults, OfASeekerGoTheSameWay) {
  const Flight flight(fault("stuck", "quantity = \"seeker.range\"\nfrom_s = 0.5\nto_s = 0.6"), 0,
                      Rounding::as_on_the_bus, "los_quick");
  std::set<double> ranges;
  for (const auto& [t_us, one] : said<messages::SeekerRange>(flight)) {
    if (t_us >= 500'000 && t_us <= 600'000) ranges.insert(one.range_m);
  }
  EXPECT_EQ(ranges.size(), 1U);
}

}  // namespace
}  // namespace canhil::faults
