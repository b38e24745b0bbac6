// Judges how a signal differs between two flights.
#pragma once

#include <string>

#include "bench/accept/accept.hpp"
#include "bench/accept/profile.hpp"

namespace canhil::accept {

/// Judges one move of the flight `name`: `here` are its answers, `there` those of the flight beside it.
Item judge_move(const Move& move, const std::string& name, const Answers& here, const Answers& there);

}  // namespace canhil::accept
