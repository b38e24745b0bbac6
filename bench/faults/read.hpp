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

/// Messages of the nodes that the bench emulates, as selected in a scenario.
struct OfMessages {
  std::vector<const MessageInfo*> all{};
  std::string text{};
};
/// Reads the key `messages` (names of messages) or the key `node` (all messages of that node). The section
/// has an error if a message does not exist or if the bench does not send it.
OfMessages read_messages(scenario::Section& section, const scenario::FaultContext& context);

/// Reads the key `node`, the name of a node on the bus. Null: there is no such node, and the section has an
/// error.
const scenario::NodeTable* read_node(scenario::Section& section, const scenario::FaultContext& context);

/// A measured value of a node.
struct Measured {
  const MessageInfo* message = nullptr;
  const SignalInfo* signal = nullptr;
  double factor = 1;      ///< converts the signal's unit to the value's unit
  bool rate = false;      ///< the value is the signal divided by the interval of its sample
  std::string_view si{};  ///< unit of the value; empty: the unit of the signal
};
struct OfValues {
  std::vector<Measured> all{};
  std::string text{};
};
/// Reads the key `quantity`, or the keys `messages` and `signal`.
OfValues read_values(scenario::Section& section, const scenario::FaultContext& context);
/// Reads a key whose value is the name of a quantity. Null: the quantity is unknown, and the section has an
/// error.
const mapping::Stimulus* read_quantity(scenario::Section& section, const scenario::FaultContext& context,
                                       const scenario::Key& key);
/// The signal of canhil's DBC that carries a stimulus.
Measured measured(const mapping::Stimulus& stimulus);

/// Reads the size of a fault, in the unit of the values. For a quantity, the key is `stem` with the suffix of
/// a unit. For a signal, the key is `stem` alone, and the size is in the unit of the signal. `meaning`: text
/// for `hil-bench reference`.
double read_size(scenario::Section& section, std::string_view stem, std::string_view meaning,
                 const OfValues& of, scenario::Limits limits = {});

/// The messages of the bus.
std::span<const MessageInfo> messages_of(const scenario::FaultContext& context);

}  // namespace canhil::faults
