// The contract on CAN FD: one container, a frame of up to 64 bytes, for each sample group.
//
// A container holds the bytes of the group's classic messages one after the other, each with its own E2E
// fields. A receiver for the classic contract only has to split the container (dbc/ports/fd_groups.hpp).
#pragma once

#include <string>
#include <string_view>

#include "dbc/parser/database.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::dbc {

/// Converts a classic contract to CAN FD. Each sample group of several messages becomes one message with the
/// id of its first. Transmission order is the order of ids; the signals of the k-th message (k from 0) start
/// at byte 8 k. Groups of more than eight messages are divided, eight to a container. Signals with the same
/// name in several messages of a container get the suffix "_" and k + 1 (e2e_crc_1, e2e_crc_2 ...). A
/// SIG_GROUP_ with the name of the classic message lists its signals; the attribute E2eDataIds lists the data
/// ids of the messages. Messages without a group keep id and signals. All frames switch the bit rate.
/// Error: one line `dbc_name:line:column: ...` if a message of a group does not have 8 protected bytes and an
/// 11-bit id, has a data id for which eight zeros are a valid frame, or differs from its group in sender or
/// cycle time; if the message with the time of validity is not the last of its group; or if a message is FD
/// or multiplexed.
Result<Database> on_fd(const Database& classic, std::string_view dbc_name);

/// on_fd() as the text of a DBC file.
Result<std::string> fd_text(const Database& classic, std::string_view dbc_name);

/// A C++ header with the containers as constants, and the hashes of both texts.
Result<std::string> fd_header(const Database& classic, std::string_view name_space,
                              std::string_view dbc_name);

}  // namespace canhil::dbc
