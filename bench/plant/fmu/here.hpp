// FMUs in this process, by the version of the FMI.
#pragma once

#include "bench/plant/fmu/binary.hpp"
#include "bench/plant/fmu/running.hpp"

namespace canhil::plant::fmu {

Started start_fmi2(const Setup& setup, Binary binary, std::span<double> outputs);
Started start_fmi3(const Setup& setup, Binary binary, std::span<double> outputs);

}  // namespace canhil::plant::fmu
