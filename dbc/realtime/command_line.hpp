// --realtime, --priority and --cpu, the same for both programs.
#pragma once

#include <CLI/CLI.hpp>
#include <charconv>
#include <optional>
#include <string>

#include "dbc/realtime/process.hpp"

namespace canhil::realtime {

/// Adds an option that takes a decimal whole number from `least` to `most`. Refused otherwise, in one line.
inline CLI::Option* add_number(CLI::App& app, const std::string& name, std::optional<int>& value, int least,
                               int most, const std::string& description) {
  const auto read = [&value, name, least, most](const std::string& text) {
    int number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{} || end != text.data() + text.size() || number < least || number > most) {
      throw CLI::ValidationError(name, "'" + text + "' is not a whole number from " + std::to_string(least) +
                                           " to " + std::to_string(most));
    }
    value = number;
  };
  return app.add_option_function<std::string>(name, read, description)->type_name("UINT");
}

/// Refuses '' as the value of any option or argument, also of subcommands. To be called when all are there.
inline void refuse_empty(CLI::App& app) {
  const auto not_empty = [](const std::string& text) {
    return text.empty() ? std::string("is empty, expected a value") : std::string();
  };
  for (CLI::Option* option : app.get_options()) option->check(not_empty);
  for (CLI::App* command : app.get_subcommands(nullptr)) refuse_empty(*command);
}

/// As typed.
struct Options {
  bool wanted = false;
  std::optional<int> priority;
  std::optional<int> cpu;

  /// What to enter() with; none without --realtime.
  [[nodiscard]] std::optional<Request> request() const {
    if (!wanted) return std::nullopt;
    return Request{.priority = priority.value_or(default_priority), .cpu = cpu};
  }
};

/// Adds the options; `options` must outlive the command. Returns --realtime.
inline CLI::Option* add_options(CLI::App& app, Options& options) {
  CLI::Option* realtime = app.add_flag(
      "--realtime", options.wanted,
      "run under SCHED_FIFO with all memory locked; refused with the remedy where not permitted");
  add_number(app, "--priority", options.priority, 1, 99,
             "of --realtime (default " + std::to_string(default_priority) + ")")
      ->needs(realtime);
  add_number(app, "--cpu", options.cpu, 0, 1023, "the only CPU to run on, with --realtime")->needs(realtime);
  return realtime;
}

}  // namespace canhil::realtime
