// A file of SQLite that a user named: what is wrong with it, in one line.
#pragma once

#include <SQLiteCpp/Database.h>

#include <filesystem>
#include <stdexcept>
#include <string>

#include "dbc/wire/result.hpp"

namespace canhil::campaign {

/// What SQLite does not mind is wrong with a file: in words, without its name.
struct Unfit : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// `flags`: those of SQLite::Database.
Result<SQLite::Database> open_database(const std::filesystem::path& path, int flags);

/// Unfit: the file has not the size that it says it has: its end is missing, or it grew.
void check_size(const SQLite::Database& database);

/// In words, what SQLite said of a file; `database`: null where it could not be opened.
Error in_words(const SQLite::Exception& error, const std::string& file, sqlite3* database);

/// What `work` on an open file gives: exceptions end here.
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
