// The kinds of nodes that the bench can emulate.
#pragma once

#include <span>
#include <vector>

#include "bench/nodes/kind.hpp"
#include "bench/nodes/recorded.hpp"
#include "bench/nodes/sample_signals.hpp"
#include "bench/sensors/measurands.hpp"

namespace canhil::nodes {

/// The kinds that canhil.dbc carries, in the order in which tables are read and reported.
std::span<const Kind* const> all();

/// The kind that binds this sensor. A named sensor (sensors::named) is bound like its kind.
const Kind& bound(const sensors::Kind& sensor);
/// The kind that has this table.
const Kind& kind_of(const NodeTable& table);
/// The table of a sensor with a name of its own. `kind`: the table of its kind. Null: the binding declares no
/// sensor of this name, and the kind needs it.
const NodeTable* named(const NodeTable& kind, std::string_view name, const scenario::Binding& binding);

/// The tables of all kinds, for scenario::DbcVocabulary.
std::vector<const scenario::NodeTable*> tables();

/// The signal of canhil.dbc that carries a measurand, or signals_in_si().
const SampleSignal& carrier(const sensors::Measurand& measurand);
/// What a signal of a sensor's message carries; null: the message has no such signal.
const SampleSignal* carried(const Kind& kind, const MessageInfo& message, std::string_view signal);

/// The sensor of one node, emulated or recorded, with its faults.
std::unique_ptr<sensors::Sensor> make_sensor(const NodeSettings& node, const Run& run);

/// One node alone: its sensor, and the messages of canhil.dbc that carry the samples.
std::unique_ptr<Node> make(const NodeSettings& node, const Run& run);

/// The nodes of a run in order of precedence.
std::vector<std::unique_ptr<Node>> make(const Run& run);

}  // namespace canhil::nodes
