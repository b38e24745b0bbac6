// How a program of the user is started, and how long the bench waits for it.
#pragma once

#include <chrono>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace canhil::processes {

struct ProgramSettings {
  /// The name of a parameter, and its number or text.
  using Parameter = std::pair<std::string, std::variant<double, std::string>>;

  std::string command{};  ///< as the scenario gives it
  std::vector<std::string> words{};
  std::string folder{};  ///< working folder; empty: that of the bench
  std::vector<Parameter> parameters{};
  std::chrono::microseconds starts_within{}, answers_within{};
};

}  // namespace canhil::processes
