#include "bench/plant/program.hpp"

#include <fmt/format.h>

#include <utility>

#include "bench/processes/conversation.hpp"
#include "bench/scenario/program.hpp"
#include "bench/scenario/section.hpp"
#include "dbc/text/escape.hpp"

namespace canhil::plant {
namespace {

using processes::Conversation;
using processes::ProgramSettings;
using processes::program_protocol::Declared;

constexpr std::string_view role = "plant";

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

class ProgramPlan final : public Plan {
 public:
  ProgramPlan(const ProgramSettings& settings, const Declared& declared) : settings_(settings) {
    inputs = declared.inputs;
    outputs = declared.outputs;
  }
  [[nodiscard]] Result<std::unique_ptr<Plant>> make(const Draw& draw) const override {
    auto started =
        Conversation::start(settings_, {.role = role, .seed = draw.seed, .run_index = draw.run_index});
    if (!started) return tl::unexpected(started.error());
    const Declared& now = (*started)->declared();
    if (now.inputs != inputs || now.outputs != outputs)
      return failure(
          fmt::format("program '{}' at its start: declares other inputs or outputs than when the "
                      "scenario was read, expected the same",
                      one_line(settings_.command)));
    return std::make_unique<ProgramPlant>(*std::move(started));
  }

 private:
  ProgramSettings settings_;
};

std::unique_ptr<Plan> read_program(scenario::Section& section) {
  const auto own = scenario::read_program(section);
  if (!own) return nullptr;
  const auto started = Conversation::start(*own, {.role = role});
  if (!started) {
    section.reject("command", started.error());
    return nullptr;
  }
  return std::make_unique<ProgramPlan>(*own, (*started)->declared());
}

}  // namespace

constinit const Kind program{
    .key = "program",
    .meaning = "A program that reads commands and writes its state as lines of text.",
    .read = read_program};

}  // namespace canhil::plant
