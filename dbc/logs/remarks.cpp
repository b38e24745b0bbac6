#include "dbc/logs/remarks.hpp"

#include <algorithm>
#include <atomic>

namespace canhil {
namespace {

std::atomic<LogRemarks*> collector = nullptr;

}  // namespace

LogRemarks::LogRemarks() { collector = this; }
LogRemarks::~LogRemarks() { collector = nullptr; }

std::vector<std::string> LogRemarks::lines() const {
  const std::scoped_lock lock(mutex_);
  std::vector<std::string> all;
  for (const Log& log : logs_) all.insert(all.end(), log.lines.begin(), log.lines.end());
  return all;
}

void LogRemarks::hand_over(const std::string& name, std::uint64_t count, std::vector<std::string> lines) {
  LogRemarks* const to = collector;
  if (to == nullptr || lines.empty()) return;
  const std::scoped_lock lock(to->mutex_);
  auto log = std::ranges::find(to->logs_, name, &Log::name);
  if (log == to->logs_.end()) log = to->logs_.insert(to->logs_.end(), {name, 0, {}});
  if (log->lines.empty() || count > log->count) *log = {name, count, std::move(lines)};
}

}  // namespace canhil
