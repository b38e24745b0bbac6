// The command line of our programs. CLI11 does the work, behind this header: it takes seconds to compile,
// once here.
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

/// An option or argument of a command, which owns it.
class Option {
 public:
  explicit Option(CLI::Option* option) : option_(option) {}

  Option required() const;
  Option needs(Option other) const;
  Option excludes(Option other) const;
  /// Each time it is given it takes one word, and leaves those after it to the arguments.
  Option one_word_each() const;
  /// Takes exactly so many words.
  Option words(int count) const;
  Option one_of(std::vector<std::string> words) const;
  /// After parsing.
  [[nodiscard]] bool given() const;

 private:
  CLI::Option* option_;
};

/// A program or a subcommand of one, owned by the Program. Values that options write to must outlive parsing.
class Command {
 public:
  explicit Command(CLI::App* command) : command_(command) {}

  /// "--name", "-n,--name", or "NAME": an argument.
  Option add_option(const std::string& name, std::string& value, const std::string& help) const;
  Option add_option(const std::string& name, std::vector<std::string>& value, const std::string& help) const;
  Option add_flag(const std::string& name, bool& value, const std::string& help) const;

  /// A decimal whole number from `least` to `most`. Refused otherwise, in one line: CLI11 itself reads whole
  /// numbers as strtoull does, where -1 is a large number, 010 is eight, and what is too large is the
  /// largest.
  Option add_number(const std::string& name, std::optional<int>& value, const std::string& help, int least,
                    int most) const;
  Option add_number(const std::string& name, std::optional<std::uint64_t>& value, const std::string& help,
                    std::uint64_t least = 0,
                    std::uint64_t most = std::numeric_limits<std::uint64_t>::max()) const;
  /// A flag that may have such a number: `usual` where it has none.
  Option add_flag_or_number(const std::string& name, std::optional<int>& value, const std::string& help,
                            int usual, int least, int most) const;
  /// A decimal number from `least` to `most`: "nan" is none.
  Option add_number(const std::string& name, double& value, const std::string& help, double least,
                    double most) const;

  Command add_subcommand(const std::string& name, const std::string& help) const;
  void require_subcommands(std::size_t least, std::size_t most) const;
  /// Called at the end of parsing if this command was given. Its subcommands' are called first.
  void on_given(std::function<void()> callback) const;

  /// After parsing.
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

  /// Refuses '' as the value of any option or argument, also of subcommands. To be called when all are there.
  void refuse_no_values();

  /// What was wrong, in a line; or the exit code where help or the version was asked for, and printed.
  Result<std::optional<int>> parse(int argc, const char* const* argv);

 private:
  explicit Program(std::unique_ptr<CLI::App> app);

  std::unique_ptr<CLI::App> app_;
};

/// A message with '?' for what would break its line or steer a terminal: names of files may hold anything.
std::string one_line(std::string message);

/// The exit code of a program that ends with `code`: 2, with a line on stderr, if standard output did not
/// take all that was printed. Nothing is added to 2, which has its line.
int finish(const char* program, int code);

/// Ends parsing from a callback: "WHAT is required".
[[noreturn]] void throw_required(const std::string& what);

}  // namespace canhil::command_line
