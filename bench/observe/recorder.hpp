// Every frame of a run in candump's log format.
#pragma once

#include <memory>
#include <string>

#include "bench/observe/observer.hpp"
#include "dbc/ports/candump_log.hpp"

namespace canhil::observe {

/// Records from the first transmission of the bench on, so that the log alone is a whole session of the
/// target.
class Recorder final : public Observer {
 public:
  /// Writes beside `path` until close() gives the file its name. Error: the file cannot be created.
  static Result<std::unique_ptr<Recorder>> open(const std::string& path, const Port& port);

  /// A recording that was not closed leaves nothing behind.
  ~Recorder() override;
  void transmitted(const Frame& frame, std::int64_t t_ns, std::int64_t late_ns) override;
  void received(const Received& received) override;
  /// Finishes the file. Error: not everything could be written; then nothing stands under `path`, and what
  /// was written under `path`.incomplete.
  Result<void> close();

 private:
  Recorder(LogWriter writer, std::string path, const Port& port);
  void write(const Frame& frame, std::int64_t t_ns, bool transmitted);

  LogWriter writer_;
  std::string path_;
  std::string interface_;
  std::int64_t to_realtime_ns_;  // from the port's stamp clock
  bool started_ = false;
  bool closed_ = false;
};

}  // namespace canhil::observe
