#include "dbc/logs/input.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace canhil::logs {
namespace {

using namespace std::string_view_literals;

class OfDescriptor final : public Bytes {
 public:
  explicit OfDescriptor(int descriptor) : descriptor_(descriptor) {}
  OfDescriptor(const OfDescriptor&) = delete;
  OfDescriptor& operator=(const OfDescriptor&) = delete;
  ~OfDescriptor() override { ::close(descriptor_); }

  Result<std::size_t> read(std::span<char> to) override {
    for (;;) {
      const ssize_t got = ::read(descriptor_, to.data(), to.size());
      if (got >= 0) return static_cast<std::size_t>(got);
      if (errno != EINTR) return failure(std::strerror(errno));
    }
  }

 private:
  int descriptor_;
};

class OfMemory final : public Bytes {
 public:
  explicit OfMemory(std::string_view rest) : rest_(rest) {}
  Result<std::size_t> read(std::span<char> to) override {
    const std::size_t size = std::min(to.size(), rest_.size());
    std::copy_n(rest_.data(), size, to.data());
    rest_.remove_prefix(size);
    return size;
  }

 private:
  std::string_view rest_;
};

// Bytes that were read ahead of the conversion that follows, then the rest.
class Ahead final : public Bytes {
 public:
  Ahead(std::string ahead, std::unique_ptr<Bytes> rest) : ahead_(std::move(ahead)), rest_(std::move(rest)) {}
  Result<std::size_t> read(std::span<char> to) override {
    if (taken_ == ahead_.size()) return rest_->read(to);
    const std::size_t size = std::min(to.size(), ahead_.size() - taken_);
    std::copy_n(ahead_.data() + taken_, size, to.data());
    taken_ += size;
    return size;
  }

 private:
  std::string ahead_;
  std::size_t taken_ = 0;
  std::unique_ptr<Bytes> rest_;
};

constexpr std::string_view gzip = "\x1F\x8B"sv;
constexpr std::string_view utf8_mark = "\xEF\xBB\xBF"sv, utf16_little = "\xFF\xFE"sv,
                           utf16_big = "\xFE\xFF"sv;

}  // namespace

Result<Input> Input::open(const std::string& path, std::string name) {
  const auto cannot = [&](int error) {
    return failure(fmt::format("cannot read log '{}': {}", name, std::strerror(error)));
  };
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return cannot(errno);
  auto bytes = std::make_unique<OfDescriptor>(descriptor);
  struct stat status {};
  if (::fstat(descriptor, &status) == 0 && S_ISDIR(status.st_mode)) return cannot(EISDIR);
  Input input(std::move(bytes), std::move(name));
  if (auto converted = input.convert(); !converted) return tl::unexpected(converted.error());
  return input;
}

Result<Input> Input::of_memory(std::string_view content, std::string name) {
  Input input(std::make_unique<OfMemory>(content), std::move(name));
  if (auto converted = input.convert(); !converted) return tl::unexpected(converted.error());
  return input;
}

// Inserts the conversions that the beginning of the content asks for. The content of a gzip file may be text
// in UTF-16.
Result<void> Input::convert() {
  const auto insert = [&](auto stage, auto... settings) {
    std::string ahead(buffer_.data() + begin_, end_ - begin_);
    begin_ = end_ = 0;
    bytes_ = stage(std::make_unique<Ahead>(std::move(ahead), std::move(bytes_)), settings...);
  };
  auto beginning = peek(2);
  if (beginning && *beginning == gzip) {
    insert(gunzip);
    beginning = peek(2);
  }
  if (!beginning) return tl::unexpected(beginning.error());
  if (*beginning == utf16_little || *beginning == utf16_big) {
    const bool big_endian = *beginning == utf16_big;
    take(2);
    insert(utf8_of_utf16, big_endian);
  } else if (*beginning == utf8_mark.substr(0, 2)) {
    const auto mark = peek(utf8_mark.size());
    if (mark && *mark == utf8_mark) take(utf8_mark.size());
  } else if (beginning->size() == 2 && (*beginning)[1] == '\0' && (*beginning)[0] > ' ') {
    const auto two = peek(4);  // UTF-16 without a byte order mark: no log format begins like this
    if (two && two->size() == 4 && (*two)[3] == '\0' && (*two)[2] > ' ') insert(utf8_of_utf16, false);
  }
  return {};
}

// Reads some more bytes behind those that are in the buffer; 0: the end.
Result<std::size_t> Input::fill() {
  if (begin_ > 0 && (begin_ == end_ || end_ == buffer_.size())) {
    std::copy(buffer_.begin() + static_cast<std::ptrdiff_t>(begin_),
              buffer_.begin() + static_cast<std::ptrdiff_t>(end_), buffer_.begin());
    end_ -= begin_;
    begin_ = 0;
  }
  auto got = bytes_->read(std::span(buffer_).subspan(end_));
  if (!got) return failure(fmt::format("cannot read log '{}': {}", name_, got.error().message));
  end_ += *got;
  return got;
}

Result<std::string_view> Input::peek(std::size_t most) {
  most = std::min(most, longest_peek);
  if (most > buffer_.size()) buffer_.resize(most);
  while (end_ - begin_ < most) {
    const auto got = fill();
    if (!got) return tl::unexpected(got.error());
    if (*got == 0) break;
  }
  return std::string_view(buffer_.data() + begin_, std::min(most, end_ - begin_));
}

Result<std::string_view> Input::available() {
  if (begin_ == end_) {
    if (const auto got = fill(); !got) return tl::unexpected(got.error());
  }
  return std::string_view(buffer_.data() + begin_, end_ - begin_);
}

Result<bool> Input::read(std::span<char> to) {
  while (!to.empty()) {
    const auto some = available();
    if (!some) return tl::unexpected(some.error());
    if (some->empty()) return false;
    const std::size_t size = std::min(some->size(), to.size());
    std::copy_n(some->data(), size, to.data());
    take(size);
    to = to.subspan(size);
  }
  return true;
}

Result<bool> Input::skip(std::uint64_t bytes) {
  while (bytes > 0) {
    const auto some = available();
    if (!some) return tl::unexpected(some.error());
    if (some->empty()) return false;
    const std::size_t size = static_cast<std::size_t>(std::min<std::uint64_t>(some->size(), bytes));
    take(size);
    bytes -= size;
  }
  return true;
}

}  // namespace canhil::logs
