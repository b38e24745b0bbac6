// Opens SQLite files that a user names, and describes a defect of such a file in one line.
#pragma once

#include <SQLiteCpp/Database.h>

#include <filesystem>
#include <stdexcept>
#include <string>

#include "dbc/wire/result.hpp"

namespace canhil::campaign {

/// Thrown if a file has a defect that SQLite does not detect. The text is the reason, without the name of the
/// file.
struct Unfit : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// `flags`: the flags of the constructor of SQLite::Database. A value of the file can have at most 256 MiB.
Result<SQLite::Database> open_database(const std::filesystem::path& path, int flags);

/// Throws Unfit if the file is shorter or longer than its header states.
void check_size(const SQLite::Database& database);

/// Throws Unfit if the file has other tables than `schema` creates, or views, triggers or indices: a query on
/// them could run without end.
void check_schema(const SQLite::Database& database, const std::string& schema);

/// Returns SQLite's error as text. `database`: null if the file could not be opened.
Error in_words(const SQLite::Exception& error, const std::string& file, sqlite3* database);

/// Runs `work` on an open file and turns the exceptions of `work` into an Error.
template <class Work>
auto attempt(const SQLite::Database& database, const Work& work) -> Result<decltype(work())> {
  try {
    return Result<void>().map(work);
  } catch (const SQLite::Exception& error) {
    return tl::unexpected(in_words(error, database.getFilename(), database.getHandle()));
  } catch (const Unfit& error) {
    return failure(database.getFilename() + ": " + error.what());
  }
}

}  // namespace canhil::campaign
