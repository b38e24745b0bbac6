#include "bench/recordings/convert.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "dbc/files/output_file.hpp"

namespace canhil::recordings {
namespace {

Result<std::uint64_t> copy(LogReader& reader, LogWriter& writer) {
  for (std::uint64_t frames = 0;; ++frames) {
    const auto entry = reader.next();
    if (!entry) return tl::unexpected(entry.error());
    if (*entry) {
      writer.write(**entry);
      continue;
    }
    if (auto closed = writer.close(); !closed) return tl::unexpected(closed.error());
    return frames;
  }
}

}  // namespace

Result<std::uint64_t> convert(const std::string& from, const std::string& to, LogFormat format) {
  auto reader = LogReader::open(from, RemoteFrames::kept);
  if (!reader) return tl::unexpected(reader.error());
  auto file = OutputFile::create(to);
  if (!file) return tl::unexpected(file.error());
  const auto cannot_write = [&](int error) {
    return failure(fmt::format("cannot write log '{}': {}", to, std::strerror(error)));
  };
  std::FILE* stream = file->take_stream();
  if (stream == nullptr) return cannot_write(errno);
  auto writer = LogWriter::create(stream, to, format);
  auto copied = copy(*reader, writer);
  if (!copied) return copied;
  const int error = file->give_name(to);
  if (error != 0) return cannot_write(error);
  return copied;
}

}  // namespace canhil::recordings
