// Converts the messages of a DBC to streams with their periods, jitters and lengths.
#pragma once

#include <cstdint>
#include <vector>

#include "bench/schedulability/analysis.hpp"
#include "dbc/parser/database.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::schedulability {

/// Default values. The analysis uses them for messages to which the DBC gives no value.
struct Assumptions {
  std::int64_t event_interval_ns = 0;  ///< event messages without GenMsgDelayTime; 0: Release::once
  std::int64_t jitter_ns = 0;          ///< messages without GenMsgJitter
};

/// The messages of a DBC, sorted by priority, each with the length of its longest frame. The times come from
/// attributes of the message, in ms. The period comes from GenMsgCycleTime or, for event messages, from
/// GenMsgDelayTime; the deadline from GenMsgDeadline (default: the period); the jitter from GenMsgJitter. The
/// frames of an FD message use bit rate switch, except if the attribute CANFD_BRS is 0. If a message uses bit
/// rate switch, `rates` must contain the data bit rate. An error is one line that names the message.
Result<std::vector<Stream>> streams_of(const dbc::Database& database, const Assumptions& assumptions,
                                       const wire::BitRates& rates);

/// The bit rates for the analysis. A bit rate that is 0 in `given` is taken from the DBC's attribute Baudrate
/// (nominal) or BaudrateCANFD (data). Returns an error if there is no nominal bit rate, or if the data bit
/// rate is below the nominal one.
Result<wire::BitRates> bit_rates(const dbc::Database& database, const wire::BitRates& given);

}  // namespace canhil::schedulability
