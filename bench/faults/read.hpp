// Keys shared by several kinds of faults.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/mapping/stimuli.hpp"
#include "bench/scenario/contract.hpp"
#include "bench/scenario/faults.hpp"
#include "bench/scenario/node.hpp"
#include "bench/scenario/section.hpp"
#include "dbc/wire/message_info.hpp"

namespace canhil::faults {

/// Messages that the bench's nodes send, as selected in a scenario.
struct OfMessages {
  std::vector<const MessageInfo*> all{};
  std::string text{};
};
/// The key `messages`, names of messages, or `node`, all messages of that node. Error: no such message, or
/// the bench does not send it.
OfMessages read_messages(scenario::Section& section, const scenario::FaultContext& context);

/// The key `node`: a node on the bus. Null: no such node; the section then has an error.
const scenario::NodeTable* read_node(scenario::Section& section, const scenario::FaultContext& context);

/// A measured value of a node.
struct Measured {
  const MessageInfo* message = nullptr;
  const SignalInfo* signal = nullptr;
  double factor = 1;      ///< from the signal's unit to the value's unit
  bool rate = false;      ///< the value is the signal divided by the interval of its sample
  std::string_view si{};  ///< unit of the value; empty: unit of the signal
};
struct OfValues {
  std::vector<Measured> all{};
  std::string text{};
};
/// The key `quantity`, or the keys `messages` and `signal`.
OfValues read_values(scenario::Section& section, const scenario::FaultContext& context);
/// The quantity that a key names. Null: unknown; the section then has an error.
const mapping::Stimulus* read_quantity(scenario::Section& section, const scenario::FaultContext& context,
                                       const scenario::Key& key);
/// The signal of canhil's DBC that carries a stimulus.
Measured measured(const mapping::Stimulus& stimulus);

/// The size of a fault, in the unit of the values; `meaning` is for the reference. For a quantity the key is
/// `stem` with the suffix of its unit; for a signal it is `stem` alone, in the signal's unit.
double read_size(scenario::Section& section, std::string_view stem, std::string_view meaning,
                 const OfValues& of, scenario::Limits limits = {});

/// The messages of the bus.
std::span<const MessageInfo> messages_of(const scenario::FaultContext& context);

}  // namespace canhil::faults
