#include "bench/plant/fmu/description.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <pugixml.hpp>

#include "dbc/text/escape.hpp"

namespace canhil::plant::fmu {
namespace {

using pugi::xml_node;

constexpr std::string_view blanks = " \t\r\n";

std::string_view trimmed(std::string_view text) {
  const auto from = text.find_first_not_of(blanks);
  if (from == std::string_view::npos) return {};
  return text.substr(from, text.find_last_not_of(blanks) - from + 1);
}

std::vector<std::string_view> words_of(std::string_view text) {
  std::vector<std::string_view> words;
  for (text = trimmed(text); !text.empty();) {
    const auto end = std::min(text.find_first_of(blanks), text.size());
    words.push_back(text.substr(0, end));
    text = trimmed(text.substr(end));
  }
  return words;
}

template <class T>
std::optional<T> number(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<bool> boolean(std::string_view text) {
  if (text == "true" || text == "1") return true;
  if (text == "false" || text == "0") return false;
  return std::nullopt;
}

/// The type of a variable's element, or of a type definition's. Binary variables and clocks have none.
std::optional<Type> type_of(std::string_view element, std::int32_t version) {
  if (version == 2) {
    if (element == "Real") return Type::float64;
    if (element == "Integer") return Type::int32;
    if (element == "Boolean") return Type::boolean;
    if (element == "String") return Type::string;
    if (element == "Enumeration") return Type::enumeration;
    return std::nullopt;
  }
  for (auto type = Type::float32;; type = static_cast<Type>(static_cast<std::uint8_t>(type) + 1)) {
    if (element == name_of(type)) return type;
    if (type == Type::enumeration) return std::nullopt;
  }
}

/// The name that the bench has for a unit with these exponents of kg, m, s, A, K, mol, cd, rad.
std::string_view si_name(const std::array<int, 8>& exponents) {
  struct Unit {
    std::string_view name;
    std::array<int, 8> exponents;
  };
  constexpr std::array<Unit, 9> units{{{"rad", {0, 0, 0, 0, 0, 0, 0, 1}},
                                       {"rad/s", {0, 0, -1, 0, 0, 0, 0, 1}},
                                       {"m", {0, 1, 0, 0, 0, 0, 0, 0}},
                                       {"m/s", {0, 1, -1, 0, 0, 0, 0, 0}},
                                       {"m/s^2", {0, 1, -2, 0, 0, 0, 0, 0}},
                                       {"s", {0, 0, 1, 0, 0, 0, 0, 0}},
                                       {"Pa", {1, -1, -2, 0, 0, 0, 0, 0}},
                                       {"K", {0, 0, 0, 0, 1, 0, 0, 0}},
                                       {"T", {1, 0, -2, -1, 0, 0, 0, 0}}}};
  const auto found = std::ranges::find(units, exponents, &Unit::exponents);
  return found == units.end() ? "" : found->name;
}

/// Reads the XML. The first error is kept.
class Reader {
 public:
  Result<ModelDescription> read(std::string_view xml) {
    pugi::xml_document document;
    const auto parsed = document.load_buffer(xml.data(), xml.size());
    if (!parsed) {
      const std::string_view before = xml.substr(0, static_cast<std::size_t>(parsed.offset));
      return failure(fmt::format("modelDescription.xml:{}: is not XML ({})",
                                 1 + std::ranges::count(before, '\n'), parsed.description()));
    }
    read_head(document.child("fmiModelDescription"));
    if (error_) return tl::unexpected(*error_);
    return std::move(own_);
  }

 private:
  void fail(std::string_view what, std::string_view expected) {
    if (!error_)
      error_ = Error{one_line(fmt::format("modelDescription.xml: {}, expected {}", what, expected))};
  }
  template <class T>
  T attribute(const xml_node& node, const char* name, std::string_view expected,
              std::optional<T> (*from_text)(std::string_view), T fallback) {
    const auto found = node.attribute(name);
    if (!found) return fallback;
    const std::optional<T> value = from_text(trimmed(found.value()));
    if (value) return *value;
    fail(fmt::format("{}: {} '{}'", where_.empty() ? node.name() : where_, name, found.value()), expected);
    return fallback;
  }
  double real(const xml_node& node, const char* name, double fallback) {
    const auto finite = [](std::string_view text) {
      const auto value = number<double>(text);
      return value && std::isfinite(*value) ? value : std::nullopt;
    };
    return attribute<double>(node, name, "a number", finite, fallback);
  }
  bool flag(const xml_node& node, const char* name) {
    return attribute<bool>(node, name, "true or false", boolean, false);
  }

  void read_head(const xml_node& root) {
    const std::string_view version = root.attribute("fmiVersion").value();
    if (!root) return fail("has no element fmiModelDescription", "it");
    if (version != "2.0" && !version.starts_with("2.0.") && !version.starts_with("3."))
      return fail(fmt::format("is of FMI version '{}'", version), "2.0 or 3.0");
    own_.version = version.front() == '2' ? 2 : 3;
    own_.token = root.attribute(own_.version == 2 ? "guid" : "instantiationToken").value();
    const xml_node simulation = root.child("CoSimulation");
    if (!simulation)
      return fail(root.child("ModelExchange") ? "is for model exchange alone" : "has no co-simulation",
                  "an FMU for co-simulation");
    own_.identifier = simulation.attribute("modelIdentifier").value();
    const auto of_a_name = [](char c) {
      return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
    };
    if (own_.identifier.empty() || !std::ranges::all_of(own_.identifier, of_a_name))
      return fail(fmt::format("modelIdentifier '{}'", own_.identifier), "letters, digits and _");
    own_.step_may_vary = flag(simulation, "canHandleVariableCommunicationStepSize");
    own_.once_per_process = flag(simulation, "canBeInstantiatedOnlyOncePerProcess");
    own_.internal_step_s = real(simulation, "fixedInternalStepSize", 0);
    const xml_node experiment = root.child("DefaultExperiment");
    own_.tolerance = real(experiment, "tolerance", 0);
    own_.step_s = real(experiment, "stepSize", own_.internal_step_s);
    for (const xml_node& unit : root.child("UnitDefinitions").children("Unit")) read_unit(unit);
    for (const xml_node& type : root.child("TypeDefinitions").children())
      types_[type.attribute("name").value()] = own_.version == 2 ? type.first_child() : type;
    for (const xml_node& variable : root.child("ModelVariables").children()) {
      if (variable.type() == pugi::node_element) read_variable(variable);
    }
  }

  void read_unit(const xml_node& unit) {
    const xml_node to = unit.child("BaseUnit");
    if (!to) return;  // no conversion is known
    constexpr std::array names{"kg", "m", "s", "A", "K", "mol", "cd", "rad"};
    std::array<int, names.size()> exponents{};
    for (std::size_t i = 0; i < names.size(); ++i)
      exponents[i] = attribute<int>(to, names[i], "a whole number", number<int>, 0);
    const Conversion conversion{.factor = real(to, "factor", 1),
                                .offset = real(to, "offset", 0),
                                .si = std::string(si_name(exponents))};
    if (conversion.factor == 0)
      fail(fmt::format("unit '{}': factor 0", unit.attribute("name").value()), "another one");
    units_[unit.attribute("name").value()] = conversion;
  }

  void read_variable(const xml_node& node) {
    const xml_node typed = own_.version == 2 ? node.find_child([](const xml_node& inner) {
      return inner.type() == pugi::node_element && inner.name() != std::string_view("Annotations");
    })
                                             : node;
    DescribedVariable variable{.name = node.attribute("name").value()};
    where_ = fmt::format("variable '{}'", variable.name);
    const std::string_view causality = node.attribute("causality").value();
    if (typed.name() == std::string_view("Clock") && causality == "input")
      fail(where_ + " is an input clock", "an FMU without input clocks");
    const auto type = type_of(typed.name(), own_.version);
    if (!type || node.attribute("clocks") || causality == "independent") return;
    variable.type = *type;
    if (variable.name.empty()) fail("a variable has no name", "one");
    variable.reference =
        attribute<std::uint32_t>(node, "valueReference", "a value reference", number<std::uint32_t>, 0);
    const std::string_view variability = node.attribute("variability").value();
    const std::string_view initial = (own_.version == 2 ? node : typed).attribute("initial").value();
    variable.causality = causality == "input"                 ? Causality::input
                         : causality == "output"              ? Causality::output
                         : causality == "parameter"           ? Causality::parameter
                         : causality == "structuralParameter" ? Causality::structural_parameter
                                                              : Causality::other;
    const bool by_causality =
        variable.causality != Causality::output && variable.causality != Causality::other;
    variable.settable = by_causality
                            ? initial != "calculated"
                            : variability != "constant" && (initial == "exact" || initial == "approx");
    const bool real_number = *type == Type::float32 || *type == Type::float64;
    variable.steps = !real_number || variability == "discrete";
    const auto declared = types_.find(typed.attribute("declaredType").value());
    const xml_node defaults = declared == types_.end() ? xml_node() : declared->second;
    if (real_number) read_conversion(variable, typed, defaults);
    if (real_number || is_integer(*type)) {
      variable.least = limit(typed, defaults, "min");
      variable.most = limit(typed, defaults, "max");
    }
    for (const xml_node& item : defaults.children("Item"))
      variable.items.emplace_back(
          item.attribute("name").value(),
          attribute<std::int32_t>(item, "value", "a whole number", number<std::int32_t>, 0));
    read_dimensions(variable, typed);
    read_start(variable, typed);
    own_.variables.push_back(std::move(variable));
  }

  void read_conversion(DescribedVariable& variable, const xml_node& node, const xml_node& defaults) {
    const xml_node& with_unit = node.attribute("unit") ? node : defaults;
    const auto unit = units_.find(with_unit.attribute("unit").value());
    if (unit == units_.end()) return;
    variable.conversion = unit->second;
    const bool relative = flag(defaults, "relativeQuantity") || flag(node, "relativeQuantity");
    if (relative) variable.conversion.offset = 0;
  }

  std::optional<double> limit(const xml_node& node, const xml_node& defaults, const char* name) {
    const xml_node& with_limit = node.attribute(name) ? node : defaults;
    const auto value = number<double>(trimmed(with_limit.attribute(name).value()));
    return value && std::isfinite(*value) ? value : std::nullopt;
  }

  void read_dimensions(DescribedVariable& variable, const xml_node& node) {
    for (const xml_node& one : node.children("Dimension")) {
      Dimension dimension;
      if (one.attribute("valueReference"))
        dimension.from =
            attribute<std::uint32_t>(one, "valueReference", "a value reference", number<std::uint32_t>, 0);
      else
        dimension.size = attribute<std::uint64_t>(one, "start", "a whole number", number<std::uint64_t>, 0);
      if (!dimension.from && dimension.size == 0) fail(where_ + " has a dimension of size 0", "at least 1");
      variable.dimensions.push_back(dimension);
    }
  }

  void read_start(DescribedVariable& variable, const xml_node& node) {
    const auto add = [&](std::string_view text) {
      auto value = read_value(text, variable.type);
      if (value)
        variable.start.push_back(std::move(*value));
      else
        fail(fmt::format("{}: start '{}'", where_, text), value.error().message);
    };
    if (variable.type == Type::string) {
      for (const xml_node& one : node.children("Start"))
        variable.start.emplace_back(one.attribute("value").value());
      if (const auto one = node.attribute("start")) variable.start.emplace_back(one.value());
      return;
    }
    for (const std::string_view word : words_of(node.attribute("start").value())) add(word);
  }

  ModelDescription own_;
  std::optional<Error> error_;
  std::string where_;  // the variable that is read
  std::map<std::string, Conversion, std::less<>> units_;
  std::map<std::string, xml_node, std::less<>> types_;
};

}  // namespace

Result<ModelDescription> read_description(std::string_view xml) { return Reader().read(xml); }

Result<Value> read_value(std::string_view text, Type type) {
  const Range range = range_of(type);
  if (type == Type::string) return Value(std::string(text));
  if (type == Type::boolean) {
    if (const auto value = boolean(text)) return Value(std::int64_t{*value});
    return failure("true or false");
  }
  if (!is_integer(type)) {
    const auto value = number<double>(text);
    if (value && *value >= range.least && *value <= range.most) return Value(*value);
    return failure(fmt::format("a number that {} can hold", name_of(type)));
  }
  const auto value = number<std::int64_t>(text);
  if (value && static_cast<double>(*value) >= range.least && static_cast<double>(*value) <= range.most)
    return Value(*value);
  return failure(fmt::format("a whole number that {} can hold", name_of(type)));
}

}  // namespace canhil::plant::fmu
