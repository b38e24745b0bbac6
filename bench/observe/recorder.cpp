#include "bench/observe/recorder.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <cstring>

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
      interface_(port.name()),
      to_realtime_ns_(clock_ns(CLOCK_REALTIME) - port.now_ns()) {}

Recorder::~Recorder() {
  if (!closed_) std::remove(unfinished_name(path_).c_str());
}

void Recorder::transmitted(const Frame& frame, std::int64_t t_ns, std::int64_t /*late_ns*/) {
  started_ = true;
  write(frame, t_ns, true);
}

void Recorder::received(const Received& received) {
  if (started_ && !received.own) write(received.frame, received.t_ns, false);
}

void Recorder::write(const Frame& frame, std::int64_t t_ns, bool transmitted) {
  writer_.write(
      {.t_ns = t_ns + to_realtime_ns_, .interface = interface_, .frame = frame, .transmitted = transmitted});
}

Result<void> Recorder::close() {
  const auto give_name = [&](const std::string& name) {
    closed_ = std::rename(unfinished_name(path_).c_str(), name.c_str()) == 0;
    return closed_;
  };
  auto written = writer_.close();
  if (written && give_name(path_)) return {};
  Error error =
      written ? Error{fmt::format("log '{}': cannot be given its name: {}", path_, std::strerror(errno))}
              : written.error();
  if (const std::string rest = path_ + ".incomplete"; give_name(rest))
    error.message += fmt::format("; what was written is in '{}'", rest);
  return tl::unexpected(std::move(error));
}

}  // namespace canhil::observe
