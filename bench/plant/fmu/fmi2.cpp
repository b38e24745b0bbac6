// The life cycle of an FMU of FMI 2.0 (FMI 2.0.5, section 4.2.4).
#include <fmt/format.h>

#include <array>
#include <cctype>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "bench/plant/fmu/binary.hpp"
#include "bench/plant/fmu/here.hpp"

namespace canhil::plant::fmu {
namespace {

using namespace standard;

// The logger's message is a format of printf, with its arguments after it.
void log_formatted(Environment environment, const char* /*instance*/, int status, const char* category,
                   const char* message, ...) {
  std::va_list arguments;
  va_start(arguments, message);
  std::array<char, 1000> text{};
  // NOLINTNEXTLINE(clang-analyzer-valist.Uninitialized): it does not see that va_start() initialises a
  // va_list
  if (message != nullptr) std::vsnprintf(text.data(), text.size(), message, arguments);
  va_end(arguments);
  static_cast<Journal*>(environment)->add(status, category, text.data());
}

/// The folder of resources as a URI (RFC 8089).
std::string resources_uri(const std::string& folder) {
  constexpr std::string_view plain = "/-._~";
  std::string uri = "file://";
  for (const char c : folder + "/resources") {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) != 0 || plain.find(c) != std::string_view::npos)
      uri += c;
    else
      uri += fmt::format("%{:02X}", byte);
  }
  return uri;
}

class Fmi2 final : public Running {
 public:
  explicit Fmi2(const Setup& setup, Binary binary)
      : setup_(setup), binary_(std::move(binary)), journal_(setup.fmu, setup.log) {}
  ~Fmi2() override {
    if (instance_ == nullptr || !journal_.may_free()) return;
    if (initialized_ && journal_.may_terminate()) terminate_(instance_);
    free_(instance_);
  }

  Result<void> find_functions() {
    std::string missing;
    const auto find = [&]<class F>(F*& function, const char* name) {
      function = binary_.function<F>(name, missing);
    };
    find(instantiate_, "fmi2Instantiate");
    find(free_, "fmi2FreeInstance");
    find(setup_experiment_, "fmi2SetupExperiment");
    find(enter_, "fmi2EnterInitializationMode");
    find(exit_, "fmi2ExitInitializationMode");
    find(terminate_, "fmi2Terminate");
    find(do_step_, "fmi2DoStep");
    find(get_boolean_status_, "fmi2GetBooleanStatus");
    find(set_real_, "fmi2SetReal");
    find(set_integer_, "fmi2SetInteger");
    find(set_boolean_, "fmi2SetBoolean");
    find(set_string_, "fmi2SetString");
    find(get_real_, "fmi2GetReal");
    find(get_integer_, "fmi2GetInteger");
    find(get_boolean_, "fmi2GetBoolean");
    if (missing.empty()) return {};
    return failure(fmt::format("its binary has no function {}, expected those of FMI 2.0", missing));
  }

  Result<void> start(std::span<double> outputs) {
    const std::string resources = resources_uri(setup_.folder);
    instance_ = instantiate_(setup_.fmu.c_str(), fmi2::co_simulation, setup_.token.c_str(), resources.c_str(),
                             &callbacks_, 0, setup_.log ? 1 : 0);
    if (instance_ == nullptr) return journal_.failed("fmi2Instantiate", "returned no instance");
    for (const Preset& preset : setup_.parameters) {
      if (!journal_.accepts(set_preset(preset)))
        return journal_.failed(fmt::format("setting '{}'", preset.place.name));
    }
    const bool with_tolerance = setup_.tolerance > 0;
    if (!journal_.accepts(setup_experiment_(instance_, int{with_tolerance}, setup_.tolerance, 0, 0, 0)))
      return journal_.failed("fmi2SetupExperiment");
    if (!journal_.accepts(enter_(instance_))) return journal_.failed("fmi2EnterInitializationMode");
    if (auto set = set_inputs(setup_.starts); !set) return set;
    if (!journal_.accepts(exit_(instance_))) return journal_.failed("fmi2ExitInitializationMode");
    initialized_ = true;
    return get_outputs(outputs);
  }

  Result<void> step(double from_s, double step_s, std::span<const double> inputs,
                    std::span<double> outputs) override {
    if (auto set = set_inputs(inputs); !set) return set;
    const int status = do_step_(instance_, from_s, step_s, 1);
    fmi2::Boolean ends = 0;
    if (!journal_.accepts(status)) {
      const bool asked = status == discard && get_boolean_status_(instance_, fmi2::terminated, &ends) == ok;
      return asked && ends != 0 ? journal_.failed("fmi2DoStep", "asked for the end of the simulation")
                                : journal_.failed("fmi2DoStep");
    }
    return get_outputs(outputs);
  }

 private:
  int set(const Place& place, double value) {
    if (place.type == Type::float64) return set_real_(instance_, &place.reference, 1, &value);
    const int whole = static_cast<int>(value);
    return (place.type == Type::boolean ? set_boolean_ : set_integer_)(instance_, &place.reference, 1,
                                                                       &whole);
  }
  int set_preset(const Preset& preset) {
    const Value& value = preset.values.front();
    if (const auto* real = std::get_if<double>(&value)) return set(preset.place, *real);
    if (const auto* whole = std::get_if<std::int64_t>(&value))
      return set(preset.place, static_cast<double>(*whole));
    const char* text = std::get<std::string>(value).c_str();
    return set_string_(instance_, &preset.place.reference, 1, &text);
  }
  Result<void> set_inputs(std::span<const double> values) {
    for (std::size_t i = 0; i < setup_.inputs.size(); ++i) {
      if (!journal_.accepts(set(setup_.inputs[i], values[i])))
        return journal_.failed(fmt::format("setting '{}'", setup_.inputs[i].name));
    }
    return {};
  }
  int get(const Place& place, double& value) {
    if (place.type == Type::float64) return get_real_(instance_, &place.reference, 1, &value);
    int whole = 0;
    const bool boolean = place.type == Type::boolean;
    const int status = (boolean ? get_boolean_ : get_integer_)(instance_, &place.reference, 1, &whole);
    value = boolean ? static_cast<double>(whole != 0) : whole;
    return status;
  }
  Result<void> get_outputs(std::span<double> values) {
    for (std::size_t i = 0; i < setup_.outputs.size(); ++i) {
      if (!journal_.accepts(get(setup_.outputs[i], values[i])))
        return journal_.failed(fmt::format("reading '{}'", setup_.outputs[i].name));
    }
    return {};
  }

  Setup setup_;
  Binary binary_;
  Journal journal_;
  fmi2::Callbacks callbacks_{log_formatted, std::calloc, std::free, nullptr, &journal_};
  Instance instance_ = nullptr;
  bool initialized_ = false;

  fmi2::Instantiate* instantiate_ = nullptr;
  Free* free_ = nullptr;
  fmi2::SetupExperiment* setup_experiment_ = nullptr;
  Change *enter_ = nullptr, *exit_ = nullptr, *terminate_ = nullptr;
  fmi2::DoStep* do_step_ = nullptr;
  fmi2::GetBooleanStatus* get_boolean_status_ = nullptr;
  Set2<double>* set_real_ = nullptr;
  Set2<int>*set_integer_ = nullptr, *set_boolean_ = nullptr;
  Set2<const char*>* set_string_ = nullptr;
  Get2<double>* get_real_ = nullptr;
  Get2<int>*get_integer_ = nullptr, *get_boolean_ = nullptr;
};

}  // namespace

Started start_fmi2(const Setup& setup, Binary binary, std::span<double> outputs) {
  auto instance = std::make_unique<Fmi2>(setup, std::move(binary));
  if (auto found = instance->find_functions(); !found) return tl::unexpected(found.error());
  if (auto started = instance->start(outputs); !started) return tl::unexpected(started.error());
  return instance;
}

}  // namespace canhil::plant::fmu
