#define _DEFAULT_SOURCE
#include "linux_bus.h"

#include <errno.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#include "can_bus.h"

static volatile sig_atomic_t stop;
static void on_signal(int number) {
  (void)number;
  stop = 1;
}

static int complain(const char* program, const char* what, const char* why) {
  fprintf(stderr, "%s: %s: %s\n", program, what, why);
  return 2;
}

static uint32_t microseconds(int64_t ns) { return ns < 0 ? 0 : (uint32_t)(ns / 1000); }

int canhil_serve(const canhil_estimator* estimator, int argc, char** argv) {
  static canhil_target target;
  static can_bus b;
  const int64_t listen_ns = (int64_t)CANHIL_HEARTBEAT_MS * 1250000; /* listens for 1.25 heartbeat periods: is there already a target on the bus? */
  int64_t begun_ns;
  const char* name = NULL;
  bool established = false;
  int i;
  for (i = 1; i < argc; i += 2) {
    if (strcmp(argv[i], "--bus") != 0) return complain(argv[0], argv[i], "is unknown, expected --bus BUS");
    if (name != NULL) return complain(argv[0], "--bus", "is given twice, expected one bus");
    if (i + 1 == argc) return complain(argv[0], "--bus", "expected the name of a bus behind it");
    name = argv[i + 1];
  }
  if (name == NULL) return complain(argv[0], "--bus", "is required: can0, vcan0 or local:NAME");
  if (!can_bus_open(&b, name)) return complain(argv[0], name, strerror(errno));
  signal(SIGINT, on_signal);
  signal(SIGTERM, on_signal);
  canhil_target_init(&target, estimator, can_bus_send, &b);
  begun_ns = can_bus_clock_ns(CLOCK_MONOTONIC);
  while (!stop) {
    struct pollfd waiting = {0, POLLIN, 0};
    int left;
    waiting.fd = b.socket;
    poll(&waiting, 1, 20);
    for (left = 256; left > 0; --left) { /* checks the clock after 256 frames, even if further frames are waiting */
      canhil_frame frame;
      int64_t stamp_ns, start_ns;
      const int got = can_bus_receive(&b, &frame, &stamp_ns);
      if (got < 0) return 0;
      if (got == 0) break;
      if (!established && canhil_is_heartbeat(&frame))
        return complain(argv[0], name, "a target answers here already, expected to be the only one");
      if (!established) continue;
      start_ns = can_bus_clock_ns(b.stamp_clock);
      if (canhil_target_receive(&target, &frame))
        canhil_target_measured(&target, microseconds(start_ns - stamp_ns), microseconds(can_bus_clock_ns(b.stamp_clock) - start_ns));
    }
    established = established || can_bus_clock_ns(CLOCK_MONOTONIC) - begun_ns >= listen_ns;
    if (established) canhil_target_poll(&target, (uint32_t)(can_bus_clock_ns(CLOCK_MONOTONIC) / 1000000));
  }
  return 0;
}
