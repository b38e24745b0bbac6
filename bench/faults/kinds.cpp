// All kinds of faults, ordered by stage.
#include "bench/faults/kinds.hpp"

#include <array>

#include "bench/faults/kinds/controller.hpp"
#include "bench/faults/kinds/frames.hpp"
#include "bench/faults/kinds/order.hpp"
#include "bench/faults/kinds/others.hpp"
#include "bench/faults/kinds/protection.hpp"
#include "bench/faults/kinds/target.hpp"
#include "bench/faults/sensors/nodes.hpp"
#include "bench/faults/sensors/samples.hpp"
#include "bench/faults/sensors/values.hpp"

namespace canhil::faults {
namespace {

constexpr std::array all{
    listed<Changed>,       listed<Bias>,        listed<Drift>,         listed<Spike>,
    listed<Stuck>,         listed<Saturated>,   listed<Noise>,         listed<Reversed>,
    listed<Swapped>,       listed<Invalid>,     listed<Late>,          listed<Silent>,
    listed<Slow>,          listed<ClockStep>,   listed<ClockDrift>,    listed<NodeRestart>,
    listed<Lost>,          listed<Repetition>,  listed<Delayed>,       listed<Reordered>,
    listed<Damaged>,       listed<WrongCrc>,    listed<CounterStuck>,  listed<CounterJump>,
    listed<TooShort>,      listed<TooLong>,     listed<ForeignFormat>, listed<Stranger>,
    listed<Flood>,         listed<ErrorFrames>, listed<ErrorPassive>,  listed<BusOff>,
    listed<InterfaceDown>, listed<Paused>,      listed<Slowed>,        listed<Restarted>};

}  // namespace

std::span<const Listed> listed_kinds() { return all; }

std::vector<scenario::FaultKind> kinds() {
  std::vector<scenario::FaultKind> kinds;
  for (const Listed& one : all) kinds.push_back(one.kind);
  return kinds;
}

}  // namespace canhil::faults
