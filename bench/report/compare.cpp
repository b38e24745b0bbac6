#include "bench/report/compare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <utility>

#include "bench/checks/evidence.hpp"
#include "bench/report/differences.hpp"
#include "bench/report/latency_tests.hpp"
#include "bench/report/side_checks.hpp"
#include "dbc/text/escape.hpp"

namespace canhil::report {
namespace {

using Json = nlohmann::ordered_json;

// All of these conditions must hold for a latency to count as worse.
constexpr double largest_p = 0.01;  // of a single test; divided by the number of tests
constexpr double least_us = 2;      // increase of p50 or p99, larger than the resolution of two stamps
// If each side has only one run, the scatter between runs is unknown. Then these further conditions must
// hold:
constexpr double least_effect = 0.64;  // a 'medium' effect of Vargha and Delaney (2000)
constexpr double tail_times = 2;       // factor for the fraction beyond the 99 % quantile
constexpr double least_share = 1;      // increase of p50 or p99, divided by the value on the first side

Buckets buckets_of(const Json& distribution) {
  Buckets buckets;
  for (const Json& bucket : distribution.at("buckets_us"))
    buckets.push_back({bucket.at(0).get<std::int64_t>(), bucket.at(1).get<std::uint64_t>()});
  std::ranges::sort(buckets, {}, &checks::Histogram::Bucket::from_us);
  return buckets;
}

struct Named {
  const char* path;
  const char* name;
};

// These values must be equal for a comparison.
constexpr std::array<Named, 3> same{{{"/provenance/scenario_hash", "scenario"},
                                     {"/provenance/contract", "contract"},
                                     {"/provenance/clock", "clock"}}};
class Comparer {
 public:
  Comparer(const Reports& before, const Reports& after, double tolerance)
      : before_(before), after_(after), tolerance_(tolerance) {}

  Compared operator()() {
    if (auto why = not_comparable()) {
      result_.outcome = Comparison::not_comparable;
      say("not comparable: {}", *why);
      return result_;
    }
    result_.text += differences(before_, after_);
    const bool lockstep = before_[0].at("provenance").at("clock") == "lockstep";
    const ChecksCompared checks = compare_checks(
        before_, after_,
        {.lockstep = lockstep, .repeatable = repeatable(), .tolerance = tolerance_, .largest_p = largest_p});
    result_.text += checks.text;
    if (checks.worse) result_.outcome = Comparison::worse;
    missing_answers();
    const bool measured = latencies(lockstep) && !checks.unknown;
    const bool worse = result_.outcome == Comparison::worse;
    if (!worse && !measured) result_.outcome = Comparison::not_comparable;
    say("{}", worse      ? "worse"
              : measured ? "no worse"
                         : "not comparable: nothing is known to be worse, and not everything was measured");
    return result_;
  }

 private:
  template <class... Args>
  void say(fmt::format_string<Args...> line, Args&&... args) {
    result_.text += one_line(fmt::format(line, std::forward<Args>(args)...)) + "\n";
  }

  [[nodiscard]] std::optional<std::string> not_comparable() const {
    for (const Named& key : same) {
      const Json first = before_[0].at(Json::json_pointer(key.path));
      for (const Reports* side : {&before_, &after_}) {
        for (const Json& report : *side) {
          const Json& other = report.at(Json::json_pointer(key.path));
          if (other != first)
            return fmt::format("the {} differs: {} and {}", key.name, first.dump(), other.dump());
        }
      }
    }
    return std::nullopt;
  }

  // Whether equal runs give equal numbers: in virtual time, with the same seed and run of a campaign.
  [[nodiscard]] bool repeatable() const {
    const Json& first = before_[0].at("provenance");
    if (first.at("clock") == "real time") return false;
    for (const Reports* side : {&before_, &after_}) {
      for (const Json& report : *side) {
        for (const char* key : {"seed", "run"}) {
          const Json& own = report.at("provenance");
          if (own.value(key, Json()) != first.value(key, Json())) return false;
        }
      }
    }
    return true;
  }

  // How many answers of a message were due in the runs of a side, and how many did not come although the bus
  // lost no frame of the target. Reports of earlier versions have no such counts.
  struct Missing {
    double due = 0, missing = 0;
  };
  static Missing missing_in(const Reports& side, const std::string& message) {
    Missing all;
    for (const Json& report : side) {
      if (!report.contains("answers") || !report.at("answers").contains(message)) continue;
      const Json& counts = report.at("answers").at(message);
      const auto due = counts.at("due").get<double>();
      all.due += due;
      all.missing += std::max(0.0, due - counts.at("came").get<double>() -
                                       report.at("from_target").at("frames_lost").get<double>());
    }
    return all;
  }

  void missing_answers() {
    if (!before_[0].contains("answers")) return;
    for (const auto& [message, counts] : before_[0].at("answers").items()) {
      const Missing was = missing_in(before_, message), is = missing_in(after_, message);
      const ShareTest test = share_test(was.missing, was.due, is.missing, is.due);
      if (!(test.share_b > test.share_a) || test.p >= largest_p) continue;
      result_.outcome = Comparison::worse;
      say("worse    answers of {}: {:.0f} of {:.0f} missing -> {:.0f} of {:.0f} (p {:.2g})", message,
          was.missing, was.due, is.missing, is.due, test.p);
    }
  }

  // False: one of the runs has no latencies to compare, or the host explains why they are longer.
  bool latencies(bool lockstep) {
    if (lockstep) {
      say("latency  none in virtual time");
      return true;
    }
    for (const Reports* side : {&before_, &after_}) {
      const char* ordinal = side == &before_ ? "first" : "second";
      for (std::size_t i = 0; i < side->size(); ++i) {
        const Json& timing = side->at(i).at("timing");
        if (timing.at("judged").get<bool>()) continue;
        say("latency  not compared: in {} {}",
            side->size() == 1 ? fmt::format("the {} run", ordinal)
                              : fmt::format("run {} of the {} side", i + 1, ordinal),
            timing.at("why_not").get<std::string>());
        return false;
      }
    }
    const std::vector<std::string> messages = answered_before();
    if (messages.empty()) {
      say("latency  not compared: the first {} no answers", before_.size() == 1 ? "run has" : "side has");
      return false;
    }
    if (one_a_side())
      say("latency  one run a side: counts as worse only if p50 or p99 grew by more than {:.0f} %, because "
          "runs differ",
          least_share * 100);
    const double p_bar = largest_p / static_cast<double>(2 * messages.size());
    bool known = true;
    for (const std::string& message : messages) {
      if (!std::ranges::all_of(after_, [&](const Json& report) { return answers(report, message); })) {
        result_.outcome = Comparison::worse;
        say("worse    latency of {}: no answers any more", message);
      } else if (one_a_side()) {
        if (!latency_of_two_runs(message, p_bar)) known = false;
      } else {
        latency_of(message, p_bar);
      }
    }
    return known;
  }

  [[nodiscard]] bool one_a_side() const { return before_.size() == 1 && after_.size() == 1; }

  static bool answers(const Json& report, const std::string& message) {
    return report.contains("latency_s") && report.at("latency_s").contains(message) &&
           report.at("latency_s").at(message).at("count") > 0;
  }

  // The last message of each answer group, if all runs of the first side contain answers with this message.
  // The other messages of the group arrive just before it.
  [[nodiscard]] std::vector<std::string> answered_before() const {
    std::vector<std::string> messages;
    if (!before_[0].contains("latency_s")) return messages;
    for (const auto& [message, latency] : before_[0].at("latency_s").items()) {
      if (!latency.at("closes_group").template get<bool>()) continue;
      const std::string& name = message;
      if (std::ranges::all_of(before_, [&](const Json& report) { return answers(report, name); }))
        messages.push_back(name);
    }
    return messages;
  }

  void conclude(std::string_view what, const std::string& message, const std::string& figures) {
    if (what == "worse") result_.outcome = Comparison::worse;
    say("{:<8} latency of {}: {}", what, message, figures);
  }

  // How late the bench itself was in the run after, as the host kept it from running [us].
  [[nodiscard]] double lateness_us(const char* key) const {
    const Json& report = after_[0];
    return report.contains("bench_lateness_s") ? report.at("bench_lateness_s").at(key).get<double>() * 1e6
                                               : 0;
  }

  // Compares the latencies of a message if each side has one run. False: they are longer, but in the run
  // after the bench itself was so late that the host can have made them longer.
  bool latency_of_two_runs(const std::string& message, double p_bar) {
    const Json& before = before_[0].at("latency_s").at(message);
    const Json& after = after_[0].at("latency_s").at(message);
    const Buckets a = buckets_of(before), b = buckets_of(after);
    const RankTest ranks = rank_test(a, b);
    const ShareTest tail = tail_test(a, b);
    const auto us = [](const Json& distribution, const char* key) {
      return distribution.at(key).get<double>() * 1e6;
    };
    const auto later = [&](const char* key) {
      const double was_us = us(before, key);
      return us(after, key) - was_us > std::max(least_us, least_share * was_us);
    };
    const auto is_of_host = [&](const char* key) {
      return lateness_us(key) > checks::lateness_share * (us(after, key) - us(before, key));
    };
    const bool slower = ranks.p < p_bar && ranks.effect >= least_effect && later("p50");
    const bool heavier =
        tail.p < p_bar && tail.share_b >= tail_times * std::max(tail.share_a, 0.01) && later("p99");
    const bool worse = (slower && !is_of_host("p50")) || (heavier && !is_of_host("p99"));
    const bool unknown = !worse && (slower || heavier);
    std::string figures = fmt::format(
        "p50 {:.0f} -> {:.0f} us, p99 {:.0f} -> {:.0f} us; P(later) {:.3f} (p {:.2g}); beyond "
        "the first p99 {:.2f} % -> {:.2f} % (p {:.2g})",
        us(before, "p50"), us(after, "p50"), us(before, "p99"), us(after, "p99"), ranks.effect, ranks.p,
        tail.share_a * 100, tail.share_b * 100, tail.p);
    if (unknown)
      figures += fmt::format("; the host kept the bench itself late by {:.0f} us (p50), {:.0f} us (p99)",
                             lateness_us("p50"), lateness_us("p99"));
    conclude(worse ? "worse" : unknown ? "unknown" : "same", message, figures);
    return !unknown;
  }

  // Compares the latencies of a message if the sides have several runs. The samples are the quantiles of the
  // runs.
  void latency_of(const std::string& message, double p_bar) {
    bool worse = false;
    std::string figures;
    for (const char* key : {"p50", "p99"}) {
      const auto of_runs = [&](const Reports& side) {
        std::vector<double> values_us;
        for (const Json& report : side)
          values_us.push_back(report.at("latency_s").at(message).at(key).get<double>() * 1e6);
        std::ranges::sort(values_us);
        return values_us;
      };
      const std::vector<double> a_us = of_runs(before_), b_us = of_runs(after_);
      constexpr double resolution_us = 1;  // of a quantile
      const RunTest test = run_test(a_us, b_us, resolution_us);
      worse = worse || (test.p < p_bar && test.increase > least_us);
      figures +=
          fmt::format("{}{} {:.0f}..{:.0f} -> {:.0f}..{:.0f} us (p {:.2g})", figures.empty() ? "" : ", ", key,
                      a_us.front(), a_us.back(), b_us.front(), b_us.back(), test.p);
    }
    conclude(worse ? "worse" : "same", message, figures);
  }

  const Reports& before_;
  const Reports& after_;
  double tolerance_;
  Compared result_;
};

}  // namespace

Result<Compared> compare(const Reports& before, const Reports& after, double tolerance) {
  try {
    return Comparer(before, after, tolerance)();
  } catch (const Json::exception& error) {
    return failure(fmt::format("a report is not whole: {}", error.what()));
  } catch (const UnknownOutcome& outcome) {
    return failure(outcome.what);
  }
}

}  // namespace canhil::report
