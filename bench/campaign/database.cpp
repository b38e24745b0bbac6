#include "bench/campaign/database.hpp"

#include <fmt/format.h>
#include <sqlite3.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "dbc/files/text_file.hpp"

namespace canhil::campaign {
namespace {

// The samples of a run are one value. For comparison: 500 answers a second with ten values of eight bytes,
// for an hour, have 137 MiB.
constexpr int most_bytes_of_a_value = 256 << 20;

// The tables, views, indices and triggers of a database, each with its definition.
std::vector<std::string> schema_of(const SQLite::Database& database) {
  std::vector<std::string> all;
  SQLite::Statement row(database, "select type, name, coalesce(sql, '') from sqlite_master order by name");
  while (row.executeStep())
    all.push_back(fmt::format("{} {} {}", row.getColumn(0).getString(), row.getColumn(1).getString(),
                              row.getColumn(2).getString()));
  return all;
}

// Returns the errno of the failed system call; 0 if it is unknown. Some messages of SQLite do not contain the
// errno.
int reason_of(int code, const std::string& file, sqlite3* database) {
  int reason = 0;
  if (code == SQLITE_IOERR) sqlite3_file_control(database, "main", SQLITE_FCNTL_LAST_ERRNO, &reason);
  if (code == SQLITE_CANTOPEN) {  // SQLite then retries read-only, and its errno is of this retry
    const std::filesystem::path path = std::filesystem::absolute(file);
    const bool there = std::filesystem::exists(std::filesystem::symlink_status(path));
    if (access((there ? path : path.parent_path()).c_str(), W_OK) != 0) reason = errno;
  }
  return reason;
}

}  // namespace

Error in_words(const SQLite::Exception& error, const std::string& file, sqlite3* database) {
  const int code = error.getErrorCode() & 0xFF;
  if (code == SQLITE_BUSY) return {fmt::format("{}: is in use by another program", file)};
  if (code == SQLITE_TOOBIG)
    return {fmt::format("{}: a value is larger than {} MiB, expected results of a campaign", file,
                        most_bytes_of_a_value / static_cast<int>(mebibyte))};
  if (code == SQLITE_NOTADB)
    return {fmt::format("{}: is not an SQLite file, expected results of a campaign", file)};
  const int reason = reason_of(code, file, database);
  return {fmt::format("{}: cannot be read or written: {}{}", file, error.what(),
                      reason == 0 ? "" : fmt::format(" ({})", std::strerror(reason)))};
}

Result<SQLite::Database> open_database(const std::filesystem::path& path, int flags) {
  std::error_code unknown;
  const auto status = std::filesystem::status(path, unknown);
  if (std::filesystem::is_fifo(status) ||
      std::filesystem::is_directory(status)) {  // opening a pipe would block the program
    return failure(fmt::format("{}: is a {}, expected results of a campaign", path.string(),
                               std::filesystem::is_fifo(status) ? "pipe" : "folder"));
  }
  if ((flags & SQLite::OPEN_CREATE) == 0 && status.type() == std::filesystem::file_type::not_found)
    return failure(fmt::format("{}: cannot be read ({}), expected results of a campaign", path.string(),
                               std::strerror(ENOENT)));
  try {
    SQLite::Database database(path.string(),
                              flags | SQLite::OPEN_NOMUTEX);  // only one thread at a time uses the database
    sqlite3_limit(database.getHandle(), SQLITE_LIMIT_LENGTH, most_bytes_of_a_value);
    sqlite3_db_config(database.getHandle(), SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
    return Result<SQLite::Database>(std::move(database));
  } catch (const SQLite::Exception& error) {
    return tl::unexpected(in_words(error, path.string(), nullptr));
  }
}

void check_size(const SQLite::Database& database) {
  SQLite::Statement row(database, "select page_count * page_size from pragma_page_count, pragma_page_size");
  row.executeStep();
  std::error_code error;
  const auto found = std::filesystem::file_size(database.getFilename(), error);
  const auto expected = static_cast<std::uintmax_t>(row.getColumn(0).getInt64());
  if (error) throw Unfit("cannot be read or written: " + error.message());
  if (found == expected) return;
  throw Unfit(fmt::format("has {} bytes, expected the {} of its pages: the file is {}", found, expected,
                          found < expected ? "cut off" : "damaged"));
}

void check_schema(const SQLite::Database& database, const std::string& schema) {
  SQLite::Database expected(":memory:", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
  expected.exec(schema);
  if (schema_of(database) != schema_of(expected))
    throw Unfit("has other tables or views than results of a campaign, expected those alone");
}

}  // namespace canhil::campaign
