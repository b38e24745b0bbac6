// Frames from one interface to another and back.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/doctor/line.hpp"
#include "dbc/ports/port.hpp"

namespace canhil::doctor {

/// What became of the frames.
struct LoopResult {
  int sent = 0;
  int lost = 0;                               ///< without an answer in time
  std::vector<double> round_trip_s;           ///< of those that came back
  StampSource source = StampSource::process;  ///< of the stamps on the frames that came back
};

/// Sends frames of eight bytes one after the other from `near` to `far`, which answers each; `frames` of
/// them, fewer when stop() says so or when many in a row are lost. Their ids are the two least urgent ones
/// that the DBC leaves free.
LoopResult measure_loop(Port& near, Port& far, int frames, const std::function<bool()>& stop);

/// Its figures.
Line loop_line(const LoopResult& result, const std::string& near, const std::string& far);

}  // namespace canhil::doctor
