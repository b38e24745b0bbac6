// Results of a run in addition to the checks: lines of numbers, for people and for programs.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace canhil::estimators {

struct Figure {
  std::string name;               ///< for programs: "heading"
  std::optional<double> value{};  ///< [SI]; none: no value
  std::string text;               ///< for people, with its unit: "heading +1.234 mrad"; empty: not shown
};

struct ResultLine {
  std::string name;  ///< for programs: "final_error"
  std::string what;  ///< for people: "error at the end"
  std::vector<Figure> figures{};

  void add(std::string figure, std::optional<double> value, std::string text) {
    figures.push_back({.name = std::move(figure), .value = value, .text = std::move(text)});
  }
};

}  // namespace canhil::estimators
