// What the names of buses say that are in this process.
#pragma once

#include <string_view>

#include "dbc/wire/unrounded.hpp"

namespace canhil::run {

/// Virtual time, the device in this process. With '?bitrate=' and more a simulated wire lies between.
inline constexpr std::string_view in_process_bus = "in-process";
/// The same with frames that round nothing.
inline constexpr std::string_view unrounded_bus = "in-process?unrounded";

/// True for `in-process` and `in-process?bitrate=500000`: no bus, the device is in this process.
constexpr bool is_in_process(std::string_view bus) { return bus.substr(0, bus.find('?')) == in_process_bus; }

/// What a bus makes of scaled signals.
constexpr Rounding rounding_of(std::string_view bus) {
  return bus == unrounded_bus ? Rounding::none : Rounding::as_on_the_bus;
}

}  // namespace canhil::run
