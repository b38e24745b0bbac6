// Logs of frames. A reader detects the format from the content of the file, a writer chooses it by name:
//   candump  *.log, *.txt, *.candump, and names without an ending: the format of can-utils (candump.hpp),
//            stamps in microseconds; for can-utils and python-can
//   asc      *.asc: Vector's ASCII log, stamps in microseconds; for CANoe, CANalyzer and python-can. Of an
//            error frame, it contains only the time
//   blf      *.blf: Vector's binary log, stamps in nanoseconds; for CANoe, CANalyzer and python-can
//   pcap     *.pcap: libpcap's format with link type SocketCAN, stamps in nanoseconds; for tcpdump, Wireshark
//            and tshark. Contains neither the names of interfaces nor whether the recorder sent a frame
// These are read and not written: pcapng, PEAK's TRC, and the CSV of SavvyCAN. A log may be compressed with
// gzip, its text may be UTF-8 or UTF-16, and it may come from a pipe.
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dbc/wire/frame.hpp"
#include "dbc/wire/result.hpp"

namespace canhil {

/// One frame of a log.
struct LogEntry {
  std::int64_t t_ns = 0;  ///< time stamp of CLOCK_REALTIME
  std::string interface;
  Frame frame;
  bool transmitted = false;  ///< true: the recorder itself sent the frame
  /// A remote frame: it requests `frame.size` bytes of data and carries none.
  bool remote = false;
};

/// The formats that can be written.
enum class LogFormat : std::uint8_t { candump, asc, blf, pcap };

/// The format with this name: candump, asc, blf or pcap; nullopt: there is no such format.
std::optional<LogFormat> log_format(std::string_view name);
/// The format that the ending of a file name selects. The error, one line, states the endings that exist and,
/// for a format that other programs write, the command.
Result<LogFormat> log_format_of_file(const std::string& file);

/// Base class: writes a log in one format.
class LogSink {
 public:
  LogSink() = default;
  LogSink(const LogSink&) = delete;
  LogSink& operator=(const LogSink&) = delete;
  virtual ~LogSink() = default;
  /// Appends an entry. If this fails, close() returns the error.
  virtual void write(const LogEntry& entry) = 0;
  /// Ends the log. Returns the errno of the error after which nothing more was written; 0: everything was
  /// written.
  virtual int close() = 0;
};

/// Base class: reads a log of one format.
class LogSource {
 public:
  LogSource() = default;
  LogSource(const LogSource&) = delete;
  LogSource& operator=(const LogSource&) = delete;
  virtual ~LogSource() = default;
  /// The next entry; nullopt: the log has ended. The error is one line that states the position in the file.
  virtual Result<std::optional<LogEntry>> next() = 0;
  /// Where the line or record is that was read last, and its text if it has one.
  [[nodiscard]] virtual std::string last() const = 0;
  /// True if something in the file shows that it is a log of this format.
  [[nodiscard]] virtual bool recognised() const { return true; }

  /// Counts the line or record that was read last as left out.
  void leave_out(std::string_view reason);
  /// See LogReader::remarks().
  [[nodiscard]] std::vector<std::string> remarks(const std::string& name) const;
  /// One line for each reason for which lines or records were left out.
  [[nodiscard]] std::vector<std::string> left_out() const;
  /// How many lines and records were left out.
  [[nodiscard]] std::uint64_t left_out_count() const;

 protected:
  /// Adds a remark about how the log was read.
  void remark(std::string text) { remarks_.push_back(std::move(text)); }

 private:
  struct LeftOut {
    std::string reason;
    std::uint64_t count = 0;
    std::string first;
  };
  std::vector<LeftOut> left_out_;
  std::vector<std::string> remarks_;
};

/// Writes a log, through a buffer. If a write fails (for example because the disk is full), close() returns
/// the error.
class LogWriter {
 public:
  /// Writes to a stream, and closes it. `name` is the name of the finished log: it appears in error messages
  /// and determines the format. Error: its ending names no format that can be written.
  static Result<LogWriter> create(std::FILE* stream, std::string name);
  /// Writes in a given format, whatever the name is.
  static LogWriter create(std::FILE* stream, std::string name, LogFormat format);
  /// Appends an entry. If this fails, close() returns the error.
  void write(const LogEntry& entry) { sink_->write(entry); }
  /// Flushes the buffer and ends the log.
  Result<void> close();

 private:
  LogWriter(std::unique_ptr<LogSink> sink, std::string name)
      : name_(std::move(name)), sink_(std::move(sink)) {}

  std::string name_;
  std::unique_ptr<LogSink> sink_;
};

/// What a reader does with remote frames. Most readers leave them out, because no message of a DBC is one.
enum class RemoteFrames : std::uint8_t { left_out, kept };

/// Reads a log, entry by entry. A malformed line is an error. Lines and records that are not frames of CAN or
/// CAN FD are counted; a program says them by LogRemarks.
class LogReader {
 public:
  /// Opens a log. The first bytes of the file determine the format. An error is one line; for a format that
  /// other programs can convert, it states the command.
  static Result<LogReader> open(const std::string& path, RemoteFrames remote = RemoteFrames::left_out);
  /// Reads a log in memory, which must outlive the reader. `name` appears in messages.
  static Result<LogReader> of_memory(std::string_view content, const std::string& name,
                                     RemoteFrames remote = RemoteFrames::left_out);
  /// The next entry; nullopt: the log has ended. An error begins with "FILE:LINE:COLUMN: ..."; for binary
  /// formats it is "FILE: packet N: ..." or "FILE: object N: ...". A file in which nothing is of a log is an
  /// error too.
  Result<std::optional<LogEntry>> next();
  /// What has not been read so far, one line for each reason with the count and the first line or record; and
  /// what had to be assumed, such as a date that is not understood.
  [[nodiscard]] std::vector<std::string> remarks() const { return source_->remarks(name()); }

 private:
  friend class LogFile;
  // Ends the reading of a log.
  struct End {
    std::string name;      // of the log
    bool refused = false;  // the file is no log; an error says so
    void operator()(LogSource* source) const;
  };

  LogReader(std::unique_ptr<LogSource> source, std::string name, RemoteFrames remote)
      : source_(source.release(), End{.name = std::move(name)}), remote_(remote) {}
  [[nodiscard]] const std::string& name() const { return source_.get_deleter().name; }

  std::unique_ptr<LogSource, End> source_;
  RemoteFrames remote_;
  bool any_ = false;  // true: an entry has been read
};

/// A log that is read several times. A pipe can be read only once, so its content is copied into an unnamed
/// file in TMPDIR (default /var/tmp).
class LogFile {
 public:
  /// Copies the content if this is necessary. An error is one line.
  static Result<LogFile> open(const std::string& path);
  /// A reader that begins at the beginning of the log.
  [[nodiscard]] Result<LogReader> read(RemoteFrames remote = RemoteFrames::left_out) const;
  /// The path of the log.
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  explicit LogFile(std::string name) : name_(std::move(name)) {}

  std::string name_;
  std::shared_ptr<const int> copy_;  // descriptor of the copy; null: the file itself can be read again
};

}  // namespace canhil
