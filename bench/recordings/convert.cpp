#include "bench/recordings/convert.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "dbc/files/unfinished_name.hpp"
#include "dbc/logs/log.hpp"

namespace canhil::recordings {
namespace {

Result<std::uint64_t> copy(LogReader& reader, LogWriter& writer) {
  std::uint64_t frames = 0;
  for (;; ++frames) {
    const auto entry = reader.next();
    if (!entry) return tl::unexpected(entry.error());
    if (!*entry) break;
    writer.write(**entry);
  }
  if (auto closed = writer.close(); !closed) return tl::unexpected(closed.error());
  return frames;
}

}  // namespace

Result<std::uint64_t> convert(const std::string& from, const std::string& to) {
  auto reader = LogReader::open(from);
  if (!reader) return tl::unexpected(reader.error());
  const std::string unfinished = unfinished_name(to);
  auto writer = LogWriter::create(unfinished, to);
  if (!writer) return tl::unexpected(writer.error());
  auto copied = copy(*reader, *writer);
  if (copied && std::rename(unfinished.c_str(), to.c_str()) == 0) return copied;
  const int error = errno;
  std::remove(unfinished.c_str());
  if (!copied) return copied;
  return failure(fmt::format("cannot write log '{}': {}", to, std::strerror(error)));
}

}  // namespace canhil::recordings
