// The keys of the error stack (bench/world/error_stack.hpp) of a sensor with three axes.
#pragma once

#include <cstdint>
#include <string_view>

#include "bench/scenario/section.hpp"
#include "bench/world/error_stack.hpp"

namespace canhil::sensors {

/// The names of a sensor's keys: each ends in its unit. A sensor without one of these errors leaves its name
/// empty.
struct StackKeys {
  std::string_view of{};  ///< what has the errors, for the reference: "the gyros"
  std::string_view bandwidth{}, order{};
  /// The correlated error by its 1-sigma, or as a datasheet's bias instability; and its correlation time.
  std::string_view correlated{}, instability{}, correlation{};
  std::string_view walk{};   ///< random walk of the value
  std::string_view range{};  ///< the value saturates at plus and minus this
  std::string_view step{}, pulse{};
};

/// Reads the order of a lag: the key `order`, beside the key `bandwidth`.
std::int64_t read_order(scenario::Section& section, std::string_view order, std::string_view bandwidth);

/// Reads the errors of three axes.
world::TriadErrors::Stacks read_error_stacks(scenario::Section& section, const StackKeys& keys);

}  // namespace canhil::sensors
