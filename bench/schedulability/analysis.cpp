#include "bench/schedulability/analysis.hpp"

#include <algorithm>

namespace canhil::schedulability {
namespace {

constexpr std::int64_t given_up_ns =
    3'600'000'000'000;  // one hour: a longer busy period gives no useful bound

// An error frame costs at most 31 bits: 6 for the error flag, 6 for the superposed error flag, 8 for the
// error delimiter, 3 for the intermission, and 8 if an error-passive node suspends transmission (Tindell,
// Burns, Wellings 1995).
constexpr std::int64_t error_frame_bits = 31;

constexpr std::int64_t divide_up(std::int64_t a, std::int64_t b) { return (a + b - 1) / b; }

/// The number of instances of a stream that can be queued in an interval. The interval includes its first
/// moment, but not its last moment. The number is ceil(interval / T) for a stream with period T, and 1 for a
/// stream that has no period.
std::int64_t queued_within(const Stream& stream, std::int64_t interval_ns) {
  if (interval_ns <= 0) return 0;
  return stream.period_ns > 0 ? divide_up(interval_ns, stream.period_ns) : 1;
}

/// The analysed message and the messages of higher priority. Times are in ns.
struct Level {
  std::span<const Stream> higher;
  const Stream& own;
  std::vector<std::int64_t> higher_c{};
  std::int64_t own_c = 0;
  std::int64_t blocking = 0;
  std::int64_t bit = 0;
  std::int64_t per_error = 0;
  ErrorModel errors{};

  /// The interference by hp(m), the set of all messages k that have a higher priority than message m:
  ///   sum over k in hp(m) of ceil((t + J_k + extra) / T_k) C_k
  [[nodiscard]] std::int64_t interference(std::int64_t t, std::int64_t extra) const {
    std::int64_t sum = 0;
    for (std::size_t k = 0; k < higher.size(); ++k)
      sum += queued_within(higher[k], t + higher[k].jitter_ns + extra) * higher_c[k];
    return sum;
  }
  /// The time that errors cost; hep(m) is the set of message m and all messages of higher priority:
  ///   E_m(t) = (burst + ceil(t / T_error) - 1) (31 bits + max over k in hep(m) of C_k)
  [[nodiscard]] std::int64_t error_overhead(std::int64_t t) const {
    if (errors.burst == 0) return 0;
    return (errors.burst + divide_up(t, errors.interval_ns) - 1) * per_error;
  }
  /// The utilisation of the bus by the messages of this level and by errors. The busy period ends only if
  /// this utilisation is below 1.
  [[nodiscard]] double demand() const {
    const auto share = [](std::int64_t c, std::int64_t t) {
      return t > 0 ? static_cast<double>(c) / static_cast<double>(t) : 0;
    };
    double sum = share(own_c, own.period_ns);
    for (std::size_t k = 0; k < higher.size(); ++k) sum += share(higher_c[k], higher[k].period_ns);
    return errors.burst > 0 ? sum + share(per_error, errors.interval_ns) : sum;
  }
};

/// The smallest solution of t = f(t), found by iteration from a smaller t; nullopt: the solution is larger
/// than one hour.
template <class F>
std::optional<std::int64_t> fixed_point(std::int64_t t, F&& f) {
  for (;;) {
    const std::int64_t next = f(t);
    if (next <= t) return t;
    if (next > given_up_ns) return std::nullopt;
    t = next;
  }
}

/// Equations 9 to 13 of Davis et al. 2007, with the error overhead of section 3.4 of that paper.
Response analyse(const Level& level) {
  const std::int64_t c = level.own_c;
  Response result{.transmission_ns = c, .blocking_ns = level.blocking};
  if (level.demand() >= 1) return result;
  // The length t_m of the busy period is the smallest solution t of
  //   t = E_m(t) + B_m + sum over k in hep(m) of ceil((t + J_k) / T_k) C_k
  const auto busy = fixed_point(c, [&](std::int64_t t) {
    return level.error_overhead(t) + level.blocking + level.interference(t, 0) +
           queued_within(level.own, t + level.own.jitter_ns) * c;
  });
  if (!busy) return result;
  // The busy period contains Q_m instances of the message, with Q_m = ceil((t_m + J_m) / T_m). Each of these
  // instances may have the longest response.
  result.instances = queued_within(level.own, *busy + level.own.jitter_ns);
  std::int64_t worst = 0;
  std::int64_t w = level.blocking;
  for (std::int64_t q = 0; q < result.instances; ++q) {
    // The time w_m(q) for which instance q waits in the queue is the smallest solution w of
    //   w = E_m(w + C_m) + B_m + q C_m + sum over k in hp(m) of ceil((w + J_k + tau_bit) / T_k) C_k
    const auto queueing = fixed_point(w, [&](std::int64_t t) {
      return level.error_overhead(t + c) + level.blocking + q * c + level.interference(t, level.bit);
    });
    if (!queueing) return result;
    // The response time: R_m(q) = J_m + w_m(q) - q T_m + C_m
    const std::int64_t r = level.own.jitter_ns + *queueing - q * level.own.period_ns + c;
    if (r > worst) {
      worst = r;
      result.worst_instance = q;
    }
    w = *queueing + c;  // w_m(q + 1) is at least this large, so the next iteration starts here
  }
  result.response_ns = worst;
  return result;
}

}  // namespace

Response response(std::span<const Stream> streams, std::size_t index, std::int64_t blocking_ns,
                  const Bus& bus) {
  const auto c_of = [&bus](const Stream& stream) { return wire::duration_ns(stream.length, bus.rates); };
  Level level{.higher = streams.first(index), .own = streams[index]};
  level.own_c = c_of(level.own);
  level.blocking = blocking_ns;
  level.bit = wire::duration_ns({.nominal = 1}, bus.rates);
  level.errors = bus.errors;
  std::int64_t longest = level.own_c;
  for (const Stream& stream : level.higher)
    longest = std::max(longest, level.higher_c.emplace_back(c_of(stream)));
  level.per_error = error_frame_bits * level.bit + longest;
  return analyse(level);
}

namespace {

/// The index of the first stream with which the bus is certainly overloaded. This stream and all later
/// streams are not analysed, because the analysis of tens of thousands of streams would take too long.
std::size_t first_overloaded(std::span<const Stream> streams, const wire::BitRates& rates) {
  constexpr double for_sure = 1 + 1e-9;  // the same sum in a different order differs in the last bits
  double demand = 0;
  for (std::size_t i = 0; i < streams.size(); ++i) {
    if (streams[i].period_ns > 0) {
      demand += static_cast<double>(wire::duration_ns(streams[i].length, rates)) /
                static_cast<double>(streams[i].period_ns);
    }
    if (demand >= for_sure) return i;
  }
  return streams.size();
}

}  // namespace

std::vector<Response> responses(std::span<const Stream> streams, const Bus& bus) {
  std::vector<Response> results(streams.size());
  const std::size_t overloaded = first_overloaded(streams, bus.rates);
  std::int64_t blocking = 0;
  for (std::size_t i = streams.size(); i-- > 0;) {
    results[i] = i < overloaded ? response(streams, i, blocking, bus)
                                : Response{.transmission_ns = wire::duration_ns(streams[i].length, bus.rates),
                                           .blocking_ns = blocking};
    blocking = std::max(blocking, results[i].transmission_ns);
  }
  return results;
}

namespace {

/// The streams of a bus on which every node sends its frames in the order of queueing (FIFO), and the bounds
/// of their response times that have been found so far.
class FifoBus {
 public:
  FifoBus(std::span<const Stream> streams, const wire::BitRates& rates)
      : streams_(streams), bit_(wire::duration_ns({.nominal = 1}, rates)) {
    for (const Stream& stream : streams) c_.push_back(wire::duration_ns(stream.length, rates));
    r_ = c_;
  }

  /// Finds the smallest r that solves all equations; false: no r within the limit solves them.
  bool solve() {
    for (bool changed = true; changed;) {
      changed = false;
      for (std::size_t m = 0; m < streams_.size(); ++m) {
        const auto next = from_queued(m);
        if (!next) return false;
        changed = changed || *next > r_[m];
        r_[m] = std::max(r_[m], *next);
      }
    }
    return true;
  }
  [[nodiscard]] std::vector<Response> responses(bool solved) const {
    std::vector<Response> results;
    for (std::size_t m = 0; m < streams_.size(); ++m) {
      results.push_back({.transmission_ns = c_[m], .blocking_ns = blocking(lowest_of(m)), .instances = 1});
      if (solved) results.back().response_ns = streams_[m].jitter_ns + r_[m];
    }
    return results;
  }

 private:
  [[nodiscard]] bool together(std::size_t a, std::size_t b) const {
    return streams_[a].sender == streams_[b].sender;
  }
  [[nodiscard]] std::size_t lowest_of(std::size_t m) const {
    std::size_t lowest = m;
    for (std::size_t k = m; k < streams_.size(); ++k) lowest = together(k, m) ? k : lowest;
    return lowest;
  }
  [[nodiscard]] std::int64_t blocking(std::size_t lowest) const {
    std::int64_t longest = 0;
    for (std::size_t k = lowest + 1; k < streams_.size(); ++k) longest = std::max(longest, c_[k]);
    return longest;
  }
  [[nodiscard]] std::optional<std::int64_t> from_queued(std::size_t m) const {
    const std::size_t lowest = lowest_of(m);
    std::int64_t ahead = blocking(lowest) - c_[m];
    for (std::size_t k = 0; k <= lowest; ++k) {
      if (together(k, m)) ahead += queued_within(streams_[k], r_[k] + streams_[k].jitter_ns) * c_[k];
    }
    const auto waited = fixed_point(ahead, [&](std::int64_t w) {
      std::int64_t sum = ahead;
      for (std::size_t k = 0; k < lowest; ++k) {
        if (!together(k, m))
          sum += queued_within(streams_[k], w + r_[k] + streams_[k].jitter_ns + bit_) * c_[k];
      }
      return sum;
    });
    return waited ? std::optional(*waited + c_[m]) : std::nullopt;
  }

  std::span<const Stream> streams_;
  std::int64_t bit_;
  std::vector<std::int64_t> c_{}, r_{};
};

}  // namespace

std::vector<Response> fifo_responses(std::span<const Stream> streams, const wire::BitRates& rates) {
  FifoBus bus(streams, rates);
  const bool solved = utilisation(streams, rates) < 1 && bus.solve();
  return bus.responses(solved);
}

double utilisation(std::span<const Stream> streams, const wire::BitRates& rates) {
  double sum = 0;
  for (const Stream& stream : streams) {
    if (stream.period_ns > 0)
      sum += wire::bus_load(stream.length, static_cast<double>(stream.period_ns) * 1e-9, rates);
  }
  return sum;
}

bool meets_deadline(const Stream& stream, const Response& response) {
  return response.response_ns && (!stream.deadline_ns || *response.response_ns <= *stream.deadline_ns);
}

}  // namespace canhil::schedulability
