// A program outside the project that uses the installed libraries. It reads a recorded run, packs a message
// of another DBC (own.dbc, which belongs to this program), and uses the Earth model.
#include <cstdio>

#include "dbc/logs/log.hpp"
#include "dbc/wire/message.hpp"
#include "messages/canhil.hpp"
#include "messages/own.hpp"
#include "target/estimators/strapdown/earth.hpp"

int main(int, char** argv) {
  auto log = canhil::LogReader::open(argv[1]);
  if (!log) return 2;
  int answers = 0;
  while (const auto entry = log->next().value_or(std::nullopt)) {
    if (entry->frame.id == canhil::messages::AlignAttitude::info.id) ++answers;
  }
  const canhil::Frame frame = canhil::to_frame(own::FourSignals{.speed = 88}, 0);
  std::printf("%d answers; %g km/h in %d bytes; gravity %.4f m/s^2\n", answers,
              canhil::from_frame<own::FourSignals>(frame).speed, frame.size,
              canhil::strapdown::local_earth(0.6, 0).gravity);
}
