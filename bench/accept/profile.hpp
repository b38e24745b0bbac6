// Records the target's answers in one flight: for each message, the values of its signals in every answer,
// the number of answers, and the mean of each signal.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/drive/onlooker.hpp"
#include "dbc/wire/message_info.hpp"

namespace canhil::accept {

/// All answers of one message. Values are in the units of their signals.
struct Series {
  std::vector<const SignalInfo*> signals;
  std::vector<double> t_s;     ///< bench time at the last Sync before each answer
  std::vector<double> values;  ///< for each answer, one number per signal
  [[nodiscard]] std::size_t size() const { return t_s.size(); }
  [[nodiscard]] double value(std::size_t answer, std::size_t signal) const {
    return values[answer * signals.size() + signal];
  }
  /// The mean over the flight; 0 if there are no answers.
  [[nodiscard]] double mean(std::size_t signal) const;
  /// The index of a signal; none: the message does not have it.
  [[nodiscard]] std::optional<std::size_t> index_of(std::string_view signal) const;
};

/// Records the answers of a flight. Ignores reports about the host (TargetTiming), StepDone, and
/// signals that identify the program.
class Answers final : public drive::Onlooker {
 public:
  void transmitted(const Frame& frame, std::int64_t t_ns, std::int64_t late_ns) override;
  void received(const Received& received) override;

  /// The answers of each message, sorted by message name.
  [[nodiscard]] const std::map<std::string, Series, std::less<>>& messages() const { return messages_; }
  /// The answers of a message; null if the message is unknown or has no answers in this flight.
  [[nodiscard]] const Series* find(std::string_view message) const;

 private:
  std::map<std::string, Series, std::less<>> messages_;
  double t_s_ = 0;
};

/// The difference a - b of two values of a signal; for angles, along the smaller of the two arcs.
double difference(const SignalInfo& signal, double a, double b);
/// The mean difference of a signal between two flights, over the answers that both have at the same time;
/// none: they have none, or none has the signal.
std::optional<double> mean_difference(const Series& here, const Series& there, std::string_view signal);
/// The bench time [s] of the first answer in which a signal differs between two flights, or that only one of
/// them has; none: the signal is equal in all answers.
std::optional<double> first_difference(const Series& here, const Series& there, std::string_view signal);
/// The absolute difference between two values of a signal; for angles, the smaller of the two arcs.
double distance(const SignalInfo& signal, double a, double b);

}  // namespace canhil::accept
