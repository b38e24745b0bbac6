#include "bench/scenario/binding.hpp"

namespace canhil::scenario {

std::string to_text(const std::vector<Binding::Files>& files) {
  std::string text;
  for (const auto& [mapping, dbc] : files) text += (text.empty() ? "" : ", ") + mapping;
  return text;
}

}  // namespace canhil::scenario
