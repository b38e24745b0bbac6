// The messages of a DBC as streams: how often, how late, how long.
#pragma once

#include <cstdint>
#include <vector>

#include "bench/schedulability/analysis.hpp"
#include "dbc/parser/database.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::schedulability {

/// What a DBC need not say.
struct Assumptions {
  std::int64_t event_interval_ns = 0;  ///< of event messages without a GenMsgDelayTime; 0: Release::once
  std::int64_t jitter_ns = 0;          ///< of messages without a GenMsgJitter
};

/// The messages of a DBC by priority, with the longest frame that each can have. Times come from attributes
/// of the message, in ms: its period from GenMsgCycleTime, of event messages from GenMsgDelayTime; the
/// deadline from GenMsgDeadline, else it is the period; the jitter from GenMsgJitter. FD messages switch the
/// bit rate unless their attribute CANFD_BRS is 0; then the data bit rate must be known. Error: one line that
/// names the message.
Result<std::vector<Stream>> streams_of(const dbc::Database& database, const Assumptions& assumptions,
                                       const wire::BitRates& rates);

/// The bit rates: those given, where 0 the DBC's attributes Baudrate and BaudrateCANFD. Error: no nominal
/// one.
Result<wire::BitRates> bit_rates(const dbc::Database& database, const wire::BitRates& given);

}  // namespace canhil::schedulability
