#include "bench/observe/recorder.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

namespace canhil::observe {

Result<std::unique_ptr<Recorder>> Recorder::open(const std::string& path, const Port& port) {
  auto file = OutputFile::create(path);
  if (!file) return tl::unexpected(file.error());
  std::FILE* stream = file->take_stream();
  if (stream == nullptr)
    return failure(fmt::format("log '{}': cannot be written: {}", path, std::strerror(errno)));
  auto writer = LogWriter::create(stream, path);
  if (!writer) return tl::unexpected(writer.error());
  return std::unique_ptr<Recorder>(new Recorder(std::move(*file), std::move(*writer), path, port));
}

Recorder::Recorder(OutputFile file, LogWriter writer, std::string path, const Port& port)
    : file_(std::move(file)),
      writer_(std::move(writer)),
      path_(std::move(path)),
      port_(port),
      to_realtime_ns_(clock_ns(CLOCK_REALTIME) - port.now_ns()) {}

void Recorder::time_set(std::int64_t t_ns) {
  if (!virtual_from_ns_) virtual_from_ns_ = port_.now_ns() - t_ns;
  virtual_ns_ = t_ns;
}

void Recorder::transmitted(const Frame& frame, std::int64_t t_ns, std::int64_t /*late_ns*/) {
  started_ = true;
  early_ = {};
  write(frame, t_ns, port_.bus_of(frame), true);
}

void Recorder::received(const Received& received) {
  if (received.own) return;
  if (started_) {
    write(received.frame, received.t_ns, received.bus, false);
  } else {
    keep_early(received);
  }
}

// Frames in a foreign format are not part of a run, but may be the reason why the run does not begin.
void Recorder::foreign(const Received& received) {
  if (!started_) keep_early(received);
}

void Recorder::keep_early(const Received& received) {
  if (early_.size() < most_early) early_.push_back(received);
}

void Recorder::write_early() {
  for (const Received& received : early_) write(received.frame, received.t_ns, received.bus, false);
  early_ = {};
}

void Recorder::write(const Frame& frame, std::int64_t t_ns, std::uint8_t bus, bool transmitted) {
  if (virtual_from_ns_) t_ns = *virtual_from_ns_ + virtual_ns_;
  writer_.write({.t_ns = t_ns + to_realtime_ns_,
                 .interface = port_.bus_name(bus),
                 .frame = frame,
                 .transmitted = transmitted});
}

Result<void> Recorder::close() {
  auto written = writer_.close();
  const int reason = written ? file_.give_name(path_) : 0;
  if (written && reason == 0) return {};
  Error error =
      written ? Error{fmt::format("log '{}': cannot be given its name: {}", path_, std::strerror(reason))}
              : written.error();
  if (const std::string rest = incomplete_log(path_); file_.give_name(rest) == 0)
    error.message += fmt::format("; what was written is in '{}'", rest);
  return tl::unexpected(std::move(error));
}

// A run that does not begin must not overwrite an earlier log.
Result<std::string> Recorder::close_early() {
  if (!started_ && early_.empty()) return std::string();
  std::string name = path_;
  std::error_code ignored;
  if (std::filesystem::exists(path_, ignored)) name = incomplete_log(path_);
  write_early();
  if (auto written = writer_.close(); !written) return tl::unexpected(written.error());
  const int reason = file_.give_name(name);
  if (reason == 0) return name;
  return failure(fmt::format("log '{}': cannot be given its name: {}", name, std::strerror(reason)));
}

}  // namespace canhil::observe
