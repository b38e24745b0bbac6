// What a target answered in one flight, signal by signal, short enough to be kept: how often each message
// came, the mean of each signal, and its values at some instants.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "bench/drive/onlooker.hpp"
#include "dbc/wire/message_info.hpp"

namespace canhil::accept {

/// Every answer of one message. Values are in the unit of their signal.
struct Series {
  std::vector<const SignalInfo*> signals;
  std::vector<double> t_s;     ///< bench time of the last Sync before each
  std::vector<double> values;  ///< answer by answer, a number a signal
  [[nodiscard]] std::size_t size() const { return t_s.size(); }
  [[nodiscard]] double value(std::size_t answer, std::size_t signal) const {
    return values[answer * signals.size() + signal];
  }
  /// Over the flight; 0 without answers.
  [[nodiscard]] double mean(std::size_t signal) const;
};

/// Hears a flight. Frames that speak of the host do not count, nor signals that say which program answers.
class Answers final : public drive::Onlooker {
 public:
  void transmitted(const Frame& frame, std::int64_t t_ns, std::int64_t late_ns) override;
  void received(const Received& received) override;

  /// As before the first frame.
  void clear() {
    messages_.clear();
    t_s_ = 0;
  }
  /// By message, in the order of their names.
  [[nodiscard]] const std::map<std::string, Series, std::less<>>& messages() const { return messages_; }
  /// Of "Message.signal"; none: null, or the flight had no answer of this message.
  [[nodiscard]] const Series* find(std::string_view message) const;

 private:
  std::map<std::string, Series, std::less<>> messages_;
  double t_s_ = 0;
};

/// By how much two values of a signal differ: of an angle of a full turn the shorter way round.
double distance(const SignalInfo& signal, double a, double b);

}  // namespace canhil::accept
