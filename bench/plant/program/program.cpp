#include "bench/plant/program/program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <tuple>
#include <utility>

#include "bench/plant/program/conversation.hpp"
#include "bench/processes/command.hpp"
#include "bench/scenario/commands.hpp"
#include "bench/scenario/section.hpp"
#include "bench/world/hash.hpp"
#include "dbc/files/text_file.hpp"
#include "dbc/text/escape.hpp"

namespace canhil::plant {
namespace {

using program_protocol::Declared;
using scenario::Limits;

class ProgramPlant final : public Plant {
 public:
  explicit ProgramPlant(std::unique_ptr<Conversation> conversation)
      : conversation_(std::move(conversation)) {}
  [[nodiscard]] std::span<const double> outputs() const override { return conversation_->outputs(); }
  Result<void> step(std::int64_t from_us, std::int64_t to_us, std::span<const double> inputs) override {
    return conversation_->step(from_us, to_us, inputs);
  }

 private:
  std::unique_ptr<Conversation> conversation_;
};

bool same(const std::vector<Variable>& a, const std::vector<Variable>& b) {
  const auto facts = [](const Variable& one) {
    return std::tie(one.name, one.si, one.turns, one.steps, one.start);
  };
  return std::ranges::equal(a, b, {}, facts, facts);
}

class ProgramPlan final : public Plan {
 public:
  ProgramPlan(const ProgramSettings& settings, const Declared& declared) : settings_(settings) {
    inputs = declared.inputs;
    outputs = declared.outputs;
  }
  [[nodiscard]] Result<std::unique_ptr<Plant>> make(const Draw& draw) const override {
    auto started = Conversation::start(settings_, draw);
    if (!started) return tl::unexpected(started.error());
    const Declared& now = (*started)->declared();
    if (!same(now.inputs, inputs) || !same(now.outputs, outputs))
      return failure(
          fmt::format("program '{}' at its start: declares other inputs or outputs than when the "
                      "scenario was read, expected the same",
                      one_line(settings_.command)));
    return std::make_unique<ProgramPlant>(*std::move(started));
  }

 private:
  ProgramSettings settings_;
};

std::vector<program_protocol::Parameter> read_parameters(scenario::Section& section) {
  std::vector<program_protocol::Parameter> parameters;
  auto table = section.optional_table(
      {"parameters",
       "Parameters of the program, NAME = number or text; it reads them before its first step."});
  if (!table) return parameters;
  for (const std::string& name : table->keys()) {
    constexpr std::string_view expected = "a name without blanks";
    if (name.empty() || name.find_first_of(" \t\r\n") != std::string::npos)
      table->reject(name, "is not a name", expected);
    if (table->holds_text(name))
      parameters.emplace_back(name, table->text(name));
    else
      parameters.emplace_back(name, table->plain_number(name, Limits{}));
  }
  table->finish();
  return parameters;
}

// The files that the command names belong to the scenario: a run with a changed program is another run.
void add_files(scenario::Section& section, const std::vector<std::string>& words) {
  constexpr std::size_t most_bytes = 256 * mebibyte;
  for (const std::string& word : words) {
    std::error_code ignored;
    const std::string path = section.beside(word);
    if (!std::filesystem::is_regular_file(path, ignored)) continue;
    const auto content = read_text_file(path, "a file of the program", most_bytes);
    if (!content) continue;
    section.files().push_back(path);
    std::uint64_t& hash = section.files_hash();
    hash = world::fnv1a_64(*content, hash == 0 ? world::fnv1a_64("") : hash);
  }
}

std::chrono::microseconds read_patience(scenario::Section& section, const scenario::Key& key,
                                        double usual_s) {
  constexpr double hour_s = 3600;
  return std::chrono::microseconds(section.time_us(key, Limits::above(0, hour_s), usual_s));
}

std::unique_ptr<Plan> read_program(scenario::Section& section) {
  ProgramSettings own;
  own.command = section.text({"command",
                              "The program and its arguments, as in a shell without variables and patterns. "
                              "It runs in the folder of the scenario file. It is also started when the "
                              "scenario is read, to ask for its inputs and outputs."});
  own.folder = section.beside("");
  own.starts_within = read_patience(
      section, {"starts_within_s", "Wall time in which the program must report its inputs and outputs."}, 30);
  own.answers_within = read_patience(
      section, {"answers_within_s", "Wall time in which the program must answer each step."}, 5);
  own.parameters = read_parameters(section);
  if (own.command.empty() || section.error()) return nullptr;
  auto words = processes::words_of(own.command);
  if (!words) {
    section.reject("command", words.error());
    return nullptr;
  }
  own.words = *std::move(words);
  add_files(section, own.words);
  const std::string what = fmt::format("is a program ('{}')", own.command);
  if (!scenario::may_execute(section, "command", what)) return nullptr;
  const auto started = Conversation::start(own, {});
  if (!started) {
    section.reject("command", started.error());
    return nullptr;
  }
  return std::make_unique<ProgramPlan>(own, (*started)->declared());
}

}  // namespace

constinit const Kind program{
    .key = "program",
    .meaning = "A program that reads commands and writes its state as lines of text.",
    .read = read_program};

}  // namespace canhil::plant
