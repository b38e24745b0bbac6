// The messages of a DBC as streams: periods, jitters, lengths.
#pragma once

#include <cstdint>
#include <vector>

#include "bench/schedulability/analysis.hpp"
#include "dbc/parser/database.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::schedulability {

/// Values that are used where a DBC states none.
struct Assumptions {
  std::int64_t event_interval_ns = 0;  ///< for event messages without a GenMsgDelayTime; 0: Release::once
  std::int64_t jitter_ns = 0;          ///< for messages without a GenMsgJitter
};

/// The messages of a DBC by priority, with the longest frame of each. Times come from message attributes, in
/// ms: the period from GenMsgCycleTime, for event messages from GenMsgDelayTime; the deadline from
/// GenMsgDeadline, by default the period; the jitter from GenMsgJitter. An FD message switches the bit
/// rate unless its attribute CANFD_BRS is 0. If a message switches, the data bit rate must be known. Error:
/// one line that names the message.
Result<std::vector<Stream>> streams_of(const dbc::Database& database, const Assumptions& assumptions,
                                       const wire::BitRates& rates);

/// The bit rates: the given ones; where 0, the DBC's attributes Baudrate and BaudrateCANFD. Error: there
/// is no nominal bit rate, or the data bit rate is below it.
Result<wire::BitRates> bit_rates(const dbc::Database& database, const wire::BitRates& given);

}  // namespace canhil::schedulability
