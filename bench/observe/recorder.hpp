// Records every frame of a run in candump's log format.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/observe/observer.hpp"
#include "dbc/files/output_file.hpp"
#include "dbc/logs/log.hpp"

namespace canhil::observe {

/// The name of a log of which only a part could be written, or whose run did not begin.
inline std::string incomplete_log(const std::string& path) { return path + ".incomplete"; }

/// Records from the bench's first transmission on, so the log contains a complete session of the target; if
/// the bench never transmitted, the log contains the frames that arrived. Each frame is stored with its bus.
class Recorder final : public Observer {
 public:
  /// Writes to a temporary file beside `path` until close() renames it; a recording that was not closed is
  /// removed. `port` must outlive the recorder.
  /// Error: the file cannot be created.
  static Result<std::unique_ptr<Recorder>> open(const std::string& path, const Port& port);

  void transmitted(const Frame& frame, std::int64_t t_ns, std::int64_t late_ns) override;
  void received(const Received& received) override;
  void foreign(const Received& received) override;
  /// From now on, all stamps are times of the virtual clock; the virtual time continues the stamps before.
  void time_set(std::int64_t t_ns) override;
  /// Finishes the file. If not everything could be written, returns an error; then there is no file `path`,
  /// and `path`.incomplete contains the part that was written.
  Result<void> close();
  /// Finishes the log of a run that did not begin: as `path` or, if this file already exists, as
  /// `path`.incomplete. Returns the name of the log; empty: no frame passed, so there is no log. The errors
  /// are those of close().
  Result<std::string> close_early();

 private:
  static constexpr std::size_t most_early = 10'000;

  Recorder(OutputFile file, LogWriter writer, std::string path, const Port& port);
  void write(const Frame& frame, std::int64_t t_ns, std::uint8_t bus, bool transmitted);
  void keep_early(const Received& received);
  void write_early();
  OutputFile file_;
  LogWriter writer_;
  std::string path_;
  const Port& port_;
  std::int64_t to_realtime_ns_;                  // offset from the port's stamp clock to real time
  std::optional<std::int64_t> virtual_from_ns_;  // stamp of the virtual time 0; none: no virtual time
  std::int64_t virtual_ns_ = 0;
  std::vector<Received> early_;  // received before the first transmission
  bool started_ = false;
};

}  // namespace canhil::observe
