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
  int lost = 0;                               ///< number of frames that were not answered in time
  std::vector<double> round_trip_s;           ///< round-trip time of each answered frame
  StampSource source = StampSource::process;  ///< source of the answers' time stamps
};

/// Sends eight-byte frames from `near` to `far`, one after the other; `far` answers each frame. Sends
/// `frames` frames, or fewer if stop() returns true or if many frames in a row are lost. All frames from
/// `near` have one id, and all answers have another id. These are the two largest ids up to 0x7EF (lowest
/// priority) that the DBC does not use.
LoopResult measure_loop(Port& near, Port& far, int frames, const std::function<bool()>& stop);

/// The finding about the result of measure_loop().
Line loop_line(const LoopResult& result, const std::string& near, const std::string& far);

}  // namespace canhil::doctor
