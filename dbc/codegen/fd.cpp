#include "dbc/codegen/fd.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <set>

#include "dbc/codegen/names.hpp"
#include "dbc/codegen/write.hpp"
#include "dbc/parser/parse.hpp"
#include "dbc/wire/e2e.hpp"
#include "dbc/wire/fd_container.hpp"

namespace canhil::dbc {
namespace {

using wire::FdContainer;

constexpr std::array fd_sizes{8U, 12U, 16U, 20U, 24U, 32U, 48U, 64U};
constexpr std::int64_t data_bitrate = 2'000'000;

/// The classic messages that one frame of the FD contract carries, in the order of transmission. The frame of
/// a message without a sample group carries only this message.
struct Part {
  std::string name;
  std::vector<const Message*> messages;
};

std::vector<const Message*> by_id(const Database& database) {
  std::vector<const Message*> sorted;
  for (const Message& message : database.messages) sorted.push_back(&message);
  std::ranges::sort(sorted, {}, [](const Message* m) { return std::pair(m->id, m->extended); });
  return sorted;
}

std::vector<Part> parts_of(const Database& database) {
  std::vector<Part> parts;
  std::set<std::string> divided;
  const std::vector<const Message*> sorted = by_id(database);
  for (const Message* message : sorted) {
    if (!message->sample_group.empty() && !divided.insert(message->sample_group).second) continue;
    std::vector<const Message*> group{message};
    if (!message->sample_group.empty()) {
      group.clear();
      std::ranges::copy_if(sorted, std::back_inserter(group), [&](const Message* other) {
        return other->sample_group == message->sample_group;
      });
    }
    if (group.size() == 1) {
      parts.push_back({message->name, group});
      continue;
    }
    const bool whole = group.size() <= FdContainer::max_slots;
    for (std::size_t begin = 0, k = 1; begin < group.size(); begin += FdContainer::max_slots, ++k) {
      const std::size_t end = std::min(begin + FdContainer::max_slots, group.size());
      parts.push_back({whole ? message->sample_group : fmt::format("{}{}", message->sample_group, k),
                       {group.begin() + static_cast<std::ptrdiff_t>(begin),
                        group.begin() + static_cast<std::ptrdiff_t>(end)}});
    }
  }
  return parts;
}

bool has_time_of_validity(const Message& message) {
  return find_signal(message, "time_of_validity_us") != nullptr ||
         find_signal(message, "cause_time_us") != nullptr;
}

bool is_plain_message(const Message& message) {
  return !message.fd && std::ranges::none_of(message.signals, &Signal::multiplexor);
}

/// A slot of zeros means that the message of this slot is absent. Therefore eight zeros must not be a valid
/// message.
bool zeros_are_no_message(const Message& message) {
  const std::array<std::uint8_t, FdContainer::slot_bytes> zeros{};
  return e2e::crc(zeros, message.e2e_data_id) != 0;
}

/// If the container of the group cannot carry the message, returns the properties that the message should
/// have, as text for the error line. nullopt: the container can carry the message. `last` is the last message
/// of the group.
std::optional<std::string> objection(const Message& message, const Message& last) {
  if (message.size != FdContainer::slot_bytes || message.extended || message.e2e_data_id == 0)
    return "of 8 bytes with an 11-bit id and an E2eDataId";
  if (!zeros_are_no_message(message)) return "with another E2eDataId: its CRC of zeros is 0";
  if (message.sender != last.sender || message.cycle_time_us != last.cycle_time_us)
    return fmt::format("with sender and cycle time of {}", last.name);
  if (has_time_of_validity(message) && &message != &last)
    return fmt::format("with the highest id of its group, as it carries the time of validity; {} has it",
                       last.name);
  return std::nullopt;
}

std::optional<Error> find_objection(const Database& database, std::string_view dbc_name) {
  const auto at = [&](const Message& m, const std::string& what) {
    return Error{fmt::format("{}:{}:{}: message {}: on CAN FD expected {}", dbc_name, m.at.line, m.at.column,
                             m.name, what)};
  };
  for (const Message* message : by_id(database)) {
    if (!is_plain_message(*message)) return at(*message, "a classic message that is not multiplexed");
    if (message->sample_group.empty()) continue;
    const Message* last = message;
    std::size_t members = 0;
    for (const Message& other : database.messages) {
      if (other.sample_group != message->sample_group) continue;
      ++members;
      if (other.id > last->id) last = &other;
    }
    if (members == 1) continue;
    if (auto what = objection(*message, *last)) return at(*message, *what);
  }
  return std::nullopt;
}

bool named_twice(const Part& part, const std::string& name) {
  return 1 < std::ranges::count_if(part.messages,
                                   [&](const Message* m) { return find_signal(*m, name) != nullptr; });
}

Message container_of(const Part& part) {
  const Message& first = *part.messages.front();
  Message container = first;
  container.name = part.name;
  container.signals.clear();
  container.size = *std::ranges::lower_bound(
      fd_sizes, static_cast<unsigned>(part.messages.size() * FdContainer::slot_bytes));
  container.comment = "At byte";
  std::vector<unsigned> data_ids;
  for (std::size_t k = 0; k < part.messages.size(); ++k) {
    const Message& message = *part.messages[k];
    SignalGroup group{.name = message.name, .signals = {}};
    for (Signal signal : message.signals) {
      if (named_twice(part, signal.name)) signal.name += fmt::format("_{}", k + 1);
      signal.start_bit += static_cast<unsigned>(8 * FdContainer::slot_bytes * k);
      group.signals.push_back(signal.name);
      container.signals.push_back(std::move(signal));
    }
    container.groups.push_back(std::move(group));
    data_ids.push_back(message.e2e_data_id);
    container.comment +=
        fmt::format("{} {} {}", k == 0 ? "" : ";", FdContainer::slot_bytes * k, message.name);
    if (!message.comment.empty()) container.comment += fmt::format(" ({})", message.comment);
  }
  container.comment += ". Zeros in place of a message: it is not there.";
  container.e2e_data_id = 0;
  container.attributes.erase("E2eDataId");
  container.attributes["E2eDataIds"] = fmt::format("{}", fmt::join(data_ids, " "));
  return container;
}

void define_attributes(Database& database) {
  database.definitions.push_back({.name = "BaudrateCANFD",
                                  .owner = Owner::network,
                                  .type = AttributeType::integer,
                                  .maximum = 8'000'000,
                                  .labels = {},
                                  .initial = data_bitrate});
  database.definitions.push_back({.name = "CANFD_BRS",
                                  .owner = Owner::message,
                                  .type = AttributeType::enumeration,
                                  .labels = {"0", "1"},
                                  .initial = "1"});
  database.definitions.push_back({.name = "E2eDataIds",
                                  .owner = Owner::message,
                                  .type = AttributeType::text,
                                  .labels = {},
                                  .initial = ""});
  database.attributes["BusType"] = "CAN FD";
  database.attributes["BaudrateCANFD"] = data_bitrate;
}

}  // namespace

Result<Database> on_fd(const Database& classic, std::string_view dbc_name) {
  if (const auto error = find_objection(classic, dbc_name)) return tl::unexpected(*error);
  Database fd = classic;
  fd.messages.clear();
  fd.comment = fmt::format(
      "Made from {} by dbcgen --fd: change that, not this. One CAN FD frame with a bit rate switch for each "
      "sample group: its messages one behind the other, each at a multiple of 8 bytes, as that file has "
      "them. "
      "It says of them: {}",
      dbc_name, classic.comment);
  define_attributes(fd);
  for (const Part& part : parts_of(classic)) {
    fd.messages.push_back(part.messages.size() == 1 ? *part.messages.front() : container_of(part));
    Message& message = fd.messages.back();
    message.fd = true;
    message.attributes["VFrameFormat"] = message.extended ? "ExtendedCAN_FD" : "StandardCAN_FD";
    message.attributes["CANFD_BRS"] = "1";
  }
  fd.hash = hash(dbc_text(fd));
  return fd;
}

Result<std::string> fd_text(const Database& classic, std::string_view dbc_name) {
  return on_fd(classic, dbc_name).and_then([&](const Database& fd) -> Result<std::string> {
    std::string text = dbc_text(fd);
    // Parses the written text: an error means that the text lacks a part of the database or states it
    // wrongly.
    if (auto read = parse(text, fmt::format("{} on CAN FD", dbc_name)); !read)
      return tl::unexpected(read.error());
    return text;
  });
}

Result<std::string> fd_header(const Database& classic, std::string_view name_space,
                              std::string_view dbc_name) {
  const auto text = fd_text(classic, dbc_name);
  if (!text) return tl::unexpected(text.error());
  std::string rows;
  std::size_t count = 0;
  for (const Part& part : parts_of(classic)) {
    if (part.messages.size() == 1) continue;
    const Message container = container_of(part);
    std::vector<std::uint32_t> ids;
    for (const Message* message : part.messages) ids.push_back(message->id);
    rows += fmt::format("    {{.name = \"{}\", .id = {}, .size = {}, .count = {}, .slots = {{{}}}}},\n",
                        container.name, container.id, container.size, ids.size(), fmt::join(ids, ", "));
    ++count;
  }
  return fmt::format(
      "// Generated by dbcgen --fd from {0}: edit {0} instead.\n#pragma once\n\n"
      "#include \"dbc/wire/fd_container.hpp\"\n\nnamespace {1} {{\n\n"
      "/// FNV-1a of the text of {0} and of its CAN FD version.\n"
      "inline constexpr std::uint64_t classic_hash = 0x{2:016X}U;\n"
      "inline constexpr std::uint64_t fd_hash = 0x{3:016X}U;\n\n"
      "inline constexpr std::array<wire::FdContainer, {4}> containers{{{{\n{5}}}}};\n"
      "inline constexpr std::array<wire::FdPlace, 2048> places = wire::fd_places(containers);\n\n"
      "}}  // namespace {1}\n",
      dbc_name, name_space, classic.hash, hash(*text), count, rows);
}

}  // namespace canhil::dbc
