#include "bench/observe/recorder.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

#include "dbc/files/unfinished_name.hpp"

namespace canhil::observe {

Result<std::unique_ptr<Recorder>> Recorder::open(const std::string& path, const Port& port) {
  return LogWriter::create(unfinished_name(path), path).map([&](LogWriter writer) {
    return std::unique_ptr<Recorder>(new Recorder(std::move(writer), path, port));
  });
}

Recorder::Recorder(LogWriter writer, std::string path, const Port& port)
    : writer_(std::move(writer)),
      path_(std::move(path)),
      port_(port),
      to_realtime_ns_(clock_ns(CLOCK_REALTIME) - port.now_ns()) {}

Recorder::~Recorder() {
  if (!closed_) std::remove(unfinished_name(path_).c_str());
}

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

bool Recorder::give_name(const std::string& name) {
  closed_ = std::rename(unfinished_name(path_).c_str(), name.c_str()) == 0;
  return closed_;
}

Result<void> Recorder::close() {
  auto written = writer_.close();
  if (written && give_name(path_)) return {};
  Error error =
      written ? Error{fmt::format("log '{}': cannot be given its name: {}", path_, std::strerror(errno))}
              : written.error();
  if (const std::string rest = path_ + ".incomplete"; give_name(rest))
    error.message += fmt::format("; what was written is in '{}'", rest);
  return tl::unexpected(std::move(error));
}

// A run that does not begin must not overwrite an earlier log.
Result<std::string> Recorder::close_early() {
  if (!started_ && early_.empty()) return std::string();
  std::string name = path_;
  std::error_code ignored;
  if (std::filesystem::exists(path_, ignored)) name += ".incomplete";
  write_early();
  if (auto written = writer_.close(); !written) return tl::unexpected(written.error());
  if (give_name(name)) return name;
  return failure(fmt::format("log '{}': cannot be given its name: {}", name, std::strerror(errno)));
}

}  // namespace canhil::observe
