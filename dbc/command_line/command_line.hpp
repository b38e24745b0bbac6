// The command line of all programs. This header hides CLI11, which takes seconds to compile. Only
// command_line.cpp includes CLI11.
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

/// An option or argument of a command. The Command owns the underlying CLI11 object.
class Option {
 public:
  explicit Option(CLI::Option* option) : option_(option) {}

  Option required() const;
  Option needs(Option other) const;
  Option excludes(Option other) const;
  /// Each occurrence of the option has exactly one value. The words after that value are arguments of the
  /// command.
  Option one_word_each() const;
  /// The option has exactly `count` values.
  Option words(int count) const;
  Option one_of(std::vector<std::string> words) const;
  /// May be called only after parsing.
  [[nodiscard]] bool given() const;

 private:
  CLI::Option* option_;
};

/// A program or one of its subcommands. The Program owns the underlying CLI11 object. The variables to which
/// options write must exist until parsing has ended.
class Command {
 public:
  explicit Command(CLI::App* command) : command_(command) {}

  /// `name` is "--name" or "-n,--name" for an option, "NAME" for an argument.
  Option add_option(const std::string& name, std::string& value, const std::string& help) const;
  Option add_option(const std::string& name, std::vector<std::string>& value, const std::string& help) const;
  Option add_flag(const std::string& name, bool& value, const std::string& help) const;

  /// The value must be a decimal whole number from `least` to `most`; any other value is rejected with an
  /// error of one line. CLI11's own parser is not used, because it follows strtoull: it reads -1 as a large
  /// number and 010 as eight, and clips large numbers.
  Option add_number(const std::string& name, std::optional<int>& value, const std::string& help, int least,
                    int most) const;
  Option add_number(const std::string& name, std::optional<std::uint64_t>& value, const std::string& help,
                    std::uint64_t least = 0,
                    std::uint64_t most = std::numeric_limits<std::uint64_t>::max()) const;
  /// A flag after which a whole number from `least` to `most` may follow. If no number follows, the value is
  /// `usual`.
  Option add_flag_or_number(const std::string& name, std::optional<int>& value, const std::string& help,
                            int usual, int least, int most) const;
  /// The value must be a decimal number from `least` to `most`; "nan" is rejected.
  Option add_number(const std::string& name, double& value, const std::string& help, double least,
                    double most) const;

  Command add_subcommand(const std::string& name, const std::string& help) const;
  void require_subcommands(std::size_t least, std::size_t most) const;
  /// Sets a callback that runs at the end of parsing if the user gave this command. The callbacks of
  /// subcommands run before this callback.
  void on_given(std::function<void()> callback) const;

  /// May be called only after parsing.
  [[nodiscard]] bool subcommand_given() const;

  [[nodiscard]] std::string name() const;
  [[nodiscard]] std::vector<Command> subcommands() const;
  /// The names of the options, such as "--json" and "--help".
  [[nodiscard]] std::vector<std::string> long_options() const;

 private:
  CLI::App* command_;
};

class Program : public Command {
 public:
  explicit Program(const std::string& help);
  Program(const std::string& help, const std::string& version);  // adds the option --version
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  /// Makes every option and argument, including those of subcommands, reject two kinds of values: the empty
  /// string and words that begin with "--". Call refuse_no_values() after all options, arguments and
  /// subcommands have been added.
  void refuse_no_values();

  /// Parses the command line. The error is one line that states what was wrong. If the user requested help or
  /// the version, prints it and returns an exit code.
  Result<std::optional<int>> parse(int argc, const char* const* argv);

 private:
  explicit Program(std::unique_ptr<CLI::App> app);

  std::unique_ptr<CLI::App> app_;
};

/// Returns the exit code of a program that ends with `code`. If writing to standard output failed, prints a
/// line on stderr and returns 2. It prints no line if `code` is 2, because the program has then printed an
/// error line already.
int finish(const char* program, int code);

/// Ends parsing with the error "WHAT is required". May be called by callbacks of on_given().
[[noreturn]] void throw_required(const std::string& what);

}  // namespace canhil::command_line
