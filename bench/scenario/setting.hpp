// A value that replaces or adds a value in a scenario file.
#pragma once

#include <string>
#include <vector>

namespace canhil::scenario {

struct Setting {
  std::string key;                    ///< including the tables around it: "master_ins.period_ms"
  std::string value;                  ///< as TOML text
  std::vector<std::string> elements;  ///< elements of an array, each as TOML text
  int line = 0;                       ///< line of the setting's definition
};

}  // namespace canhil::scenario
