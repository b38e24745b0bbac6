#include "bench/scenario/expression.hpp"

#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <iterator>
#include <mutex>
#include <numbers>
#include <vector>

#include "bench/scenario/nearest.hpp"
#include "bench/scenario/scenario.hpp"
#include "bench/scenario/section.hpp"
#include "bench/world/units.hpp"

namespace canhil::scenario {
namespace {

constexpr std::string_view time_name = "t";

// muParser assigns by '=', and gives several results for a list. Neither has a meaning here.
bool assigns(std::string_view text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '=') continue;
    if (i + 1 < text.size() && text[i + 1] == '=')
      ++i;
    else if (i == 0 || std::string_view("<>!").find(text[i - 1]) == std::string_view::npos)
      return true;
  }
  return false;
}

constexpr std::string_view name_characters =
    "0123456789_.[]abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";

// The true values that a text may use: all of the bench, and the outputs of a plant that the text names.
std::vector<const world::TruthValue*> usable_in(std::string_view text) {
  std::vector<const world::TruthValue*> usable;
  for (const world::TruthValue& one : world::truth_values()) usable.push_back(&one);
  for (std::size_t end = 0, begin = 0; begin < text.size(); begin = end + 1) {
    end = std::min(text.find_first_not_of(name_characters, begin), text.size());
    const std::string_view name = text.substr(begin, end - begin);
    if (!name.starts_with(world::plant_prefix)) continue;
    const world::TruthValue* output = world::find_truth_value(name);
    if (output != nullptr && std::ranges::find(usable, output) == usable.end()) usable.push_back(output);
  }
  return usable;
}

}  // namespace

struct Expression::Parsed {
  mu::Parser parser;
  std::vector<const world::TruthValue*> uses;
  std::vector<std::size_t> further;
  std::deque<double> values;  // of `uses`, then of `further`; the parser keeps their addresses
  double t_s = 0;
  std::mutex mutex;  // for `values` and `t_s`
};

tl::expected<Expression, Expression::Wrong> Expression::parse(std::string_view text,
                                                              std::span<const std::string> further) {
  if (assigns(text))
    return tl::unexpected(Wrong{fmt::format("'{}' assigns a value", text), "== to compare two values"});
  auto parsed = std::make_shared<Parsed>();
  mu::Parser& parser = parsed->parser;
  const std::vector<const world::TruthValue*> usable = usable_in(text);
  std::vector<std::string> names{std::string(time_name)};
  for (const world::TruthValue* one : usable) names.emplace_back(one->name);
  names.insert(names.end(), further.begin(), further.end());
  try {
    parser.DefineNameChars(std::string(name_characters).c_str());
    parser.DefineConst("pi", std::numbers::pi);
    parser.DefineConst("deg", world::units::deg);
    parser.DefineConst("g", world::units::standard_gravity);
    parser.DefineInfixOprt("!", [](mu::value_type value) -> mu::value_type { return value == 0 ? 1 : 0; });
    parser.DefineVar(std::string(time_name), &parsed->t_s);
    double unused = 0;
    for (auto name = std::next(names.begin()); name != names.end(); ++name) parser.DefineVar(*name, &unused);
    parser.SetExpr(std::string(text));
    const auto used = parser.GetUsedVar();
    const auto keep = [&](const std::string& name) {
      if (used.contains(name))
        parser.DefineVar(name, &parsed->values.emplace_back());
      else
        parser.RemoveVar(name);
      return used.contains(name);
    };
    for (const world::TruthValue* one : usable) {
      if (keep(std::string(one->name))) parsed->uses.push_back(one);
    }
    for (std::size_t i = 0; i < further.size(); ++i) {
      if (keep(further[i])) parsed->further.push_back(i);
    }
    parser.Eval();
    if (parser.GetNumResults() != 1)
      return tl::unexpected(
          Wrong{fmt::format("'{}' has {} values", text, parser.GetNumResults()), "one expression"});
  } catch (const mu::ParserError& error) {
    if (error.GetCode() == mu::ecUNASSIGNABLE_TOKEN)
      return tl::unexpected(Wrong{fmt::format("'{}' is no true value", error.GetToken()),
                                  expected_instead(error.GetToken(), names)});
    return tl::unexpected(
        Wrong{fmt::format("'{}' is no expression: {}", text, error.GetMsg()), "such as 2 * velocity.north"});
  }
  return Expression(std::move(parsed));
}

std::optional<double> Expression::at(const world::Truths& truths, std::int64_t t_us,
                                     const Further& further) const {
  const std::lock_guard lock(parsed_->mutex);
  parsed_->t_s = 1e-6 * static_cast<double>(t_us);
  for (std::size_t i = 0; i < parsed_->uses.size(); ++i) {
    const auto value = parsed_->uses[i]->at(truths, t_us);
    if (!value) return std::nullopt;
    parsed_->values[i] = *value;
  }
  for (std::size_t i = 0; i < parsed_->further.size(); ++i) {
    const auto value = further(parsed_->further[i]);
    if (!value) return std::nullopt;
    parsed_->values[parsed_->uses.size() + i] = *value;
  }
  const double value = parsed_->parser.Eval();
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::span<const world::TruthValue* const> Expression::uses() const { return parsed_->uses; }
std::span<const std::size_t> Expression::uses_further() const { return parsed_->further; }

std::string why_no_truth(const Scenario& scenario, const Expression& expression) {
  for (const world::TruthValue* one : expression.uses()) {
    if (std::string why = why_no_truth(scenario, *one); !why.empty()) return why;
  }
  return {};
}

std::optional<Expression> read_expression(Section& section, std::string_view key, std::string_view meaning) {
  const std::string text = section.text({key, meaning});
  if (text.empty()) return std::nullopt;
  auto parsed = Expression::parse(text);
  if (!parsed) {
    section.reject(key, parsed.error().what, parsed.error().expected);
    return std::nullopt;
  }
  return std::move(*parsed);
}

}  // namespace canhil::scenario
