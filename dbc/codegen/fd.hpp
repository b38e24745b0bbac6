// Converts the contract to CAN FD, where each sample group of several messages is sent in a container. A
// container is a frame of up to 64 bytes.
//
// A container contains the bytes of the group's classic messages, one message after the other. Each of these
// messages has its own E2E fields. A receiver for the classic contract only has to split the container
// (dbc/ports/fd_groups.hpp).
#pragma once

#include <string>
#include <string_view>

#include "dbc/parser/database.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::dbc {

/// Converts a classic contract to CAN FD. Each sample group of several messages becomes one message, the
/// container, with the id of the group's first message. The messages of a container are sorted by id; the
/// signals of the k-th message (k from 0) start at byte 8 k. A group of more than eight messages is divided
/// into containers of at most eight messages. If several messages of a container have signals with the same
/// name, these signals get the suffix "_" and k + 1 (e2e_crc_1, e2e_crc_2 ...). The container has a
/// SIG_GROUP_ for each classic message, with the name of this message and a list of its signals. The
/// attribute E2eDataIds lists the data ids of the messages. Messages without a group keep their id and their
/// signals. All frames use bit rate switch. Returns an error of one line, `dbc_name:line:column: ...`, in
/// these cases: a message of a group does not have 8 protected bytes and an 11-bit id; the data id of such a
/// message makes eight zeros a valid frame; the messages of a group differ in sender or cycle time; the
/// message with the time of validity is not the last of its group; a message is FD or multiplexed.
Result<Database> on_fd(const Database& classic, std::string_view dbc_name);

/// The result of on_fd(), as the text of a DBC file.
Result<std::string> fd_text(const Database& classic, std::string_view dbc_name);

/// A C++ header with the containers as constants, and with the hashes of the two DBC texts (classic and FD).
Result<std::string> fd_header(const Database& classic, std::string_view name_space,
                              std::string_view dbc_name);

}  // namespace canhil::dbc
