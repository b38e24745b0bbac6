#include "bench/checks/other_senders.hpp"

#include <fmt/format.h>

namespace canhil::checks {
namespace {

std::string counts(const std::map<std::string_view, std::uint64_t>& by_message) {
  std::string list;
  for (const auto& [message, count] : by_message)
    list += fmt::format("{}{} {}", list.empty() ? "" : ", ", message, count);
  return list;
}

}  // namespace

std::string other_senders(const Observations& seen) {
  std::string line;
  if (!seen.bus.intruded.empty())
    line = "somebody else sent frames of the bench: " + counts(seen.bus.intruded);
  std::map<std::string_view, std::uint64_t> twice;  // by sample group
  for (std::size_t i = 0; i < seen.timing.messages.size(); ++i) {
    if (const std::uint64_t count = seen.timing.answers[i].repeated; count > 0)
      twice[seen.timing.messages[i].sample_group] = count;
  }
  if (!twice.empty())
    line += fmt::format("{}answers given twice: {}", line.empty() ? "" : "; ", counts(twice));
  return line;
}

}  // namespace canhil::checks
