// Which answers were due in a window of a run, and which of them came. All checks that judge answers use this
// rule, so that missing answers never make a check pass.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "bench/checks/finding.hpp"
#include "bench/checks/observations.hpp"

namespace canhil::checks {

struct Answered {
  std::uint64_t due = 0;
  std::uint64_t came = 0;  ///< at most `due`
  [[nodiscard]] std::uint64_t missing() const { return due - came; }
  /// At least half of the answers came. If not, the target was silent: a late host does not explain that.
  [[nodiscard]] bool half() const;
};

/// The answers of a message, or of the group that it belongs to, to the stimuli of a window. One answer is
/// due for each stimulus that reached the bus undamaged. If the group keeps an interval of its own, one
/// answer is due in each interval. No answer is due while a fault of the scenario acts. 0 due: nothing was
/// recorded.
Answered answered(const Observations& seen, std::string_view message, const scenario::Window& window);

/// Why a check that passes cannot pass, because answers of `message` in `window` are missing; none: they are
/// not missing, or only because frames of the target were lost on the way to the bench. The outcome is fail,
/// or 'not measured' if frames were lost on the way to the target or the bus was away.
std::optional<Finding> missing_answers(const Observations& seen, std::string_view message,
                                       const scenario::Window& window);

/// The finding for a check that fails because answers are missing. The outcome is 'not measured' if the
/// target need not be the cause.
Finding too_few(const Observations& seen, std::string_view message, const Answered& found,
                Expected expected = {});

/// Whether a message is the last one of an answer group, or has no group. `index`: its index in `messages`.
bool closes_answer(std::span<const MessageInfo> messages, std::size_t index);

}  // namespace canhil::checks
