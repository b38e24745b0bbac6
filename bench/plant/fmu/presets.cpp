#include "bench/plant/fmu/presets.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "bench/scenario/nearest.hpp"

namespace canhil::plant::fmu {
namespace {

using scenario::Section;

constexpr std::uint64_t most_elements = 100'000;

/// A value of the scenario: its table, its key there, and the name of the variable that it sets.
struct Leaf {
  Section table;
  std::string key, name;
};

// The name of a variable may contain points, which TOML reads as nested tables.
void add_leaves(Section table, const std::string& path, std::vector<Leaf>& leaves) {
  for (const std::string& key : table.keys()) {
    const std::string name = path.empty() ? key : fmt::format("{}.{}", path, key);
    if (table.holds_table(key))
      add_leaves(table.table(key), name, leaves);
    else
      leaves.push_back({.table = table, .key = key, .name = name});
  }
}

std::vector<std::string> item_names(const DescribedVariable& variable) {
  std::vector<std::string> names;
  for (const auto& [name, value] : variable.items) names.push_back(name);
  return names;
}

Value read_item(Leaf& leaf, const DescribedVariable& variable) {
  const std::vector<std::string> names = item_names(variable);
  if (leaf.table.holds_text(leaf.key)) {
    const std::string name = leaf.table.given_name(leaf.key, names);
    const auto item = std::ranges::find(variable.items, name, &std::pair<std::string, std::int64_t>::first);
    return item == variable.items.end() ? 0 : item->second;
  }
  const std::int64_t value = leaf.table.integer(leaf.key, std::numeric_limits<std::int64_t>::min());
  if (std::ranges::find(variable.items, value, &std::pair<std::string, std::int64_t>::second) ==
      variable.items.end())
    leaf.table.reject(leaf.key, fmt::format("{} is no value of the enumeration", value),
                      scenario::expected_instead("", names));
  return value;
}

Value read_whole(Leaf& leaf, const DescribedVariable& variable) {
  // The limits as integers: a double cannot express the largest Int64.
  constexpr auto lowest = std::numeric_limits<std::int64_t>::min();
  constexpr auto highest = std::numeric_limits<std::int64_t>::max();
  const Range range = range_of(variable.type);
  const double least = std::max(range.least, variable.least.value_or(range.least));
  const double most = std::min(range.most, variable.most.value_or(range.most));
  const std::int64_t from = least <= static_cast<double>(lowest) ? lowest : static_cast<std::int64_t>(least);
  const std::int64_t to = most >= static_cast<double>(highest) ? highest : static_cast<std::int64_t>(most);
  const std::int64_t value = leaf.table.integer(leaf.key, from);
  if (value > to)
    leaf.table.reject(leaf.key, fmt::format("{} is out of range", value),
                      fmt::format("a whole number from {} to {}", from, to));
  return value;
}

Value read_leaf(Leaf& leaf, const DescribedVariable& variable) {
  switch (variable.type) {
    case Type::boolean:
      return std::int64_t{leaf.table.flag(leaf.key)};
    case Type::string:
      return leaf.table.text(leaf.key);
    case Type::enumeration:
      return read_item(leaf, variable);
    case Type::float32:
    case Type::float64: {
      const Range range = range_of(variable.type);
      auto limits =
          scenario::Limits{.least = variable.least.value_or(-std::numeric_limits<double>::infinity()),
                           .most = variable.most.value_or(std::numeric_limits<double>::infinity())};
      if (variable.type == Type::float32)
        limits =
            scenario::Limits::between(std::max(limits.least, range.least), std::min(limits.most, range.most));
      return leaf.table.plain_number(leaf.key, limits);
    }
    default:
      return read_whole(leaf, variable);
  }
}

class Presets {
 public:
  Presets(Section& section, const std::optional<Section>& parameters, const ModelDescription& description)
      : section_(section) {
    for (const DescribedVariable& variable : description.variables) all_.push_back({.variable = &variable});
    if (parameters) add_leaves(*parameters, "", leaves_);
  }

  std::vector<Sized> read() {
    size_all([](const Sized& one) { return one.variable->causality == Causality::structural_parameter; });
    set_all();  // structural parameters alone, because only these have elements so far
    for (const Sized& one : all_) {
      if (one.variable->causality != Causality::structural_parameter || one.start.empty()) continue;
      if (const auto* size = std::get_if<std::int64_t>(&one.start.front()))
        structure_[one.variable->reference] = *size;
    }
    size_all([](const Sized& one) { return one.variable->causality != Causality::structural_parameter; });
    set_all();
    for (Leaf& leaf : leaves_) reject(leaf);
    for (const Sized& one : all_) require_values(one);
    return std::move(all_);
  }

 private:
  template <class Chosen>
  void size_all(const Chosen& chosen) {
    places_.clear();
    for (std::size_t i = 0; i < all_.size(); ++i) {
      Sized& one = all_[i];
      if (!chosen(one)) continue;
      std::uint64_t count = 1;
      for (const Dimension& dimension : one.variable->dimensions) {
        const std::uint64_t size = size_of(*one.variable, dimension);
        one.sizes.push_back(size);
        count = std::min(count * std::min(size, most_elements + 1), most_elements + 1);
      }
      if (count > most_elements) {
        section_.reject("file",
                        Error{fmt::format("modelDescription.xml: variable '{}' has more than {} elements, "
                                          "expected at most that",
                                          one.variable->name, most_elements)});
        one.sizes.clear();
        count = 0;
      }
      const std::vector<Value>& start = one.variable->start;
      if (start.size() == count) one.start = start;
      if (start.size() == 1 && count > 0) one.start.assign(count, start.front());
      if (!one.variable->settable) continue;
      for (std::uint32_t element = 0; element < count; ++element)
        places_.emplace(one.name(element), std::pair(i, element));
    }
  }

  std::uint64_t size_of(const DescribedVariable& variable, const Dimension& dimension) {
    if (!dimension.from) return dimension.size;
    const auto size = structure_.find(*dimension.from);
    if (size != structure_.end() && size->second >= 0) return static_cast<std::uint64_t>(size->second);
    section_.reject("file",
                    Error{fmt::format("modelDescription.xml: variable '{}': its size is the value reference "
                                      "{}, expected a structural parameter with a start value",
                                      variable.name, *dimension.from)});
    return 1;
  }

  void set_all() {
    std::erase_if(leaves_, [&](Leaf& leaf) {
      const auto place = places_.find(leaf.name);
      if (place == places_.end()) return false;
      const auto [index, element] = place->second;
      Sized& one = all_[index];
      Value value = read_leaf(leaf, *one.variable);
      if (one.start.empty()) one.start.resize(one.count(), value);  // the others are set too, or missing
      one.start[element] = std::move(value);
      one.set = true;
      set_.emplace(index, element);
      return true;
    });
  }

  void reject(Leaf& leaf) {
    constexpr std::size_t most_names = 30;
    const auto known =
        std::ranges::find(all_, leaf.name, [](const Sized& one) { return one.variable->name; });
    if (known != all_.end() && !known->sizes.empty() && known->variable->settable)
      return leaf.table.reject(leaf.key, "is an array",
                               fmt::format("its elements, such as \"{}\"", known->name(0)));
    if (known != all_.end())
      return leaf.table.reject(leaf.key, "is computed by the FMU", "a parameter or a start value");
    std::vector<std::string> names;
    for (const auto& [name, place] : places_) names.push_back(name);
    for (const Sized& one : all_) {
      if (one.variable->causality == Causality::structural_parameter) names.push_back(one.variable->name);
    }
    const bool few = names.size() <= most_names || !scenario::nearest(leaf.name, names).empty();
    leaf.table.reject(
        leaf.key, "is unknown",
        few ? scenario::expected_instead(leaf.name, names) : "the name of a parameter of the FMU");
  }

  /// If a scenario changes the size of an array, the start values of modelDescription.xml are void.
  void require_values(const Sized& one) {
    const std::size_t given = one.variable->start.size();
    if (given == 1 || given == one.count()) return;
    if (!one.set && (given == 0 || one.variable->causality != Causality::parameter)) return;
    const auto index = static_cast<std::size_t>(&one - all_.data());
    for (std::uint32_t element = 0; element < one.count(); ++element) {
      if (set_.contains({index, element})) continue;
      return section_.reject(
          "parameters", fmt::format("has no {}", one.name(element)),
          fmt::format("values for all {} elements, because modelDescription.xml has {}", one.count(), given));
    }
  }

  Section& section_;
  std::vector<Leaf> leaves_;
  std::vector<Sized> all_;
  std::map<std::string, std::pair<std::size_t, std::uint32_t>, std::less<>> places_;
  std::set<std::pair<std::size_t, std::uint32_t>> set_;
  std::map<std::uint32_t, std::int64_t> structure_;
};

}  // namespace

std::uint32_t Sized::count() const {
  std::uint64_t count = 1;
  for (const std::uint64_t size : sizes) count *= size;
  return static_cast<std::uint32_t>(count);
}

std::string Sized::name(std::uint32_t element) const {
  if (sizes.empty()) return variable->name;
  std::vector<std::uint64_t> indices(sizes.size());
  std::uint64_t left = element;
  for (std::size_t i = sizes.size(); i-- > 0;) {
    indices[i] = left % sizes[i] + 1;
    left /= sizes[i];
  }
  return fmt::format("{}[{}]", variable->name, fmt::join(indices, ","));
}

Place Sized::place() const {
  return {.name = variable->name, .reference = variable->reference, .type = variable->type, .count = count()};
}

std::vector<Sized> read_presets(Section& section, const std::optional<Section>& parameters,
                                const ModelDescription& description) {
  return Presets(section, parameters, description).read();
}

}  // namespace canhil::plant::fmu
