// Keys shared by several kinds of faults.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/faults/sensors/measured.hpp"
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

/// Reads the key `quantity`, or the keys `messages` and `signal`.
OfValues read_values(scenario::Section& section, const scenario::FaultContext& context);
/// Reads a key whose value is the name of a quantity. Null: the quantity is unknown, and the section has an
/// error.
const sensors::Measurand* read_quantity(scenario::Section& section, const scenario::FaultContext& context,
                                        const scenario::Key& key);
/// The section has an error if the bench sends this quantity in no message, so that no fault of it can
/// strike.
void expect_carried(scenario::Section& section, const scenario::FaultContext& context, std::string_view key,
                    const sensors::Measurand& measurand);
/// A quantity, in SI.
Measured measured(const sensors::Measurand& measurand);
/// A node by its table.
const sensors::Kind& sensor_of(const scenario::NodeTable& table);

/// Reads the size of a fault, in the unit of the values. For a quantity, the key is `stem` with the suffix of
/// a unit. For a signal, the key is `stem` alone, and the size is in the unit of the signal. `meaning`: text
/// for `hil-bench reference`.
double read_size(scenario::Section& section, std::string_view stem, std::string_view meaning,
                 const OfValues& of, scenario::Limits limits = {});

/// The messages of the bus.
std::span<const MessageInfo> messages_of(const scenario::FaultContext& context);

}  // namespace canhil::faults
