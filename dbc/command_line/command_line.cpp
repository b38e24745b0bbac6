#include "dbc/command_line/command_line.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <sstream>
#include <utility>

namespace canhil::command_line {
namespace {

template <class Number>
Number read_number(const std::string& name, const std::string& text, Number least, Number most) {
  Number result = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), result);
  const bool whole = error == std::errc{} && end == text.data() + text.size();
  if (!whole || result < least || result > most) {
    throw CLI::ValidationError(name, "'" + text + "' is not a whole number from " + std::to_string(least) +
                                         " to " + std::to_string(most));
  }
  return result;
}

template <class Number>
CLI::Option* number(CLI::App& command, const std::string& name, std::optional<Number>& value,
                    const std::string& help, Number least, Number most) {
  const auto read = [&value, name, least, most](const std::string& text) {
    value = read_number(name, text, least, most);
  };
  return command.add_option_function<std::string>(name, read, help)->type_name("UINT");
}

std::string text_of(double value) {
  std::ostringstream text;
  text << value;
  return std::move(text).str();
}

void refuse_no_values_in(CLI::App& command) {
  const auto is_value = [](const std::string& text) {
    if (text.empty()) return std::string("is empty, expected a value");
    if (text.starts_with("--"))
      return "'" + text + "' looks like an option, expected a value (a file of that name: ./" + text + ")";
    return std::string();
  };
  for (CLI::Option* option : command.get_options()) option->check(is_value);
  for (CLI::App* below : command.get_subcommands(nullptr)) refuse_no_values_in(*below);
}

}  // namespace

Option Option::required() const { return Option(option_->required()); }
Option Option::needs(Option other) const { return Option(option_->needs(other.option_)); }
Option Option::excludes(Option other) const { return Option(option_->excludes(other.option_)); }
Option Option::one_word_each() const { return Option(option_->allow_extra_args(false)); }
Option Option::words(int count) const { return Option(option_->expected(count)); }
Option Option::one_of(std::vector<std::string> words) const {
  return Option(option_->check(CLI::IsMember(std::move(words))));
}
bool Option::given() const { return !option_->empty(); }

Option Command::add_option(const std::string& name, std::string& value, const std::string& help) const {
  return Option(command_->add_option(name, value, help));
}
Option Command::add_option(const std::string& name, std::vector<std::string>& value,
                           const std::string& help) const {
  return Option(command_->add_option(name, value, help));
}
Option Command::add_flag(const std::string& name, bool& value, const std::string& help) const {
  return Option(command_->add_flag(name, value, help));
}
Option Command::add_number(const std::string& name, std::optional<int>& value, const std::string& help,
                           int least, int most) const {
  return Option(number(*command_, name, value, help, least, most));
}
Option Command::add_number(const std::string& name, std::optional<std::uint64_t>& value,
                           const std::string& help, std::uint64_t least, std::uint64_t most) const {
  return Option(number(*command_, name, value, help, least, most));
}

Option Command::add_flag_or_number(const std::string& name, std::optional<int>& value,
                                   const std::string& help, int usual, int least, int most) const {
  // CLI11 passes this text if the user gives the option without a value.
  constexpr std::string_view missing = "true";
  const auto read = [&value, name, usual, least, most, missing](const std::string& text) {
    value = text.empty() || text == missing ? usual : read_number<int>(name, text, least, most);
  };
  return Option(
      command_->add_option_function<std::string>(name, read, help)->expected(0, 1)->type_name("[UINT]"));
}

Option Command::add_number(const std::string& name, double& value, const std::string& help, double least,
                           double most) const {
  const auto read = [&value, name, least, most](const std::string& text) {
    double result = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), result);
    const bool whole = error == std::errc{} && end == text.data() + text.size();
    if (!whole || !(result >= least && result <= most)) {
      throw CLI::ValidationError(
          name, "'" + text + "' is not a number from " + text_of(least) + " to " + text_of(most));
    }
    value = result;
  };
  return Option(command_->add_option_function<std::string>(name, read, help)->type_name("FLOAT"));
}

Command Command::add_subcommand(const std::string& name, const std::string& help) const {
  return Command(command_->add_subcommand(name, help));
}
void Command::require_subcommands(std::size_t least, std::size_t most) const {
  command_->require_subcommand(least, most);
}
void Command::on_given(std::function<void()> callback) const { command_->callback(std::move(callback)); }
bool Command::subcommand_given() const { return !command_->get_subcommands().empty(); }

std::string Command::name() const { return command_->get_name(); }
std::vector<Command> Command::subcommands() const {
  std::vector<Command> commands;
  for (CLI::App* command : command_->get_subcommands(nullptr)) commands.emplace_back(command);
  return commands;
}
std::vector<std::string> Command::long_options() const {
  std::vector<std::string> names;
  for (const CLI::Option* option : command_->get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

Program::Program(std::unique_ptr<CLI::App> app) : Command(app.get()), app_(std::move(app)) {}
Program::Program(const std::string& help) : Program(std::make_unique<CLI::App>(help)) {}
Program::Program(const std::string& help, const std::string& version) : Program(help) {
  app_->set_version_flag("--version", version);
}
Program::~Program() = default;

void Program::refuse_no_values() { refuse_no_values_in(*app_); }

Result<std::optional<int>> Program::parse(int argc, const char* const* argv) {
  try {
    app_->parse(argc, argv);
  } catch (const CLI::Success& asked) {
    return app_->exit(asked);
  } catch (const CLI::ParseError& error) {
    return failure(error.what());
  }
  return std::nullopt;
}

int finish(const char* program, int code) {
  constexpr int usage = 2;
  errno = 0;
  const bool flushed = std::fflush(stdout) == 0;
  if ((flushed && std::ferror(stdout) == 0) || code == usage) return code;
  std::fprintf(stderr, "%s: standard output: cannot be written%s%s\n", program, errno != 0 ? ": " : "",
               errno != 0 ? std::strerror(errno) : "");
  return usage;
}

void throw_required(const std::string& what) { throw CLI::RequiredError(what); }

}  // namespace canhil::command_line
