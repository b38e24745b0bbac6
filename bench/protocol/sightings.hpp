// Counts the frames received while the bench waits for its target. The error message of a failed handshake
// reports these counts.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "bench/checks/sighting.hpp"
#include "bench/observe/observer.hpp"
#include "messages/canhil.hpp"

namespace canhil::protocol {

/// Looks for a defect in a frame that has the id of `message`, and counts the frame by its defect. Returns
/// true if the frame has no defect.
bool look_at(const Frame& frame, const MessageInfo& message, checks::Sighting& sighting);

class Sightings final : public observe::Observer {
 public:
  void received(const Received& received) override;
  /// Resets all counts.
  void clear() { seen_ = {}; }

  /// The counts of the frames that had the id of one message. `message` is the index of this message in
  /// all_messages.
  [[nodiscard]] const checks::Sighting& of(std::size_t message) const { return seen_.of_target[message]; }
  /// Defects of the target's frames: "TargetHeartbeat: 50 with a wrong CRC"; empty: none.
  [[nodiscard]] std::string faults() const;
  /// The defects as in faults(), plus the counts of valid frames and the other ids; "no frame" if no frame
  /// came.
  [[nodiscard]] std::string to_text() const;

 private:
  struct Other {
    std::uint32_t id = 0;
    bool extended = false;
    bool operator==(const Other&) const = default;
  };
  static constexpr std::size_t most_others = 8;
  struct Seen {
    std::array<checks::Sighting, messages::all_messages.size()> of_target{};  // by index in all_messages
    std::vector<Other> others{};
    bool more_others = false;
    std::uint64_t errors = 0;  // error frames
  };

  Seen seen_;
};

}  // namespace canhil::protocol
