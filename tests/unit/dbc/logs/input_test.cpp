// Logs that are compressed, in UTF-16, in a pipe, or in a format that is not read.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <fstream>
#include <future>

#include "dbc/logs/input.hpp"
#include "tests/own_folder.hpp"
#include "tests/unit/dbc/logs/reading.hpp"

namespace canhil {
namespace {

using namespace std::string_view_literals;
using test::read_log;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string one_frame = "(1.000000) can0 123#05\n";

std::string gzipped(const std::string& text) {
  z_stream stream{};
  constexpr int gzip_header = 16;
  EXPECT_EQ(deflateInit2(&stream, 6, Z_DEFLATED, MAX_WBITS + gzip_header, 8, Z_DEFAULT_STRATEGY), Z_OK);
  std::string compressed(deflateBound(&stream, text.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(compressed.data());
  stream.avail_out = static_cast<uInt>(compressed.size());
  EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
  compressed.resize(stream.total_out);
  deflateEnd(&stream);
  return compressed;
}

std::string in_utf16(std::string_view text, bool big_endian) {
  std::string units;
  for (const char c : text) units += big_endian ? std::string{'\0', c} : std::string{c, '\0'};
  return units;
}

TEST(Input, IsDecompressed) {
  EXPECT_THAT(read_log(gzipped(one_frame)).lines, ElementsAre("(1.000000) can0 123#05 R"));
  EXPECT_EQ(read_log(gzipped(one_frame) + gzipped(one_frame) + std::string(512, '\0')).lines.size(), 2U);
  std::string many;
  for (int i = 0; i < 100'000; ++i) many += one_frame;
  EXPECT_EQ(read_log(gzipped(many)).lines.size(), 100'000U);
  EXPECT_THAT(read_log(gzipped("\xEF\xBB\xBF" + one_frame)).lines.size(), 1U);
}

TEST(Input, ThatIsDamagedIsAnError) {
  const std::string whole = gzipped(one_frame + one_frame);
  EXPECT_THAT(read_log(whole.substr(0, whole.size() - 5)).error,
              HasSubstr("cannot read log 'log': its gzip data end too early"));
  std::string damaged = whole;
  damaged[whole.size() - 6] ^= 1;  // the check sum
  EXPECT_THAT(read_log(damaged).error, HasSubstr("its gzip data are damaged: incorrect data check"));
  EXPECT_THAT(read_log(gzipped(gzipped(one_frame))).error, HasSubstr("is not a log"));
}

TEST(Input, IsReadInUtf16) {
  for (const bool big_endian : {false, true}) {
    const std::string mark = big_endian ? "\xFE\xFF" : "\xFF\xFE";
    EXPECT_EQ(read_log(mark + in_utf16(one_frame, big_endian)).lines.size(), 1U) << big_endian;
  }
  EXPECT_EQ(
      read_log(in_utf16("date x\nbase hex timestamps absolute\n0.5 1 123 Rx d 0\n", false)).lines.size(), 1U)
      << "without a mark";
}

std::string utf8_of(std::string_view units) {
  class Given final : public logs::Bytes {
   public:
    explicit Given(std::string_view rest) : rest_(rest) {}
    Result<std::size_t> read(std::span<char> to) override {
      if (rest_.empty()) return std::size_t{0};
      to[0] = rest_[0];
      rest_.remove_prefix(1);
      return std::size_t{1};
    }
    std::string_view rest_;
  };
  const auto bytes = logs::utf8_of_utf16(std::make_unique<Given>(units), true);
  std::string text;
  for (char c{};;) {
    const auto got = bytes->read({&c, 1});
    if (!got || *got == 0) return text;
    text += c;
  }
}

TEST(Input, CharactersOfUtf16BecomeThoseOfUtf8) {
  EXPECT_EQ(utf8_of("\0A\0\xE4\x20\xAC\xD8\x3D\xDE\x00"sv), "A\xC3\xA4\xE2\x82\xAC\xF0\x9F\x98\x80");
  const std::string unknown = "\xEF\xBF\xBD";
  EXPECT_EQ(utf8_of("\xD8\x3D\0A"sv), unknown + "A") << "half of a pair";
  EXPECT_EQ(utf8_of("\xDE\x00\0A"sv), unknown + "A") << "the other half";
  EXPECT_EQ(utf8_of("\0A\0"sv), "A" + unknown) << "half of a unit";
  EXPECT_EQ(utf8_of("\0A\xD8\x3D"sv), "A" + unknown);
}

TEST(Input, OfAPipeIsReadWhileItIsWritten) {
  const std::string path = test::own_folder() + "/fifo";
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  std::promise<void> read_one;
  auto written = std::async(std::launch::async, [&] {
    const int pipe = ::open(path.c_str(), O_WRONLY);
    bool all = ::write(pipe, one_frame.data(), one_frame.size()) > 0;
    all = read_one.get_future().wait_for(std::chrono::seconds(60)) == std::future_status::ready && all;
    all = ::write(pipe, one_frame.data(), one_frame.size()) > 0 && all;
    ::close(pipe);
    return all;
  });
  auto reader = LogReader::open(path);
  ASSERT_TRUE(reader) << reader.error().message;
  EXPECT_TRUE((*reader->next()).has_value());
  read_one.set_value();
  EXPECT_TRUE((*reader->next()).has_value());
  EXPECT_FALSE((*reader->next()).has_value());
  EXPECT_TRUE(written.get());
}

TEST(LogFile, OfAPipeIsReadTwice) {
  const std::string path = test::own_folder() + "/fifo_read_twice";
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  auto written = std::async(std::launch::async, [&] { std::ofstream(path) << one_frame << one_frame; });
  const auto log = LogFile::open(path);
  ASSERT_TRUE(log) << log.error().message;
  for (int i = 0; i < 2; ++i) {
    auto reader = log->read();
    ASSERT_TRUE(reader) << reader.error().message;
    EXPECT_TRUE((*reader->next()).has_value());
    EXPECT_TRUE((*reader->next()).has_value());
    EXPECT_FALSE((*reader->next()).has_value());
  }
}

TEST(Foreign, IsNamedWithTheCommandThatConvertsIt) {
  const auto said = [](std::string_view content) { return read_log(content).error; };
  EXPECT_THAT(
      said("MDF     4.10    "),
      HasSubstr("it is an ASAM MF4 (MDF) measurement file; convert it with: python3 -c 'import asammdf"));
  EXPECT_EQ(said("SQLite format 3\0..."sv),
            "cannot read log 'log': it is an SQLite database; convert it with: python3 -m can.logconvert "
            "'log' 'log.log' "
            "(Debian package python3-can)");
  EXPECT_THAT(said("timestamp,arbitration_id,extended\n"), HasSubstr("a CSV log of python-can"));
  EXPECT_THAT(said("BZh91AY"), HasSubstr("bzip2 -dk 'log'"));
  EXPECT_THAT(said("PK\x03\x04"), HasSubstr("a ZIP archive"));
}

TEST(Format, OfAFileIsThatOfItsEnding) {
  EXPECT_EQ(log_format_of_file("a.BLF").value(), LogFormat::blf);
  EXPECT_EQ(log_format_of_file("a").value(), LogFormat::candump);
  EXPECT_EQ(log_format_of_file("a.pcap").value(), LogFormat::pcap);
  EXPECT_THAT(log_format_of_file("a.trc").error().message,
              HasSubstr("expected .log (candump), .asc, .blf or .pcap; write a .log, and "
                        "convert it with: python3 -m can.logconvert FILE.log FILE.trc"));
  EXPECT_THAT(log_format_of_file("a.xyz").error().message,
              testing::EndsWith("expected .log (candump), .asc, .blf or .pcap"));
  EXPECT_EQ(log_format("asc"), LogFormat::asc);
  EXPECT_FALSE(log_format("trc"));
}

}  // namespace
}  // namespace canhil
