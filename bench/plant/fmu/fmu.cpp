#include "bench/plant/fmu/fmu.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <utility>

#include "bench/plant/fmu/plan.hpp"
#include "bench/plant/fmu/presets.hpp"
#include "bench/scenario/commands.hpp"
#include "bench/scenario/section.hpp"

namespace canhil::plant {
namespace {

using namespace fmu;
using scenario::Limits;
using scenario::Section;

/// An FMU's file, and what the bench needs of it.
struct File {
  Archive archive;
  ModelDescription description;
  std::string binary;  ///< path of the platform's binary in the archive
};

/// The folder of binaries for the machine that this program was compiled for.
std::string platform_folder(std::int32_t version) {
#if defined(__x86_64__)
  return version == 2 ? "linux64" : "x86_64-linux";
#elif defined(__aarch64__)
  static_cast<void>(version);  // FMI 2.0 has no name of its own
  return "aarch64-linux";
#else
#error "expected x86_64 or aarch64: add the name of the platform from FMI 3.0, section 2.5.1.4"
#endif
}

/// The path of the platform's binary in the archive. Error, one phrase: there is none.
Result<std::string> binary_in(const Archive& archive, const ModelDescription& description) {
  const std::string wanted =
      fmt::format("binaries/{}/{}.so", platform_folder(description.version), description.identifier);
  if (archive.has(wanted)) return wanted;
  constexpr std::string_view binaries = "binaries/";
  std::vector<std::string> platforms;
  for (const std::string& name : archive.names()) {
    const auto slash = name.find('/', binaries.size());
    if (!name.starts_with(binaries) || slash == std::string::npos) continue;
    std::string platform = name.substr(binaries.size(), slash - binaries.size());
    if (std::ranges::find(platforms, platform) == platforms.end()) platforms.push_back(std::move(platform));
  }
  const std::string others = platforms.empty()
                                 ? "has no binary"
                                 : fmt::format("has binaries for {} alone", fmt::join(platforms, ", "));
  return failure(fmt::format("{}, expected {}", others, wanted));
}

void add_variables(const std::vector<Sized>& all, FmuSettings& settings, std::vector<Variable>& inputs,
                   std::vector<Variable>& outputs) {
  for (const Sized& one : all) {
    const DescribedVariable& variable = *one.variable;
    const bool input = variable.causality == Causality::input;
    if (variable.type == Type::string || (!input && variable.causality != Causality::output)) continue;
    (input ? settings.setup.inputs : settings.setup.outputs).push_back(one.place());
    for (std::uint32_t i = 0; i < one.count(); ++i) {
      const Element element{.name = one.name(i), .type = variable.type, .conversion = variable.conversion};
      double start = 0;
      if (input && i < one.start.size())
        start = std::holds_alternative<double>(one.start[i])
                    ? std::get<double>(one.start[i])
                    : static_cast<double>(std::get<std::int64_t>(one.start[i]));
      const std::string& si = variable.conversion.si;
      (input ? inputs : outputs)
          .push_back({.name = element.name,
                      .si = si,
                      .turns = si == "rad" && element.name.starts_with("attitude."),
                      .steps = variable.steps,
                      .start = element.to_si(start)});
      (input ? settings.inputs : settings.outputs).push_back(element);
      if (input) settings.setup.starts.push_back(start);
    }
  }
}

void add_presets(const std::vector<Sized>& all, fmu::Setup& setup) {
  for (const Sized& one : all) {
    if (!one.set || one.variable->causality == Causality::input) continue;
    (one.variable->causality == Causality::structural_parameter ? setup.structure : setup.parameters)
        .push_back({.place = one.place(), .values = one.start});
  }
}

Result<File> open_file(std::string content) {
  constexpr std::size_t most_xml_bytes = std::size_t{64} << 20U;
  auto archive = Archive::open(std::move(content));
  if (!archive) return tl::unexpected(archive.error());
  const auto xml = archive->read("modelDescription.xml", most_xml_bytes);
  if (!xml) return tl::unexpected(xml.error());
  auto description = read_description(*xml);
  if (!description) return tl::unexpected(description.error());
  auto binary = binary_in(*archive, *description);
  if (!binary) return tl::unexpected(binary.error());
  return File{std::move(*archive), std::move(*description), std::move(*binary)};
}

/// The step of the FMU [us]; none: it has no step that the bench can take.
std::optional<std::int64_t> own_step_us(const ModelDescription& description) {
  constexpr double longest_s = 3600;
  if (description.step_s > longest_s || description.step_s < 1e-6) return std::nullopt;
  return std::llround(description.step_s * 1e6);
}

std::unique_ptr<Plan> read_plan(Section& section) {
  FmuSettings own;
  auto content = section.read_beside({"file", "The FMU for co-simulation, FMI 2.0 or 3.0."}, "an FMU",
                                     most_packed_bytes);
  auto parameters = section.optional_table({"parameters", "Parameters and start values of the FMU."});
  own.in_process = section.flag({"in_process", "Whether the FMU runs in the bench's own process."});
  constexpr double usual_patience_s = 5, longest_patience_s = 3600;
  own.patience = std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::microseconds(
      section.time_us({"answers_within_s", "Longest wall time for a step of the FMU, and for its start."},
                      Limits::between(0.001, longest_patience_s), usual_patience_s)));
  own.setup.log = section.flag({"log", "Whether the messages of the FMU go to standard error."});
  if (!content || !scenario::may_execute(section, "file", "is an FMU, whose code would be executed"))
    return std::make_unique<FmuPlan>(own, Archive());
  own.setup.fmu = std::filesystem::path(section.files().back()).filename().string();
  auto file = open_file(std::move(*content));
  if (!file) {
    section.reject("file", Error{fmt::format("{}: {}", own.setup.fmu, file.error().message)});
    return std::make_unique<FmuPlan>(own, Archive());
  }
  const ModelDescription& description = file->description;
  if (own.in_process && description.once_per_process)
    section.reject("in_process", "is true, but the FMU can be instantiated only once per process",
                   "a process of its own (false)");
  own.setup.version = description.version;
  own.setup.token = description.token;
  own.setup.library = file->binary;
  own.setup.tolerance = description.tolerance;
  own.step_may_vary = description.step_may_vary;
  own.internal_step_s = description.internal_step_s;
  const std::vector<Sized> variables = read_presets(section, parameters, description);
  add_presets(variables, own.setup);
  std::vector<Variable> inputs, outputs;
  add_variables(variables, own, inputs, outputs);
  auto plan = std::make_unique<FmuPlan>(std::move(own), std::move(file->archive));
  plan->inputs = std::move(inputs);
  plan->outputs = std::move(outputs);
  plan->step_us = own_step_us(description).value_or(plan->step_us);
  return plan;
}

}  // namespace

constinit const Kind fmu_plant{
    .key = "fmu",
    .meaning = "An FMU for co-simulation (FMI 2.0 or 3.0): a model that another tool exported.",
    .read = read_plan};

}  // namespace canhil::plant
