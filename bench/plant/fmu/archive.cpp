#include "bench/plant/fmu/archive.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zip.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <functional>
#include <map>
#include <string_view>
#include <system_error>

namespace canhil::plant::fmu {
namespace {

namespace fs = std::filesystem;

// libzip ends the life of what it returns with these functions.
struct Discard {
  void operator()(zip_t* archive) const { zip_discard(archive); }
  void operator()(zip_file_t* file) const { zip_fclose(file); }
};
using OpenArchive = std::unique_ptr<zip_t, Discard>;
using OpenEntry = std::unique_ptr<zip_file_t, Discard>;

Result<OpenArchive> open_zip(const std::string& content) {
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* source = zip_source_buffer_create(content.data(), content.size(), 0, &error);
  zip_t* archive = source == nullptr ? nullptr : zip_open_from_source(source, ZIP_RDONLY, &error);
  if (archive == nullptr && source != nullptr) zip_source_free(source);
  const std::string reason = archive == nullptr ? zip_error_strerror(&error) : "";
  zip_error_fini(&error);
  if (archive == nullptr) return failure(fmt::format("is not a zip archive ({}), expected an FMU", reason));
  return OpenArchive(archive);
}

bool is_folder(std::string_view name) { return name.ends_with('/'); }

/// Whether a name stays below the root of the archive.
bool stays_inside(std::string_view name) {
  if (name.empty() || name.front() == '/' || name.find('\\') != std::string_view::npos) return false;
  if (is_folder(name)) name.remove_suffix(1);
  while (true) {
    const auto slash = name.find('/');
    const std::string_view part = name.substr(0, slash);
    if (part.empty() || part == "." || part == "..") return false;
    if (slash == std::string_view::npos) return true;
    name.remove_prefix(slash + 1);
  }
}

/// The mode of an entry as Unix stores it; 0: unknown.
unsigned mode_of(zip_t* archive, zip_uint64_t index) {
  zip_uint8_t system = 0;
  zip_uint32_t attributes = 0;
  if (zip_file_get_external_attributes(archive, index, 0, &system, &attributes) != 0) return 0;
  return system == ZIP_OPSYS_UNIX || system == ZIP_OPSYS_OS_X ? attributes >> 16U : 0;
}

/// Reads an entry piece by piece; an error from `take` ends it.
Result<void> read_entry(zip_t* archive, zip_uint64_t index, const std::string& name,
                        const std::function<Result<void>(std::string_view)>& take) {
  const OpenEntry entry(zip_fopen_index(archive, index, 0));
  if (!entry) return failure(fmt::format("its file '{}' cannot be read ({})", name, zip_strerror(archive)));
  std::array<char, 65536> piece{};
  while (true) {
    const zip_int64_t got = zip_fread(entry.get(), piece.data(), piece.size());
    if (got < 0)
      return failure(fmt::format("its file '{}' is damaged ({})", name, zip_file_strerror(entry.get())));
    if (got == 0) return {};
    if (auto taken = take({piece.data(), static_cast<std::size_t>(got)}); !taken) return taken;
  }
}

Error unwritable(const fs::path& path, int reason) {
  return {fmt::format("{}: cannot be written ({})", path.string(), std::generic_category().message(reason))};
}

tl::unexpected<Error> too_large() {
  return failure(
      fmt::format("unpacks to more than {} MiB, expected at most that", most_unpacked_bytes >> 20U));
}

/// Writes an entry to a new file; `left` is the number of bytes that it may have, and is reduced by them.
Result<void> write_entry(zip_t* archive, zip_uint64_t index, const std::string& name, const fs::path& path,
                         std::size_t& left) {
  const mode_t mode = (mode_of(archive, index) & S_IXUSR) != 0 ? 0700 : 0600;
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
  if (file < 0) return tl::unexpected(unwritable(path, errno));
  auto written = read_entry(archive, index, name, [&](std::string_view piece) -> Result<void> {
    if (piece.size() > left) return too_large();
    left -= piece.size();
    while (!piece.empty()) {
      const ssize_t done = ::write(file, piece.data(), piece.size());
      if (done < 0 && errno == EINTR) continue;
      if (done <= 0) return tl::unexpected(unwritable(path, errno));
      piece.remove_prefix(static_cast<std::size_t>(done));
    }
    return {};
  });
  if (::close(file) != 0 && written) written = tl::unexpected(unwritable(path, errno));
  return written;
}

}  // namespace

Result<Archive> Archive::open(std::string content) {
  Archive own;
  own.content_ = std::make_shared<const std::string>(std::move(content));
  const auto archive = open_zip(*own.content_);
  if (!archive) return tl::unexpected(archive.error());
  const zip_int64_t count = zip_get_num_entries(archive->get(), 0);
  constexpr zip_uint64_t wanted = ZIP_STAT_NAME | ZIP_STAT_SIZE | ZIP_STAT_CRC;
  std::uint64_t bytes = 0;
  std::map<std::string, std::pair<zip_uint64_t, zip_uint32_t>> seen;  // size and checksum of each entry
  for (zip_uint64_t index = 0; index < static_cast<zip_uint64_t>(std::max<zip_int64_t>(count, 0)); ++index) {
    zip_stat_t facts;
    zip_stat_init(&facts);
    if (zip_stat_index(archive->get(), index, 0, &facts) != 0 || (facts.valid & wanted) != wanted)
      return failure(fmt::format("is damaged ({}), expected a zip archive", zip_strerror(archive->get())));
    const std::string name = facts.name;
    const unsigned kind = mode_of(archive->get(), index) & S_IFMT;
    if (!stays_inside(name))
      return failure(fmt::format("contains '{}', expected files below its own folder", name));
    if (kind != 0 && kind != S_IFREG && kind != S_IFDIR)
      return failure(fmt::format("contains the link or device '{}', expected files and folders", name));
    bytes += std::min<std::uint64_t>(facts.size, most_unpacked_bytes);
    if (bytes >= most_unpacked_bytes) return too_large();
    const auto [place, is_new] = seen.emplace(name, std::pair(facts.size, facts.crc));
    // Some tools list a folder or a file several times.
    if (!is_new && place->second != std::pair(facts.size, facts.crc))
      return failure(fmt::format("contains '{}' twice with different contents, expected it once", name));
  }
  for (const auto& [name, content_of_it] : seen) own.names_.push_back(name);
  return own;
}

bool Archive::has(const std::string& name) const { return std::ranges::binary_search(names_, name); }

Result<std::string> Archive::read(const std::string& name, std::size_t most_bytes) const {
  const auto archive = open_zip(*content_);
  if (!archive) return tl::unexpected(archive.error());
  const zip_int64_t index = zip_name_locate(archive->get(), name.c_str(), 0);
  if (index < 0) return failure(fmt::format("has no {}, expected an FMU", name));
  std::string content;
  auto read = read_entry(archive->get(), static_cast<zip_uint64_t>(index), name,
                         [&](std::string_view piece) -> Result<void> {
                           content += piece;
                           if (content.size() <= most_bytes) return {};
                           return failure(
                               fmt::format("its file '{}' is larger than {} MiB, expected at most "
                                           "that",
                                           name, most_bytes >> 20U));
                         });
  if (!read) return tl::unexpected(read.error());
  return content;
}

Result<void> Archive::unpack(const fs::path& folder) const {
  const auto archive = open_zip(*content_);
  if (!archive) return tl::unexpected(archive.error());
  std::size_t left = most_unpacked_bytes;
  for (const std::string& name : names_) {
    const fs::path path = folder / name;
    std::error_code error;
    fs::create_directories(is_folder(name) ? path : path.parent_path(), error);
    if (error) return tl::unexpected(unwritable(path, error.value()));
    if (is_folder(name)) continue;
    const auto index = static_cast<zip_uint64_t>(zip_name_locate(archive->get(), name.c_str(), 0));
    if (auto written = write_entry(archive->get(), index, name, path, left); !written) return written;
  }
  return {};
}

}  // namespace canhil::plant::fmu
