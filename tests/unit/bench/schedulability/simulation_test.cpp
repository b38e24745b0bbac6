// Compares the analysis with the simulated wire; the two share no code.
#include <gtest/gtest.h>

#include "tests/unit/bench/schedulability/traffic.hpp"

namespace canhil::schedulability {
namespace {

constexpr std::uint64_t sets = 1'000;

/// Instances of every stream from 0 to end_ns, with random phases and random jitter.
std::vector<Due> random_dues(const MessageSet& set, std::int64_t end_ns, Dice& dice) {
  std::vector<Due> dues;
  for (std::size_t i = 0; i < set.streams.size(); ++i) {
    const Stream& stream = set.streams[i];
    std::int64_t queued_ns = 0;
    for (std::int64_t t = dice(0, stream.period_ns); t < end_ns; t += stream.period_ns + dice(0, 1)) {
      queued_ns = std::max(queued_ns, t + dice(0, stream.jitter_ns));  // a message does not overtake itself
      dues.push_back({.stream = i, .due_ns = t, .queued_ns = queued_ns});
    }
  }
  return dues;
}

std::int64_t longest_period(const MessageSet& set) {
  return std::ranges::max_element(set.streams, {}, &Stream::period_ns)->period_ns;
}

// Safe bounds: with random message sets, phases and jitters, no response exceeds its bound.
TEST(Simulation, NeverExceedsTheAnalysis) {
  for (std::uint64_t seed = 0; seed < sets; ++seed) {
    SCOPED_TRACE(seed);
    Dice dice(seed);
    const MessageSet set = random_set(dice);
    const auto bounds = responses(set.streams, set.bus);
    const auto dues = random_dues(set, 30 * longest_period(set), dice);
    const auto longest =
        longest_responses(set, dues, [&set](const Due& due) { return set.frames[due.stream]; });
    ASSERT_EQ(longest.size(), bounds.size());
    for (std::size_t i = 0; i < bounds.size(); ++i) {
      ASSERT_TRUE(bounds[i].response_ns) << i;  // the load is below 1
      EXPECT_LE(longest[i], *bounds[i].response_ns) << i;
    }
  }
}

// The same comparison with frames of random content; the analysis uses only the size of each frame.
TEST(Simulation, NeverExceedsTheAnalysisWhateverTheContent) {
  for (std::uint64_t seed = 0; seed < sets / 4; ++seed) {
    SCOPED_TRACE(seed);
    Dice dice(seed);
    MessageSet set = random_set(dice);
    for (std::size_t i = 0; i < set.streams.size(); ++i) {
      const Frame& f = set.frames[i];
      set.streams[i].length = f.fd ? wire::worst_case_fd_length(f.size, f.extended, f.brs)
                                   : wire::worst_case_length(f.size, f.extended);
      set.streams[i].period_ns += set.streams[i].period_ns / 4;  // the load stays below 1
    }
    const auto bounds = responses(set.streams, set.bus);
    const auto dues = random_dues(set, 30 * longest_period(set), dice);
    const auto longest = longest_responses(set, dues, [&](const Due& due) {
      Frame frame = set.frames[due.stream];
      for (std::size_t i = 0; i < frame.size; ++i)
        frame.data.at(i) = static_cast<std::uint8_t>(dice(0, 3) == 0 ? dice(0, 255) : 0x87);
      return frame;
    });
    ASSERT_EQ(longest.size(), bounds.size());
    for (std::size_t i = 0; i < bounds.size(); ++i) {
      if (bounds[i].response_ns) {
        EXPECT_LE(longest[i], *bounds[i].response_ns) << i;
      }
    }
  }
}

// Nodes with FIFO queues, at loads for which a bound exists. The bound must also not be far too large.
TEST(Simulation, NeverExceedsTheAnalysisOfQueuesInOrder) {
  int bounded = 0, tight = 0, beyond_priority = 0;
  for (std::uint64_t seed = 0; seed < sets; ++seed) {
    SCOPED_TRACE(seed);
    Dice dice(seed);
    MessageSet set = random_set(dice);
    for (Stream& stream : set.streams) stream.period_ns *= dice(1, 3);
    const auto bounds = fifo_responses(set.streams, set.bus.rates);
    const auto by_priority = responses(set.streams, set.bus);
    auto dues = random_dues(set, 15 * longest_period(set), dice);
    if (seed % 2 == 0) {  // all messages at once, as the bench sends them at the start of a step
      std::erase_if(dues, [&](const Due& due) { return due.due_ns < 2 * longest_period(set); });
      for (std::size_t i = set.streams.size(); i-- > 0;) dues.push_back({.stream = i});
    }
    const auto longest = longest_responses(
        set, dues, [&set](const Due& due) { return set.frames[due.stream]; }, {}, QueueOrder::fifo);
    ASSERT_EQ(longest.size(), bounds.size());
    for (std::size_t i = 0; i < bounds.size(); ++i) {
      if (!bounds[i].response_ns) continue;
      ++bounded;
      EXPECT_LE(longest[i], *bounds[i].response_ns) << i;
      tight += 10 * longest[i] > 8 * *bounds[i].response_ns ? 1 : 0;
      beyond_priority += longest[i] > *by_priority[i].response_ns ? 1 : 0;
    }
  }
  EXPECT_GT(bounded, 2'000);
  EXPECT_GT(tight, 200);
  EXPECT_GT(beyond_priority, 200) << "the analysis for priority queues does not hold here";
}

TEST(FifoAnalysis, HasNoBoundOnAnOverloadedBus) {
  const auto length = wire::worst_case_length(8, false);
  const std::vector<Stream> streams{
      {.name = "a", .id = 1, .sender = "x", .period_ns = 250'000, .length = length},
      {.name = "b", .id = 2, .sender = "y", .period_ns = 250'000, .length = length}};
  for (const Response& response : fifo_responses(streams, {.nominal = 1'000'000}))
    EXPECT_FALSE(response.response_ns);
}

// Computed by hand; each frame takes 135 us. Node x queues messages 1 and 3, node y queues messages 2 and 4.
// In the worst case of message 1 or 3, the other message of node x is ahead in the queue, message 4 is on the
// wire, and message 2 wins against message 3. In the worst case of message 2 or 4, the other message of node
// y is ahead in the queue, no frame blocks, and messages 1 and 3 win against message 4.
TEST(FifoAnalysis, OfFourMessagesInTwoNodes) {
  const auto stream = [](std::uint32_t id, const char* sender) {
    return Stream{
        .id = id, .sender = sender, .period_ns = 10'000'000, .length = wire::worst_case_length(8, false)};
  };
  const std::vector<Stream> streams{stream(1, "x"), stream(2, "y"), stream(3, "x"), stream(4, "y")};
  const auto found = fifo_responses(streams, {.nominal = 1'000'000});
  for (const Response& response : found) EXPECT_EQ(response.response_ns, 4 * 135'000);
  EXPECT_EQ(found[0].blocking_ns, 135'000);
  EXPECT_EQ(found[1].blocking_ns, 0);
}

/// The critical instant of stream m: the longest frame of lower priority has just won the arbitration. At
/// this instant all streams of higher priority and m itself are queued, with their largest jitter. Later
/// instances become due as soon as possible and are queued without jitter.
std::vector<Due> critical_instant(const MessageSet& set, std::size_t m, std::int64_t end_ns) {
  std::vector<Due> dues;
  const std::int64_t bit_ns = wire::duration_ns({.nominal = 1}, set.bus.rates);
  const auto lower = set.streams.begin() + static_cast<std::ptrdiff_t>(m) + 1;
  if (lower != set.streams.end()) {
    const auto longest = std::max_element(lower, set.streams.end(), [&set](const Stream& a, const Stream& b) {
      return wire::duration_ns(a.length, set.bus.rates) < wire::duration_ns(b.length, set.bus.rates);
    });
    dues.push_back({.stream = static_cast<std::size_t>(longest - set.streams.begin()),
                    .due_ns = -bit_ns,
                    .queued_ns = -bit_ns});
  }
  for (std::size_t i = 0; i <= m; ++i) {
    for (std::int64_t due_ns = -set.streams[i].jitter_ns; due_ns < end_ns; due_ns += set.streams[i].period_ns)
      dues.push_back({.stream = i, .due_ns = due_ns, .queued_ns = std::max<std::int64_t>(due_ns, 0)});
  }
  return dues;
}

// Exact bounds: at the critical instant the response equals the bound. The blocking frame must have won the
// arbitration before, so its first bit is over and it blocks for one bit less than the analysis assumes. The
// stream of lowest priority is not blocked, and its response equals the full bound.
TEST(Simulation, ReachesTheAnalysisAtTheCriticalInstant) {
  std::int64_t beyond_the_first = 0;
  for (std::uint64_t seed = 0; seed < sets; ++seed) {
    SCOPED_TRACE(seed);
    Dice dice(seed);
    const MessageSet set = random_set(dice);
    const std::int64_t bit_ns = wire::duration_ns({.nominal = 1}, set.bus.rates);
    const auto bounds = responses(set.streams, set.bus);
    for (std::size_t m = 0; m < bounds.size(); ++m) {
      const bool blocked = m + 1 < bounds.size();
      const Response exact =
          blocked ? response(set.streams, m, bounds[m].blocking_ns - bit_ns, set.bus) : bounds[m];
      const std::int64_t end_ns = exact.instances * set.streams[m].period_ns + *exact.response_ns;
      const auto longest = longest_responses(set, critical_instant(set, m, end_ns),
                                             [&set](const Due& due) { return set.frames[due.stream]; });
      ASSERT_EQ(longest.size(), bounds.size());
      EXPECT_EQ(longest[m], *exact.response_ns) << m;
      EXPECT_LE(longest[m], *bounds[m].response_ns) << m;
      beyond_the_first += exact.worst_instance > 0 ? 1 : 0;
    }
  }
  EXPECT_GT(beyond_the_first, 20);  // some of the sets violate the analysis of 1994
}

// The errors are no closer together than the error model allows. Each error occurs at a random bit of a
// frame, and its error flag has a random length.
TEST(Simulation, NeverExceedsTheAnalysisWithErrors) {
  std::uint64_t errors_seen = 0;
  for (std::uint64_t seed = 0; seed < sets / 2; ++seed) {
    SCOPED_TRACE(seed);
    Dice dice(seed);
    MessageSet set = random_set(dice);
    for (Stream& stream : set.streams) stream.period_ns *= 2;
    set.bus.errors = {.burst = dice(1, 3), .interval_ns = dice(1, 3) * longest_period(set)};
    const auto bounds = responses(set.streams, set.bus);
    const auto dues = random_dues(set, 12 * longest_period(set), dice);
    // A token bucket limits the errors: it starts with `burst` tokens and gains one token per interval. After
    // 12 errors, all nodes are still error active.
    std::int64_t left = 12;
    double bucket = static_cast<double>(set.bus.errors.burst);
    std::int64_t last_ns = 0;
    const auto disturb = [&](const Attempt& attempt) -> std::optional<WireError> {
      if (left == 0 || dice(0, 2) != 0) return std::nullopt;
      const std::int64_t after_ns = dice(0, attempt.end_ns - attempt.start_ns);
      const std::int64_t t_ns = attempt.start_ns + after_ns;
      bucket = std::min(
          static_cast<double>(set.bus.errors.burst),
          bucket + static_cast<double>(t_ns - last_ns) / static_cast<double>(set.bus.errors.interval_ns));
      last_ns = t_ns;
      if (bucket < 1) return std::nullopt;
      bucket -= 1;
      --left;
      return WireError{.after_ns = after_ns, .flag_bits = static_cast<int>(dice(6, 12))};
    };
    const auto longest = longest_responses(
        set, dues, [&set](const Due& due) { return set.frames[due.stream]; }, disturb);
    errors_seen += static_cast<std::uint64_t>(12 - left);
    ASSERT_EQ(longest.size(), bounds.size());
    for (std::size_t i = 0; i < bounds.size(); ++i) {
      if (bounds[i].response_ns) {
        EXPECT_LE(longest[i], *bounds[i].response_ns) << i;
      }
    }
  }
  EXPECT_GT(errors_seen, sets);
}

}  // namespace
}  // namespace canhil::schedulability
