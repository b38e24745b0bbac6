// Every frame of a run in candump's log format.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "bench/observe/observer.hpp"
#include "dbc/logs/log.hpp"

namespace canhil::observe {

/// Records from the first transmission of the bench on, so that the log alone is a whole session of the
/// target; where the bench never transmitted, what came. Each frame stands beside the bus that it passed on.
class Recorder final : public Observer {
 public:
  /// Writes beside `path` until close() gives the file its name. `port` outlives the recorder. Error: the
  /// file cannot be created.
  static Result<std::unique_ptr<Recorder>> open(const std::string& path, const Port& port);

  /// A recording that was not closed leaves nothing behind.
  ~Recorder() override;
  void transmitted(const Frame& frame, std::int64_t t_ns, std::int64_t late_ns) override;
  void received(const Received& received) override;
  void foreign(const Received& received) override;
  /// Finishes the file. Error: not everything could be written; then nothing stands under `path`, and what
  /// was written under `path`.incomplete.
  Result<void> close();
  /// Finishes the log of a run that did not begin: under `path`, or where something stands there under
  /// `path`.incomplete. Gives its name; empty: no frame passed, and there is no log. Error: as of close().
  Result<std::string> close_early();

 private:
  static constexpr std::size_t most_early = 10'000;

  Recorder(LogWriter writer, std::string path, const Port& port);
  void write(const Frame& frame, std::int64_t t_ns, std::uint8_t bus, bool transmitted);
  void keep_early(const Received& received);
  void write_early();
  bool give_name(const std::string& name);

  LogWriter writer_;
  std::string path_;
  const Port& port_;
  std::int64_t to_realtime_ns_;  // from the port's stamp clock
  std::vector<Received> early_;  // the first that came before the first transmission
  bool started_ = false;
  bool closed_ = false;
};

}  // namespace canhil::observe
