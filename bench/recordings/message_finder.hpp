// Finds the message of a DBC to which a frame belongs.
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "dbc/parser/database.hpp"
#include "dbc/wire/frame.hpp"

namespace canhil::recordings {

/// Finds messages by id, and messages of SAE J1939 also by parameter group: the id of such a message in the
/// DBC contains one priority, source and destination, but frames of the group may have others.
class MessageFinder {
 public:
  /// `j1939`: every message with a 29-bit id is a parameter group; otherwise only those that the DBC marks as
  /// such. `database` must outlive this object.
  MessageFinder(const dbc::Database& database, bool j1939);

  enum class Match : std::uint8_t { none, found, ambiguous };
  struct Found {
    Match match = Match::none;
    const dbc::Message* message = nullptr;
    bool by_group = false;  ///< the message is a parameter group
  };
  /// The message of a frame. If the DBC does not have the id of the frame but messages of its parameter
  /// group, the message is the one with the source address of the frame, else the one for any source (address
  /// 254), else the only one; `ambiguous`: none of these exists.
  [[nodiscard]] Found find(const Frame& frame) const;

  /// Whether the DBC has parameter groups.
  [[nodiscard]] bool any_group() const { return !groups_.empty(); }

 private:
  [[nodiscard]] bool is_group(const dbc::Message& message) const {
    return message.extended && (j1939_ || message.j1939);
  }

  bool j1939_;
  std::map<std::pair<std::uint32_t, bool>, const dbc::Message*> by_id_;  ///< key: id, whether it is extended
  std::map<std::uint32_t, std::vector<const dbc::Message*>> groups_;     ///< key: number of the group
};

}  // namespace canhil::recordings
