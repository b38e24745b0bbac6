#include "dbc/ports/bit_errors.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <vector>

namespace canhil {
namespace {

constexpr wire::BitRates rates{.nominal = 500'000, .data = 2'000'000};
constexpr std::int64_t bit_ns = 2'000;

Attempt attempt_of(const Frame& frame) { return {.frame = frame}; }

Frame frame(std::uint32_t number) {
  Frame f{.id = 0x123, .size = 8};
  for (unsigned i = 0; i < 4; ++i) f.data.at(i) = static_cast<std::uint8_t>(number >> (8 * i));
  return f;
}

TEST(BitErrors, AFrameIsHitAsOftenAsItsBitsSayAndAnywhere) {
  constexpr double p = 1e-3;
  constexpr int tries = 20'000;
  const Frame f = frame(0x55AA);
  const auto bits = static_cast<double>(wire::bit_length(f).bits() - 3);
  BitErrors errors(p, rates, 7);
  int hits = 0;
  double mean = 0;
  std::int64_t first_ns = 1'000'000'000, last_ns = 0;
  for (int i = 0; i < tries; ++i) {
    const auto error = errors(attempt_of(f));
    if (!error) continue;
    ++hits;
    EXPECT_FALSE(error->at);
    ASSERT_EQ(error->after_ns % bit_ns, 0);
    const std::int64_t bit = error->after_ns / bit_ns;
    mean += static_cast<double>(bit);
    first_ns = std::min(first_ns, error->after_ns);
    last_ns = std::max(last_ns, error->after_ns);
  }
  const double share = 1 - std::pow(1 - p, bits);
  EXPECT_NEAR(hits, tries * share, 5 * std::sqrt(tries * share * (1 - share)));
  // Only the first of several errors in a frame counts, so the distribution is not quite uniform: for a frame
  // of n bits, the mean differs from the middle by p n / 12 of the length, here 1 %.
  EXPECT_NEAR(mean / hits / bits, 0.5, 0.01 + 5 * std::sqrt(1. / 12 / hits));
  EXPECT_EQ(first_ns, bit_ns);
  EXPECT_EQ(last_ns, static_cast<std::int64_t>(bits) * bit_ns);
}

TEST(BitErrors, TheSeedDecides) {
  const auto hits = [](std::uint64_t seed) {
    BitErrors errors(1e-3, rates, seed);
    std::vector<std::int64_t> at;
    for (std::uint32_t i = 0; i < 200; ++i) {
      const auto error = errors(attempt_of(frame(i)));
      at.push_back(error ? error->after_ns : 0);
    }
    return at;
  };
  EXPECT_EQ(hits(3), hits(3));
  EXPECT_NE(hits(3), hits(4));
}

TEST(BitErrors, NeverAndAlways) {
  BitErrors always(1, rates, 1);
  EXPECT_EQ(always(attempt_of(frame(0)))->after_ns, bit_ns);
  BitErrors hardly(1e-12, rates, 1);
  for (std::uint32_t i = 0; i < 100; ++i) EXPECT_FALSE(hardly(attempt_of(frame(i))));
}

// The error flag begins at the end of the disturbed bit. In the data phase, bits are shorter.
TEST(BitErrors, BitsOfTheDataPhaseAreShorter) {
  Frame fd{.id = 0x123, .size = 64, .fd = true, .brs = true};
  const wire::BitLength length = wire::bit_length(fd);
  const std::int64_t data_from_ns = (length.nominal - wire::frame_end_bits) * bit_ns;
  const std::int64_t data_to_ns = data_from_ns + length.data * 500;
  BitErrors errors(1e-3, rates, 1);
  int in_data = 0;
  for (int i = 0; i < 2'000; ++i) {
    const auto error = errors(attempt_of(fd));
    if (!error) continue;
    EXPECT_LE(error->after_ns, wire::duration_ns(length, rates) - 3 * bit_ns);
    if (error->after_ns <= data_from_ns || error->after_ns > data_to_ns) continue;
    ++in_data;
    EXPECT_EQ((error->after_ns - data_from_ns) % 500, 0);
  }
  EXPECT_GT(in_data, 100);
}

// Each of three nodes sends a frame every 2 ms at 500 kbit/s. About every fiftieth attempt is disturbed; no
// node goes bus-off.
TEST(BitErrors, EveryFrameIsSentAgainUntilItIsThrough) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SimulatedWire wire(rates, {{.order = QueueOrder::fifo}, {.reports_errors = true}, {}},
                       BitErrors(2e-4, rates, seed));
    constexpr std::uint32_t rounds = 300;
    std::array<std::uint32_t, 3> arrived{};
    std::uint64_t attempts = 0, reported = 0;
    BusErrors seen;
    const auto take = [&](std::int64_t until_ns) {
      for (;;) {
        while (const auto report = wire.report()) {
          EXPECT_EQ(report->node, 1U);
          ++reported;
          add(seen, report->frame);
        }
        if (const auto carried = wire.next(until_ns)) {
          const std::uint32_t number = carried->frame.data[0] + 256U * carried->frame.data[1];
          EXPECT_EQ(number, arrived.at(carried->node)++);  // each frame once, in order
          attempts += static_cast<std::uint64_t>(carried->attempts);
        } else if (!wire.has_report()) {
          return;
        }
      }
    };
    for (std::uint32_t i = 0; i < rounds; ++i) {
      take(i * 2'000'000L);
      for (std::uint32_t n = 0; n < 3; ++n) {
        Frame f = frame(i);
        f.id = 0x100 + n;
        ASSERT_TRUE(wire.queue(n, f, i * 2'000'000L));
      }
    }
    take(1'000'000'000'000);
    EXPECT_THAT(arrived, testing::Each(rounds));
    EXPECT_GT(wire.counters().error_frames, 0U) << seed;
    EXPECT_EQ(attempts, wire.counters().frames + wire.counters().error_frames);
    EXPECT_EQ(wire.counters().dropped, 0U);
    EXPECT_EQ(seen.bus_error, wire.counters().error_frames);  // the controller reports each error frame
    EXPECT_GE(reported, seen.bus_error);
  }
}

}  // namespace
}  // namespace canhil
