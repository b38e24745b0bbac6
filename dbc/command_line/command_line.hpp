// The command line of all programs. This header hides CLI11, which takes seconds to compile: only
// command_line.cpp includes it.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dbc/wire/result.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace canhil::command_line {

/// An option or argument. The command owns it.
class Option {
 public:
  explicit Option(CLI::Option* option) : option_(option) {}

  Option required() const;
  Option needs(Option other) const;
  Option excludes(Option other) const;
  /// Each occurrence takes exactly one value; later words remain arguments.
  Option one_word_each() const;
  /// Takes exactly `count` values.
  Option words(int count) const;
  Option one_of(std::vector<std::string> words) const;
  /// Valid only after parsing.
  [[nodiscard]] bool given() const;

 private:
  CLI::Option* option_;
};

/// A program or one of its subcommands. The Program owns it. Variables that options write to must outlive
/// parsing.
class Command {
 public:
  explicit Command(CLI::App* command) : command_(command) {}

  /// "--name", "-n,--name", or "NAME": an argument.
  Option add_option(const std::string& name, std::string& value, const std::string& help) const;
  Option add_option(const std::string& name, std::vector<std::string>& value, const std::string& help) const;
  Option add_flag(const std::string& name, bool& value, const std::string& help) const;

  /// A decimal whole number from `least` to `most`; anything else is rejected with one line. CLI11's own
  /// parser follows strtoull: it reads -1 as a large number and 010 as eight, and clips large numbers.
  Option add_number(const std::string& name, std::optional<int>& value, const std::string& help, int least,
                    int most) const;
  Option add_number(const std::string& name, std::optional<std::uint64_t>& value, const std::string& help,
                    std::uint64_t least = 0,
                    std::uint64_t most = std::numeric_limits<std::uint64_t>::max()) const;
  /// A flag that a whole number from `least` to `most` may follow; without a number the value is `usual`.
  Option add_flag_or_number(const std::string& name, std::optional<int>& value, const std::string& help,
                            int usual, int least, int most) const;
  /// A decimal number from `least` to `most`; "nan" is rejected.
  Option add_number(const std::string& name, double& value, const std::string& help, double least,
                    double most) const;

  Command add_subcommand(const std::string& name, const std::string& help) const;
  void require_subcommands(std::size_t least, std::size_t most) const;
  /// Sets a callback that runs at the end of parsing if this command was given. Callbacks of subcommands run
  /// first.
  void on_given(std::function<void()> callback) const;

  /// Valid only after parsing.
  [[nodiscard]] bool subcommand_given() const;

  [[nodiscard]] std::string name() const;
  [[nodiscard]] std::vector<Command> subcommands() const;
  /// "--json", "--help" and so on.
  [[nodiscard]] std::vector<std::string> long_options() const;

 private:
  CLI::App* command_;
};

class Program : public Command {
 public:
  explicit Program(const std::string& help);
  Program(const std::string& help, const std::string& version);  // with --version
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  /// Makes every option and argument, including those of subcommands, reject '' and words that begin with
  /// "--" as its value. Call it after adding all options, arguments and subcommands.
  void refuse_no_values();

  /// Error: what was wrong, in one line. An exit code if help or the version was requested and printed.
  Result<std::optional<int>> parse(int argc, const char* const* argv);

 private:
  explicit Program(std::unique_ptr<CLI::App> app);

  std::unique_ptr<CLI::App> app_;
};

/// Replaces control characters in a message by '?': file names may contain line breaks and escape sequences.
std::string one_line(std::string message);

/// The exit code of a program that ends with `code`. If writing to standard output failed, prints a line on
/// stderr and returns 2. If `code` is 2, the program has printed its error line already.
int finish(const char* program, int code);

/// For callbacks: ends parsing with the error "WHAT is required".
[[noreturn]] void throw_required(const std::string& what);

}  // namespace canhil::command_line
