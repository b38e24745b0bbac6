#include "dbc/logs/log.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "dbc/logs/foreign.hpp"
#include "dbc/logs/formats.hpp"
#include "dbc/logs/remarks.hpp"
#include "dbc/logs/words.hpp"

namespace canhil {
namespace {

struct Format {
  LogFormat format;
  std::string_view name;
  std::unique_ptr<LogSink> (*sink)(logs::File file);
};
constexpr std::array formats{
    Format{LogFormat::candump, "candump", logs::candump_sink}, Format{LogFormat::asc, "asc", logs::asc_sink},
    Format{LogFormat::blf, "blf", logs::blf_sink}, Format{LogFormat::pcap, "pcap", logs::pcap_sink}};

constexpr std::array candump_endings{"", ".log", ".txt", ".candump"};

Result<void> copy(logs::Input& input, int to) {
  for (;;) {
    const auto some = input.available();
    if (!some) return tl::unexpected(some.error());
    if (some->empty()) return {};
    const ssize_t written = ::write(to, some->data(), some->size());
    if (written < 0 && errno != EINTR)
      return failure(fmt::format("cannot copy log '{}', which is a pipe and is read twice: {}", input.name(),
                                 std::strerror(errno)));
    if (written > 0) input.take(static_cast<std::size_t>(written));
  }
}

int unnamed_file() {
  const char* folder = std::getenv("TMPDIR");
  return ::open(folder != nullptr && *folder != '\0' ? folder : "/var/tmp", O_TMPFILE | O_RDWR | O_CLOEXEC,
                0600);
}

}  // namespace

std::optional<LogFormat> log_format(std::string_view name) {
  const auto found = std::ranges::find(formats, name, &Format::name);
  return found == formats.end() ? std::nullopt : std::optional(found->format);
}

Result<LogFormat> log_format_of_file(const std::string& file) {
  std::string ending = std::filesystem::path(file).extension().string();
  std::ranges::transform(ending, ending.begin(), logs::lower);
  if (std::ranges::find(candump_endings, ending) != candump_endings.end()) return LogFormat::candump;
  if (const auto named = log_format(std::string_view(ending).substr(1))) return *named;
  return failure(fmt::format(
      "cannot write log '{}': its ending names no format that can be written, expected .log (candump), .asc, "
      ".blf or .pcap{}",
      file, logs::how_to_write(ending)));
}

void LogSource::leave_out(std::string_view reason) {
  auto found = std::ranges::find(left_out_, reason, &LeftOut::reason);
  if (found == left_out_.end()) {
    constexpr std::size_t most_shown = 200;
    std::string first = last();
    if (first.size() > most_shown) first = first.substr(0, most_shown) + "...";
    found = left_out_.insert(left_out_.end(), {.reason = std::string(reason), .first = std::move(first)});
  }
  ++found->count;
}

std::vector<std::string> LogSource::left_out() const {
  std::vector<std::string> all;
  for (const LeftOut& one : left_out_)
    all.push_back(fmt::format("{} left out: {}; the first is {}", one.count, one.reason, one.first));
  return all;
}

std::uint64_t LogSource::left_out_count() const {
  std::uint64_t all = 0;
  for (const LeftOut& one : left_out_) all += one.count;
  return all;
}

std::vector<std::string> LogSource::remarks(const std::string& name) const {
  std::vector<std::string> all = remarks_;
  for (const std::string& one : left_out()) all.push_back(fmt::format("log '{}': {}", name, one));
  return all;
}

Result<LogWriter> LogWriter::create(std::FILE* stream, std::string name) {
  logs::File file(stream);
  const auto format = log_format_of_file(name);
  if (!format) return tl::unexpected(format.error());
  return create(file.release(), std::move(name), *format);
}

LogWriter LogWriter::create(std::FILE* stream, std::string name, LogFormat format) {
  return LogWriter(std::ranges::find(formats, format, &Format::format)->sink(logs::File(stream)),
                   std::move(name));
}

Result<void> LogWriter::close() {
  if (const int error = sink_->close(); error != 0)
    return failure(fmt::format("cannot write log '{}': {}", name_, std::strerror(error)));
  return {};
}

void LogReader::End::operator()(LogSource* source) const {
  if (!refused) LogRemarks::hand_over(name, source->left_out_count(), source->remarks(name));
  delete source;
}

Result<LogReader> LogReader::open(const std::string& path, RemoteFrames remote) {
  auto input = logs::Input::open(path, path);
  if (!input) return tl::unexpected(input.error());
  auto source = logs::source_of(std::move(*input));
  if (!source) return tl::unexpected(source.error());
  return LogReader(std::move(*source), path, remote);
}

Result<LogReader> LogReader::of_memory(std::string_view content, const std::string& name,
                                       RemoteFrames remote) {
  auto input = logs::Input::of_memory(content, name);
  if (!input) return tl::unexpected(input.error());
  auto source = logs::source_of(std::move(*input));
  if (!source) return tl::unexpected(source.error());
  return LogReader(std::move(*source), name, remote);
}

Result<std::optional<LogEntry>> LogReader::next() {
  for (;;) {
    auto entry = source_->next();
    if (!entry && !any_ && !source_->recognised()) source_.get_deleter().refused = true;
    if (!entry) return entry;
    if (!*entry) {
      if (!any_ && source_->left_out_count() > 0 && !source_->recognised()) {
        source_.get_deleter().refused = true;
        return failure(
            fmt::format("'{}': is not a log of CAN, expected candump, ASC, BLF, TRC, SavvyCAN's CSV, "
                        "pcap or pcapng: {}",
                        name(), fmt::join(source_->left_out(), "; ")));
      }
      return entry;
    }
    any_ = true;
    if (!(*entry)->remote || remote_ == RemoteFrames::kept) return entry;
    source_->leave_out("remote frames");
  }
}

Result<LogFile> LogFile::open(const std::string& path) {
  LogFile log(path);
  struct stat status {};
  // Only what ends and cannot be read again is copied: the copy of a device such as /dev/zero would fill the
  // disk.
  if (::stat(path.c_str(), &status) != 0 || (!S_ISFIFO(status.st_mode) && !S_ISSOCK(status.st_mode)))
    return log;
  auto input = logs::Input::open(path, path);
  if (!input) return tl::unexpected(input.error());
  log.copy_ = std::shared_ptr<const int>(new int(unnamed_file()), [](const int* descriptor) {
    if (*descriptor >= 0) ::close(*descriptor);
    delete descriptor;
  });
  if (*log.copy_ < 0)
    return failure(fmt::format("cannot copy log '{}', which is a pipe and is read twice: {}", path,
                               std::strerror(errno)));
  if (auto copied = copy(*input, *log.copy_); !copied) return tl::unexpected(copied.error());
  return log;
}

Result<LogReader> LogFile::read(RemoteFrames remote) const {
  if (!copy_) return LogReader::open(name_, remote);
  // Opening the copy again gives a reader a position of its own.
  auto input = logs::Input::open(fmt::format("/proc/self/fd/{}", *copy_), name_);
  if (!input) return tl::unexpected(input.error());
  auto source = logs::source_of(std::move(*input));
  if (!source) return tl::unexpected(source.error());
  return LogReader(std::move(*source), name_, remote);
}

}  // namespace canhil
