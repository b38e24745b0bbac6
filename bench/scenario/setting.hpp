// A value that replaces or adds a value in a scenario file.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "dbc/wire/result.hpp"

namespace canhil::scenario {

struct Setting {
  std::string key;                    ///< including the tables around it: "master_ins.period_ms"
  std::string value;                  ///< as TOML text
  std::vector<std::string> elements;  ///< elements of an array, each as TOML text
  int line = 0;                       ///< line of the setting's definition
};

/// Reads KEY=VALUE, as a user gives it on a command line. VALUE is a TOML value; a text that is not a TOML
/// value counts as a string, so strings need no quotes: target.algorithm=ekf. A table gives a setting for
/// each of its keys. The error is one line.
Result<std::vector<Setting>> parse_setting(std::string_view text);
/// The settings of all options `--set`; a key may be set only once. The error is one line with the option.
Result<std::vector<Setting>> parse_settings(const std::vector<std::string>& texts);

/// A text as a TOML string, in quotes.
std::string toml_string(std::string_view text);

}  // namespace canhil::scenario
