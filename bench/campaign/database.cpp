#include "bench/campaign/database.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace canhil::campaign {
namespace {

// Why the system refused, where SQLite's words do not say: 0 if it does not know.
int reason_of(int code, const std::string& file, sqlite3* database) {
  int reason = 0;
  if (code == SQLITE_IOERR) sqlite3_file_control(database, "main", SQLITE_FCNTL_LAST_ERRNO, &reason);
  if (code == SQLITE_CANTOPEN) {  // SQLite's own errno is that of another try, to read only
    const std::filesystem::path path = std::filesystem::absolute(file);
    const bool there = std::filesystem::exists(std::filesystem::symlink_status(path));
    if (access((there ? path : path.parent_path()).c_str(), W_OK) != 0) reason = errno;
  }
  return reason;
}

auto complaint(const std::string& file, int code, sqlite3* database) {
  if (code == SQLITE_BUSY) return failure(fmt::format("{}: is in use by another program", file));
  if (code == SQLITE_NOTADB) {
    return failure(fmt::format("{}: is no SQLite file, expected results of a campaign", file));
  }
  const int reason = reason_of(code & 0xFF, file, database);
  return failure(fmt::format("{}: cannot be read or written: {}{}", file, sqlite3_errmsg(database),
                             reason == 0 ? "" : fmt::format(" ({})", std::strerror(reason))));
}

}  // namespace

Statement& Statement::bind(int place, std::int64_t value) {
  sqlite3_bind_int64(statement_.get(), place, value);
  return *this;
}

Statement& Statement::bind(int place, std::string_view text) {
  sqlite3_bind_text64(statement_.get(), place, text.data(), text.size(), SQLITE_TRANSIENT, SQLITE_UTF8);
  return *this;
}

Statement& Statement::bind(int place, std::span<const std::uint8_t> bytes) {
  // A null pointer would bind NULL.
  static constexpr std::uint8_t none = 0;
  sqlite3_bind_blob64(statement_.get(), place, bytes.empty() ? &none : bytes.data(), bytes.size(),
                      SQLITE_TRANSIENT);
  return *this;
}

Result<bool> Statement::step() {
  const int code = sqlite3_step(statement_.get());
  if (code == SQLITE_ROW) return true;
  if (code == SQLITE_DONE) return false;
  return complaint(file_, code, sqlite3_db_handle(statement_.get()));
}

void Statement::reset() {
  sqlite3_reset(statement_.get());
  sqlite3_clear_bindings(statement_.get());
}

std::int64_t Statement::integer(int column) const { return sqlite3_column_int64(statement_.get(), column); }

std::string Statement::text(int column) const {
  const std::span<const std::uint8_t> content = bytes(column);
  return {content.begin(), content.end()};
}

std::span<const std::uint8_t> Statement::bytes(int column) const {
  const auto* data = static_cast<const std::uint8_t*>(sqlite3_column_blob(statement_.get(), column));
  return {data, static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column))};
}

Result<Database> Database::open(const std::filesystem::path& path, Access access) {
  std::error_code unknown;
  const auto status = std::filesystem::status(path, unknown);
  if (std::filesystem::is_fifo(status) || std::filesystem::is_directory(status)) {  // SQLite waits for a pipe
    return failure(fmt::format("{}: is a {}, expected results of a campaign", path.string(),
                               std::filesystem::is_fifo(status) ? "pipe" : "folder"));
  }
  if (access != Access::create && status.type() == std::filesystem::file_type::not_found)
    return failure(fmt::format("{}: cannot be read ({}), expected results of a campaign", path.string(),
                               std::strerror(ENOENT)));
  int flags = SQLITE_OPEN_NOMUTEX;  // one thread at a time
  switch (access) {
    case Access::read:
      flags |= SQLITE_OPEN_READONLY;
      break;
    case Access::write:
      flags |= SQLITE_OPEN_READWRITE;
      break;
    case Access::create:
      flags |= SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
      break;
  }
  sqlite3* handle = nullptr;
  const int code = sqlite3_open_v2(path.c_str(), &handle, flags, nullptr);
  Database database(handle, path.string());
  if (code != SQLITE_OK) return complaint(database.file_, code, handle);
  sqlite3_extended_result_codes(handle, 0);
  return database;
}

Result<void> Database::run(const std::string& sql) {
  const int code = sqlite3_exec(handle_.get(), sql.c_str(), nullptr, nullptr, nullptr);
  if (code != SQLITE_OK) return complaint(file_, code, handle_.get());
  return {};
}

Result<Statement> Database::prepare(std::string_view sql) const {
  sqlite3_stmt* statement = nullptr;
  const int code =
      sqlite3_prepare_v2(handle_.get(), sql.data(), static_cast<int>(sql.size()), &statement, nullptr);
  if (code != SQLITE_OK) return complaint(file_, code, handle_.get());
  return Statement(statement, file_);
}

Result<void> Database::check_size() const {
  auto row = prepare("select page_count * page_size from pragma_page_count, pragma_page_size");
  if (!row) return tl::unexpected(row.error());
  if (const auto there = row->step(); !there) return tl::unexpected(there.error());
  std::error_code error;
  const auto found = std::filesystem::file_size(file_, error);
  const auto expected = static_cast<std::uintmax_t>(row->integer(0));
  if (error) return failure(fmt::format("{}: cannot be read or written: {}", file_, error.message()));
  if (found == expected) return {};
  return failure(fmt::format("{}: has {} bytes, expected the {} of its pages: the file is {}", file_, found,
                             expected, found < expected ? "cut off" : "damaged"));
}

Result<void> Database::close() {
  const int code = sqlite3_close(handle_.get());
  if (code != SQLITE_OK) return complaint(file_, code, handle_.get());
  static_cast<void>(handle_.release());
  return {};
}

}  // namespace canhil::campaign
