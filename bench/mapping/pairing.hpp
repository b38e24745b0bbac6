// Assigns the answers of a message to their causes.
//
// The target answers a stimulus at most once, and in the order of the stimuli. An answer arrives after its
// cause; if it has an echo, its cause carried the echoed value. Numbered in the order of their transmission,
// the stimuli that can be the cause of answer j therefore lie between
//   lowest(j)  = min { k > lowest(j - 1)  : k fits answer j }   and
//   highest(j) = max { k < highest(j + 1) : k fits answer j, sent before answer j arrived }.
// If the two are equal, the cause is certain. A counter that comes round cannot show whether the target is
// late by one round, unless all samples before were answered.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <vector>

#include "dbc/ports/port.hpp"

namespace canhil::mapping {

/// An answer and its cause.
struct Paired {
  Received answer{};                  ///< its last frame
  std::vector<std::uint8_t> bytes{};  ///< the bytes of the message
  std::optional<std::int64_t>
      cause_us{};  ///< time of validity of the (latest possible) cause; none: no cause
  bool certain = true;
  bool owed = true;           ///< false: a fault of the bench is why the target need not answer the cause
  std::int64_t apart_us = 0;  ///< if not certain: from the previous possible cause to the latest
};

/// The stimuli and the answers of one message of the target.
class Pairing {
 public:
  /// Receives the answers in the order of their arrival, each as soon as its cause is known.
  using Give = std::function<void(const Paired&)>;

  /// The target must answer a stimulus that was sent at `t_ns` and carried the value `echoed`.
  void sent(std::uint64_t echoed, std::int64_t valid_us, std::int64_t t_ns, const Give& give);
  /// An answer arrived that repeats the value `echoed`. `otherwise`: its cause if no open stimulus fits it.
  void answered(const Received& answer, std::uint64_t echoed, const Paired& otherwise, const Give& give);
  /// The target was started anew or the run is over: the open stimuli get no answer any more.
  void end(const Give& give);

 private:
  /// An answer waits for later answers while no more stimuli than these are sent. The stopwatch must remember
  /// its cause for so long.
  static constexpr std::uint64_t patience = 256;
  /// So many stimuli may be without an answer: more than the rounds of a counter of 16 bits.
  static constexpr std::size_t most_open = 70'000;

  struct Stimulus {
    std::uint64_t echoed = 0;
    std::int64_t valid_us = 0, t_ns = 0;
  };
  struct Waiting {
    Paired paired;  // as it is given if no stimulus is open for it
    std::uint64_t echoed = 0;
    bool open = false;                      // some stimulus fits
    std::uint64_t lowest = 0, highest = 0;  // numbers of stimuli
  };

  [[nodiscard]] const Stimulus& stimulus(std::uint64_t number) const { return open_[number - first_]; }
  [[nodiscard]] std::optional<std::uint64_t> first_from(std::uint64_t number, std::uint64_t echoed) const;
  [[nodiscard]] std::optional<std::uint64_t> last_before(std::uint64_t number, std::uint64_t echoed,
                                                         std::int64_t t_ns) const;
  void give_first(const Give& give);
  void give_certain(const Give& give);
  void forget();

  std::deque<Stimulus> open_;  // the stimuli with the numbers from first_ on
  std::uint64_t first_ = 0;
  std::uint64_t next_lowest_ = 0;  // lowest number that the next answer can have
  std::deque<Waiting> waiting_;
};

}  // namespace canhil::mapping
