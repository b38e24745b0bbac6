// Keys that several kinds of faults have.
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

/// Messages that the nodes of the bench send, and how a scenario names them.
struct OfMessages {
  std::vector<const MessageInfo*> all{};
  std::string text{};
};
/// The key `messages`, by name, or `node`, all of that node's. Error: none, or one that the bench does not
/// send.
OfMessages read_messages(scenario::Section& section, const scenario::FaultContext& context);

/// The key `node`: one that is on the bus. Null: none of its name; that has been said.
const scenario::NodeTable* read_node(scenario::Section& section, const scenario::FaultContext& context);

/// A number that a node measures.
struct Measured {
  const MessageInfo* message = nullptr;
  const SignalInfo* signal = nullptr;
  double factor = 1;      ///< from the signal's unit to that of the number
  bool rate = false;      ///< the number is the signal by the time of a sample
  std::string_view si{};  ///< the number's unit; empty: the signal's own
};
struct OfValues {
  std::vector<Measured> all{};
  std::string text{};
};
/// The key `quantity`, or `signal` of `messages`.
OfValues read_values(scenario::Section& section, const scenario::FaultContext& context);
/// Another quantity by this key. Null: none; that has been said.
const mapping::Stimulus* read_quantity(scenario::Section& section, const scenario::FaultContext& context,
                                       std::string_view key);
/// What it is of in the contract.
Measured measured(const mapping::Stimulus& stimulus);

/// A number in the unit of the values: of a quantity the key is `stem` with an ending that fits its unit, of
/// a signal `stem` alone, in the signal's unit.
double read_size(scenario::Section& section, std::string_view stem, const OfValues& of,
                 scenario::Limits limits = {});

/// Of the bus.
std::span<const MessageInfo> messages_of(const scenario::FaultContext& context);

}  // namespace canhil::faults
