// What the readers of logs did not read, collected for a program that says it.
#pragma once

#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

namespace canhil {

/// While an object of this class exists, each LogReader hands over its remarks (LogReader::remarks()) when it
/// ends, whoever read the log and however far. So a program has one place that says what was left out. There
/// is at most one object at a time; without one, nothing is collected.
class LogRemarks {
 public:
  LogRemarks();
  ~LogRemarks();
  LogRemarks(const LogRemarks&) = delete;
  LogRemarks& operator=(const LogRemarks&) = delete;

  /// The remarks of all logs, in the order of the first readers. Of several readers of one log, the remarks
  /// of the one that left out most, because the others read only a part of the log.
  [[nodiscard]] std::vector<std::string> lines() const;

  /// Hands over the remarks of a reader of the log `name` that left out `count` lines or records. May be
  /// called by any thread.
  static void hand_over(const std::string& name, std::uint64_t count, std::vector<std::string> lines);

 private:
  struct Log {
    std::string name;
    std::uint64_t count = 0;
    std::vector<std::string> lines;
  };
  mutable std::mutex mutex_;
  std::vector<Log> logs_;
};

}  // namespace canhil
