// What the bus brought while the bench waited for its target: for the message of a handshake that failed.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "bench/checks/sighting.hpp"
#include "bench/observe/observer.hpp"
#include "messages/canhil.hpp"

namespace canhil::observe {

/// Counts a frame under the id of a message by what is wrong with it; true: nothing is.
bool look_at(const Frame& frame, const MessageInfo& message, checks::Sighting& sighting);

class Sightings final : public Observer {
 public:
  void received(const Received& received) override;
  /// Forgets everything.
  void clear() { seen_ = {}; }

  /// The frames under the id of a message, by its place in all_messages.
  [[nodiscard]] const checks::Sighting& of(std::size_t message) const { return seen_.of_target[message]; }
  /// What was wrong with frames of the target: "TargetHeartbeat: 50 with a wrong CRC"; empty: nothing.
  [[nodiscard]] std::string faults() const;
  /// The same, what else the target sent, and other ids; "no frame" where none came.
  [[nodiscard]] std::string to_text() const;

 private:
  struct Other {
    std::uint32_t id = 0;
    bool extended = false;
    bool operator==(const Other&) const = default;
  };
  static constexpr std::size_t most_others = 8;
  struct Seen {
    std::array<checks::Sighting, messages::all_messages.size()> of_target{};  // by place in all_messages
    std::vector<Other> others{};
    bool more_others = false;
    std::uint64_t errors = 0;  // error frames
  };

  Seen seen_;
};

}  // namespace canhil::observe
