// Measures the round trip of frames from one interface to another and back.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/doctor/line.hpp"
#include "dbc/ports/port.hpp"

namespace canhil::doctor {

/// Results of the measurement.
struct LoopResult {
  int sent = 0;
  int lost = 0;                               ///< frames without an answer in time
  std::vector<double> round_trip_s;           ///< of the answered frames
  StampSource source = StampSource::process;  ///< source of the stamps on the answers
};

/// Sends eight-byte frames one after the other from `near` to `far`, which answers each of them: `frames`
/// frames, or fewer if stop() returns true or many in a row are lost. The frames and their
/// answers have the two ids of lowest priority, up to 0x7EF, that the DBC does not use.
LoopResult measure_loop(Port& near, Port& far, int frames, const std::function<bool()>& stop);

/// The finding for this result.
Line loop_line(const LoopResult& result, const std::string& near, const std::string& far);

}  // namespace canhil::doctor
