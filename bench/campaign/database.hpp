// SQLite with values: errors are Results, handles close themselves.
#pragma once

#include <sqlite3.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "dbc/wire/result.hpp"

namespace canhil::campaign {

/// A prepared statement. Errors of binding show in step().
class Statement {
 public:
  Statement& bind(int place, std::int64_t value);
  Statement& bind(int place, std::string_view text);
  Statement& bind(int place, std::span<const std::uint8_t> bytes);
  /// Runs to the next row; false: there is none. Error: one line.
  Result<bool> step();
  /// Makes it ready for the next values.
  void reset();

  // Columns of the row that step() has reached, from 0.
  [[nodiscard]] std::int64_t integer(int column) const;
  [[nodiscard]] std::string text(int column) const;
  [[nodiscard]] std::span<const std::uint8_t> bytes(int column) const;  ///< until the next step
  [[nodiscard]] const std::string& file() const { return file_; }

 private:
  friend class Database;
  struct Finalise {
    void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
  };
  Statement(sqlite3_stmt* statement, std::string file) : statement_(statement), file_(std::move(file)) {}

  std::unique_ptr<sqlite3_stmt, Finalise> statement_;
  std::string file_;
};

/// An open file.
class Database {
 public:
  enum class Access : std::uint8_t { read, write, create };
  static Result<Database> open(const std::filesystem::path& path, Access access);

  /// Statements without values or rows.
  Result<void> run(const std::string& sql);
  [[nodiscard]] Result<Statement> prepare(std::string_view sql) const;
  /// Error: the file has not the size that it says it has: its end is missing, or it grew.
  [[nodiscard]] Result<void> check_size() const;
  Result<void> close();
  [[nodiscard]] const std::string& file() const { return file_; }

 private:
  struct Close {
    void operator()(sqlite3* handle) const { sqlite3_close_v2(handle); }
  };
  Database(sqlite3* handle, std::string file) : handle_(handle), file_(std::move(file)) {}

  std::unique_ptr<sqlite3, Close> handle_;
  std::string file_;
};

}  // namespace canhil::campaign
