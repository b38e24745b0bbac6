// The contract on CAN FD: the classic one in containers, one frame of up to 64 bytes for each sample group.
//
// A container holds the bytes of the group's classic messages one behind the other, each with its own E2E
// fields, so that whoever knows the classic contract needs nothing but to take the container apart
// (dbc/ports/fd_groups.hpp).
#pragma once

#include <string>
#include <string_view>

#include "dbc/parser/database.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::dbc {

/// The FD contract of a classic one. Each sample group of several messages becomes one message with the id of
/// its first: in the order of transmission, which is that of the ids, the signals of the k-th message stand
/// at byte 8 k; groups of more than eight messages are divided, eight to a container. Signals whose name
/// another message of the container has too get "_" and k + 1 behind it (e2e_crc_1, e2e_crc_2 ...); a
/// SIG_GROUP_ named as the classic message lists its signals, and the attribute E2eDataIds the data ids of
/// its messages. Messages of no group keep id and signals. All are FD frames that switch the bit rate.
/// Error: one line `dbc_name:line:column: ...` for a message of a group that is not of 8 protected bytes with
/// an 11-bit id, or not like the others of its group, a time of validity that is not sent last, a message
/// that is FD or multiplexed.
Result<Database> on_fd(const Database& classic, std::string_view dbc_name);

/// on_fd() as the text of a DBC file.
Result<std::string> fd_text(const Database& classic, std::string_view dbc_name);

/// A header with the containers as constants, and the hashes of both texts.
Result<std::string> fd_header(const Database& classic, std::string_view name_space,
                              std::string_view dbc_name);

}  // namespace canhil::dbc
