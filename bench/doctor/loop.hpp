// Measures frames from one interface to another and back.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/doctor/line.hpp"
#include "dbc/ports/port.hpp"

namespace canhil::doctor {

/// The results of the frames.
struct LoopResult {
  int sent = 0;
  int lost = 0;                               ///< without an answer in time
  std::vector<double> round_trip_s;           ///< of those that came back
  StampSource source = StampSource::process;  ///< of the stamps on the frames that came back
};

/// Sends eight-byte frames one after the other from `near` to `far`, which answers each: `frames` of them, or
/// fewer if stop() is true or many in a row are lost. Their ids are the two lowest-priority ones that the DBC
/// does not use.
LoopResult measure_loop(Port& near, Port& far, int frames, const std::function<bool()>& stop);

/// The line for this result.
Line loop_line(const LoopResult& result, const std::string& near, const std::string& far);

}  // namespace canhil::doctor
