#include "bench/report/compare.hpp"

#include "bench/checks/probability.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

namespace canhil::report {
namespace {

using Json = nlohmann::ordered_json;

double count_of(const Buckets& sample) {
  double count = 0;
  for (const auto& bucket : sample) count += static_cast<double>(bucket.count);
  return count;
}

// Where the 99 % quantile is, by nearest rank.
std::int64_t p99_bucket(const Buckets& sample) {
  double left = std::ceil(0.99 * count_of(sample));
  for (const auto& bucket : sample) {
    left -= static_cast<double>(bucket.count);
    if (left <= 0) return bucket.from_us;
  }
  return sample.empty() ? 0 : sample.back().from_us;
}

double share_beyond(const Buckets& sample, std::int64_t from_us) {
  double beyond = 0;
  for (const auto& bucket : sample)
    if (bucket.from_us > from_us) beyond += static_cast<double>(bucket.count);
  return beyond / count_of(sample);
}

Buckets buckets_of(const Json& distribution) {
  Buckets buckets;
  for (const Json& bucket : distribution.at("buckets_us"))
    buckets.push_back({bucket.at(0).get<std::int64_t>(), bucket.at(1).get<std::uint64_t>()});
  std::ranges::sort(buckets, {}, &checks::Histogram::Bucket::from_us);
  return buckets;
}

// 0 is the best.
int badness(const std::string& outcome) { return outcome == "pass" ? 0 : outcome == "not measured" ? 1 : 2; }

// Checks by name and kind, as one scenario may have several of a name, in their order.
struct Side {
  std::string name, kind, outcome, measured;
};
std::vector<Side> checks_of(const Json& report) {
  std::vector<Side> checks;
  for (const Json& check : report.at("checks"))
    checks.push_back({check.at("name").get<std::string>(), check.at("kind").get<std::string>(),
                      check.at("outcome").get<std::string>(), check.at("measured").get<std::string>()});
  return checks;
}

class Comparer {
 public:
  Comparer(const Json& a, const Json& b, const Bars& bars) : a_(a), b_(b), bars_(bars) {}

  Compared operator()() {
    if (auto why = not_comparable()) {
      result_.outcome = Comparison::not_comparable;
      result_.text = "not comparable: " + *why + "\n";
      return result_;
    }
    differences();
    checks();
    const bool measured = latencies();
    const bool worse = result_.outcome == Comparison::worse;
    if (!worse && !measured) result_.outcome = Comparison::not_comparable;
    say("{}", worse      ? "worse"
              : measured ? "no worse"
                         : "not comparable: no regression of a check, and latency was not measured");
    return result_;
  }

 private:
  template <class... Args>
  void say(fmt::format_string<Args...> line, Args&&... args) {
    result_.text += fmt::format(line, std::forward<Args>(args)...) + "\n";
  }

  [[nodiscard]] std::optional<std::string> not_comparable() const {
    for (const auto& [key, what] : {std::pair("scenario_hash", "scenario"), std::pair("contract", "contract"),
                                    std::pair("clock", "clock")}) {
      const Json &of_a = a_.at("provenance").at(key), &of_b = b_.at("provenance").at(key);
      if (of_a != of_b) return fmt::format("the {} differs: {} and {}", what, of_a.dump(), of_b.dump());
    }
    return std::nullopt;
  }

  // What may be why, and does not keep two runs from being compared.
  void differences() {
    std::string text;
    for (const auto& [key, what] :
         {std::pair("seed", "seed"), std::pair("run", "run"), std::pair("dbc_hash", "DBC"),
          std::pair("revision", "revision"), std::pair("cpu_model", "CPU"), std::pair("kernel", "kernel")}) {
      const Json of_a = a_.at("provenance").value(key, Json()), of_b = b_.at("provenance").value(key, Json());
      if (of_a == of_b) continue;
      const auto plain = [](const Json& value) {
        return value.is_string() ? value.get<std::string>() : value.dump();
      };
      text += fmt::format("{}{} {} -> {}", text.empty() ? "" : ", ", what, plain(of_a), plain(of_b));
    }
    if (!text.empty()) say("differs  {}", text);
  }

  void checks() {
    const std::vector<Side> before = checks_of(a_), after = checks_of(b_);
    for (std::size_t i = 0; i < after.size(); ++i) {
      // The implied check of the bus may be in one of them only; it is there when it fails.
      const bool paired =
          i < before.size() && before[i].name == after[i].name && before[i].kind == after[i].kind;
      const std::string was = paired ? before[i].outcome : "pass";
      if (was == after[i].outcome) continue;
      const bool worse = badness(after[i].outcome) > badness(was) && after[i].outcome == "fail";
      if (worse) result_.outcome = Comparison::worse;
      say("{:<8} check '{}': {} -> {} ({})", worse ? "worse" : "changed", after[i].name, was,
          after[i].outcome, after[i].measured);
    }
    if (a_.at("verdict") != "fail" && b_.at("verdict") == "fail" && result_.outcome != Comparison::worse) {
      result_.outcome = Comparison::worse;
      say("worse    the run: {}", b_.at("reason").get<std::string>());
    }
  }

  // False: one of the runs has nothing to compare.
  bool latencies() {
    if (a_.at("provenance").at("clock") == "lockstep") {
      say("latency  none in virtual time");
      return true;
    }
    for (const auto& [report, name] : {std::pair(&a_, "first"), std::pair(&b_, "second")}) {
      const Json& timing = report->at("timing");
      if (timing.at("judged").get<bool>()) continue;
      say("latency  not compared: in the {} run {}", name, timing.at("why_not").get<std::string>());
      return false;
    }
    if (!a_.contains("latency_s")) {
      say("latency  not compared: the first run has no answers");
      return false;
    }
    const Json& before = a_.at("latency_s");
    const Json none = Json::object();
    const Json& after = b_.contains("latency_s") ? b_.at("latency_s") : none;
    std::size_t tests = 0;
    // The other messages of a group come just before the one that closes it.
    const auto compared = [](const Json& latency) {
      return latency.at("closes_group").get<bool>() && latency.at("count").get<std::uint64_t>() > 0;
    };
    for (const auto& [message, latency] : before.items()) tests += compared(latency) ? 2 : 0;
    for (const auto& [message, latency] : before.items()) {
      if (!compared(latency)) continue;
      if (after.contains(message) && compared(after.at(message))) {
        latency_of(message, latency, after.at(message), bars_.p / static_cast<double>(tests));
      } else {
        result_.outcome = Comparison::worse;
        say("worse    latency of {}: no answers any more", message);
      }
    }
    return true;
  }

  void latency_of(const std::string& message, const Json& before, const Json& after, double p_bar) {
    const Buckets a = buckets_of(before), b = buckets_of(after);
    const RankTest ranks = rank_test(a, b);
    const TailTest tail = tail_test(a, b);
    const auto us = [](const Json& distribution, const char* key) {
      return distribution.at(key).get<double>() * 1e6;
    };
    const auto later = [&](const char* key) { return us(after, key) - us(before, key) > bars_.least_us; };
    const bool slower = ranks.p < p_bar && ranks.effect >= bars_.effect && later("p50");
    const bool heavier =
        tail.p < p_bar && tail.share_b >= bars_.tail_times * std::max(tail.share_a, 0.01) && later("p99");
    if (slower || heavier) result_.outcome = Comparison::worse;
    say("{:<8} latency of {}: p50 {:.0f} -> {:.0f} us, p99 {:.0f} -> {:.0f} us; P(later) {:.3f} (p {:.2g}); "
        "beyond "
        "the first p99 {:.2f} % -> {:.2f} % (p {:.2g})",
        slower || heavier ? "worse" : "same", message, us(before, "p50"), us(after, "p50"), us(before, "p99"),
        us(after, "p99"), ranks.effect, ranks.p, tail.share_a * 100, tail.share_b * 100, tail.p);
  }

  const Json& a_;
  const Json& b_;
  const Bars bars_;
  Compared result_;
};

}  // namespace

// U counts the pairs with b > a, and half of those that are equal. With N = m + n and t_k values in bucket k:
// var U = m n / 12 (N + 1 - sum (t_k^3 - t_k) / (N (N - 1))).
RankTest rank_test(const Buckets& a, const Buckets& b) {
  const double m = count_of(a), n = count_of(b);
  if (m == 0 || n == 0) return {};
  double u = 0, passed_a = 0, ties = 0;
  auto in_a = a.begin();
  auto in_b = b.begin();
  while (in_a != a.end() || in_b != b.end()) {
    const bool from_a = in_a != a.end() && (in_b == b.end() || in_a->from_us <= in_b->from_us);
    const bool from_b = in_b != b.end() && (in_a == a.end() || in_b->from_us <= in_a->from_us);
    const double of_a = from_a ? static_cast<double>(in_a++->count) : 0;
    const double of_b = from_b ? static_cast<double>(in_b++->count) : 0;
    u += of_b * (passed_a + of_a / 2);
    passed_a += of_a;
    const double t = of_a + of_b;
    ties += t * t * t - t;
  }
  const double total = m + n;
  const double variance = m * n / 12 * (total + 1 - ties / (total * (total - 1)));
  if (!(variance > 0)) return {.effect = u / (m * n), .p = 1};
  return {.effect = u / (m * n), .p = checks::normal_above((u - m * n / 2 - 0.5) / std::sqrt(variance))};
}

TailTest tail_test(const Buckets& a, const Buckets& b) {
  const double m = count_of(a), n = count_of(b);
  if (m == 0 || n == 0) return {};
  const std::int64_t bar_us = p99_bucket(a);
  TailTest test{.share_a = share_beyond(a, bar_us), .share_b = share_beyond(b, bar_us)};
  const double pooled = (test.share_a * m + test.share_b * n) / (m + n);
  const double variance = pooled * (1 - pooled) * (1 / m + 1 / n);
  if (variance > 0) test.p = checks::normal_above((test.share_b - test.share_a) / std::sqrt(variance));
  return test;
}

Result<Compared> compare(const Json& a, const Json& b, const Bars& bars) {
  try {
    return Comparer(a, b, bars)();
  } catch (const Json::exception& error) {
    return failure(fmt::format("a report is not whole: {}", error.what()));
  }
}

}  // namespace canhil::report
