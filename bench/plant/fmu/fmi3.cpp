// The life cycle of an FMU of FMI 3.0 (FMI 3.0.2, sections 2.3 and 4.2).
#include <fmt/format.h>

#include <filesystem>
#include <string>
#include <system_error>
#include <tuple>
#include <type_traits>

#include "bench/plant/fmu/here.hpp"

namespace canhil::plant::fmu {
namespace {

using namespace standard;

/// The functions for variables whose values have the type T in C.
template <class T>
struct Access {
  Set3<T>* set = nullptr;
  Get3<T>* get = nullptr;
};

template <class T>
T converted(double value) {
  if constexpr (std::is_same_v<T, bool>) return value != 0;
  return static_cast<T>(value);
}

template <class T>
T converted(const Value& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return static_cast<T>(*whole);
  return converted<T>(std::get<double>(value));
}

void add_to_journal(Environment environment, int status, const char* category, const char* message) {
  static_cast<Journal*>(environment)->add(status, category, message);
}

class Fmi3 final : public Running {
 public:
  Fmi3(const Setup& setup, Binary binary)
      : setup_(setup), binary_(std::move(binary)), journal_(setup.fmu, setup.log) {}
  ~Fmi3() override {
    if (instance_ == nullptr || !journal_.may_free()) return;
    if (initialized_ && journal_.may_terminate()) terminate_(instance_);
    free_(instance_);
  }

  Result<void> find_functions() {
    std::string missing;
    const auto find = [&]<class F>(F*& function, const std::string& name) {
      function = binary_.function<F>(name.c_str(), missing);
    };
    find(instantiate_, "fmi3InstantiateCoSimulation");
    find(free_, "fmi3FreeInstance");
    find(enter_configuration_, "fmi3EnterConfigurationMode");
    find(exit_configuration_, "fmi3ExitConfigurationMode");
    find(enter_, "fmi3EnterInitializationMode");
    find(exit_, "fmi3ExitInitializationMode");
    find(terminate_, "fmi3Terminate");
    find(do_step_, "fmi3DoStep");
    find(set_string_, "fmi3SetString");
    for (auto type = Type::float32; type <= Type::boolean;
         type = static_cast<Type>(static_cast<std::uint8_t>(type) + 1)) {
      with(type, [&](auto& access) {
        find(access.set, fmt::format("fmi3Set{}", name_of(type)));
        find(access.get, fmt::format("fmi3Get{}", name_of(type)));
        return 0;
      });
    }
    if (missing.empty()) return {};
    return failure(fmt::format("its binary has no function {}, expected those of FMI 3.0", missing));
  }

  Result<void> start(std::span<double> outputs) {
    const std::string resources = setup_.folder + "/resources/";
    std::error_code unknown;
    const bool has_resources = std::filesystem::is_directory(resources, unknown);
    instance_ =
        instantiate_(setup_.fmu.c_str(), setup_.token.c_str(), has_resources ? resources.c_str() : nullptr,
                     false, setup_.log, false, false, nullptr, 0, &journal_, add_to_journal, nullptr);
    if (instance_ == nullptr) return journal_.failed("fmi3InstantiateCoSimulation", "returned no instance");
    if (!setup_.structure.empty()) {
      if (!journal_.accepts(enter_configuration_(instance_)))
        return journal_.failed("fmi3EnterConfigurationMode");
      if (auto set = set_presets(setup_.structure); !set) return set;
      if (!journal_.accepts(exit_configuration_(instance_)))
        return journal_.failed("fmi3ExitConfigurationMode");
    }
    if (auto set = set_presets(setup_.parameters); !set) return set;
    if (!journal_.accepts(enter_(instance_, setup_.tolerance > 0, setup_.tolerance, 0, false, 0)))
      return journal_.failed("fmi3EnterInitializationMode");
    if (auto set = set_inputs(setup_.starts); !set) return set;
    if (!journal_.accepts(exit_(instance_))) return journal_.failed("fmi3ExitInitializationMode");
    initialized_ = true;
    return get_outputs(outputs);
  }

  Result<void> step(double from_s, double step_s, std::span<const double> inputs,
                    std::span<double> outputs) override {
    if (auto set = set_inputs(inputs); !set) return set;
    const double to_s = from_s + step_s;
    double left_s = step_s;
    // The bench does not ask for an early return. If the FMU returns early all the same, it goes on from
    // there.
    for (bool early = true; early;) {
      bool event = false, terminate = false;
      double reached_s = from_s;
      early = false;
      if (!journal_.accepts(
              do_step_(instance_, from_s, left_s, true, &event, &terminate, &early, &reached_s)))
        return journal_.failed("fmi3DoStep");
      if (terminate) return journal_.failed("fmi3DoStep", "asked for the end of the simulation");
      if (event) return journal_.failed("fmi3DoStep", "asked for the event mode, which is not used");
      if (early && !(reached_s > from_s && reached_s < to_s))
        return journal_.failed("fmi3DoStep", fmt::format("returned early at {} s", reached_s));
      from_s = reached_s;
      left_s = to_s - reached_s;
    }
    return get_outputs(outputs);
  }

 private:
  /// Calls `use` with the functions for a type that is not a string.
  template <class Use>
  int with(Type type, const Use& use) {
    switch (type) {
      case Type::float32:
        return use(std::get<Access<float>>(access_));
      case Type::float64:
        return use(std::get<Access<double>>(access_));
      case Type::int8:
        return use(std::get<Access<std::int8_t>>(access_));
      case Type::uint8:
        return use(std::get<Access<std::uint8_t>>(access_));
      case Type::int16:
        return use(std::get<Access<std::int16_t>>(access_));
      case Type::uint16:
        return use(std::get<Access<std::uint16_t>>(access_));
      case Type::int32:
        return use(std::get<Access<std::int32_t>>(access_));
      case Type::uint32:
        return use(std::get<Access<std::uint32_t>>(access_));
      case Type::uint64:
        return use(std::get<Access<std::uint64_t>>(access_));
      case Type::boolean:
        return use(std::get<Access<bool>>(access_));
      default:  // an enumeration is an Int64 in C
        return use(std::get<Access<std::int64_t>>(access_));
    }
  }

  template <class From>
  int set(const Place& place, std::span<const From> values) {
    return with(place.type, [&]<class T>(const Access<T>& access) {
      const auto own = std::make_unique<T[]>(values.size());
      for (std::size_t i = 0; i < values.size(); ++i) own[i] = converted<T>(values[i]);
      return access.set(instance_, &place.reference, 1, own.get(), values.size());
    });
  }
  int set_texts(const Place& place, std::span<const Value> values) {
    std::vector<const char*> texts;
    for (const Value& value : values) texts.push_back(std::get<std::string>(value).c_str());
    return set_string_(instance_, &place.reference, 1, texts.data(), texts.size());
  }
  Result<void> set_presets(std::span<const Preset> presets) {
    for (const auto& [place, values] : presets) {
      const std::span<const Value> all(values);
      if (!journal_.accepts(place.type == Type::string ? set_texts(place, all) : set(place, all)))
        return journal_.failed(fmt::format("setting '{}'", place.name));
    }
    return {};
  }
  Result<void> set_inputs(std::span<const double> values) {
    for (const Place& place : setup_.inputs) {
      if (!journal_.accepts(set(place, values.first(place.count))))
        return journal_.failed(fmt::format("setting '{}'", place.name));
      values = values.subspan(place.count);
    }
    return {};
  }
  int get(const Place& place, std::span<double> values) {
    return with(place.type, [&]<class T>(const Access<T>& access) {
      const auto own = std::make_unique<T[]>(values.size());
      const int status = access.get(instance_, &place.reference, 1, own.get(), values.size());
      for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<double>(own[i]);
      return status;
    });
  }
  Result<void> get_outputs(std::span<double> values) {
    for (const Place& place : setup_.outputs) {
      if (!journal_.accepts(get(place, values.first(place.count))))
        return journal_.failed(fmt::format("reading '{}'", place.name));
      values = values.subspan(place.count);
    }
    return {};
  }

  Setup setup_;
  Binary binary_;
  Journal journal_;
  Instance instance_ = nullptr;
  bool initialized_ = false;

  fmi3::Instantiate* instantiate_ = nullptr;
  Free* free_ = nullptr;
  Change *enter_configuration_ = nullptr, *exit_configuration_ = nullptr;
  fmi3::EnterInitializationMode* enter_ = nullptr;
  Change *exit_ = nullptr, *terminate_ = nullptr;
  fmi3::DoStep* do_step_ = nullptr;
  Set3<const char*>* set_string_ = nullptr;
  std::tuple<Access<float>, Access<double>, Access<std::int8_t>, Access<std::uint8_t>, Access<std::int16_t>,
             Access<std::uint16_t>, Access<std::int32_t>, Access<std::uint32_t>, Access<std::int64_t>,
             Access<std::uint64_t>, Access<bool>>
      access_;
};

}  // namespace

Started start_fmi3(const Setup& setup, Binary binary, std::span<double> outputs) {
  auto instance = std::make_unique<Fmi3>(setup, std::move(binary));
  if (auto found = instance->find_functions(); !found) return tl::unexpected(found.error());
  if (auto started = instance->start(outputs); !started) return tl::unexpected(started.error());
  return instance;
}

}  // namespace canhil::plant::fmu
