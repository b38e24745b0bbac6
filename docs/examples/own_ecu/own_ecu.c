/* An attitude ECU with a DBC of its own, own_ecu.dbc. It is independent of hil-bench. own_ecu.py is the same ECU in Python. */
#define _DEFAULT_SOURCE
#include <math.h>
#include <poll.h>
#include <stdio.h>
#include <string.h>

#include "can_bus.h" /* SocketCAN or the bench's embedded bus */

enum { IMU = 0x174, IMU_STEP = 4, ATTITUDE = 0x200, STATUS = 0x201, STATUS_NS = 100000000 };
static const double PI = 3.14159265358979323846, DT = 0.01, LEVELLING_S = 60;

static struct {
  uint8_t parts[3][8], counter;
  bool started;
  double roll, pitch; /* [rad], axes forward, left, up */
} ecu;

static uint8_t crc(const uint8_t* data, int size) { /* CRC-8/SAE-J1850 */
  uint8_t value = 0xFF;
  for (; size > 0; --size) {
    int bit;
    value ^= *data++;
    for (bit = 0; bit < 8; ++bit) value = (uint8_t)(value & 0x80 ? value << 1 ^ 0x1D : value << 1);
  }
  return value ^ 0xFF;
}

static double word(int part, int at, double scale, double offset) {
  return (ecu.parts[part][at] | ecu.parts[part][at + 1] << 8) * scale + offset;
}

/* Integrates the rates [rad/s] and corrects roll and pitch slowly by the specific force [g]. */
static void sample(double p, double q, double r, double forward, double left, double up) {
  const double roll = atan2(left, up), pitch = atan2(-forward, hypot(left, up)), share = DT / LEVELLING_S;
  const double at = ecu.started ? ecu.roll : roll, up_at = ecu.started ? ecu.pitch : pitch;
  ecu.roll = at + (p + (q * sin(at) + r * cos(at)) * tan(up_at)) * DT + share * (roll - at);
  ecu.pitch = up_at + (q * cos(at) - r * sin(at)) * DT + share * (pitch - up_at);
  ecu.started = true;
}

/* Returns true if the frame completed a sample; `out` is then the answer. */
static bool receive(const canhil_frame* in, canhil_frame* out) {
  const int part = (in->id - IMU) / IMU_STEP, c = in->data[6] & 0xF;
  const double rate = 0.005 * PI / 180, rate_0 = -163.84 * PI / 180, force = 0.000127465, force_0 = -4.1768;
  int roll, pitch;
  if (in->id < IMU || in->id > IMU + 2 * IMU_STEP || (in->id - IMU) % IMU_STEP || in->size != 8 || crc(in->data, 7) != in->data[7])
    return false;
  memcpy(ecu.parts[part], in->data, 8);
  if (part != 2 || (ecu.parts[0][6] & 0xF) != c || (ecu.parts[1][6] & 0xF) != c) return false; /* the sample is not complete */
  sample(word(1, 0, rate, rate_0), word(2, 0, rate, rate_0), word(0, 0, rate, rate_0), word(1, 2, force, force_0),
         word(0, 2, force, force_0), word(2, 2, force, force_0));
  roll = (int)lround(ecu.roll * 18000 / PI), pitch = (int)lround(ecu.pitch * 18000 / PI);
  memset(out, 0, sizeof *out);
  out->id = ATTITUDE, out->size = 8;
  out->data[0] = (uint8_t)(roll >> 8), out->data[1] = (uint8_t)roll;
  out->data[2] = (uint8_t)(pitch >> 8), out->data[3] = (uint8_t)pitch;
  out->data[4] = (uint8_t)c, out->data[6] = ecu.counter, out->data[7] = crc(out->data, 7);
  ecu.counter = (uint8_t)((ecu.counter + 1) % 16);
  return true;
}

int main(int argc, char** argv) {
  can_bus bus;
  int64_t stamp_ns, due_ns = 0;
  if (argc != 3 || strcmp(argv[1], "--bus") != 0 || !can_bus_open(&bus, argv[2])) {
    fprintf(stderr, "%s: expected --bus and a bus that is there\n", argv[0]);
    return 2;
  }
  for (;;) {
    struct pollfd waiting = {0, POLLIN, 0};
    canhil_frame in, out;
    int got;
    waiting.fd = bus.socket;
    poll(&waiting, 1, 20);
    while ((got = can_bus_receive(&bus, &in, &stamp_ns)) > 0) {
      if (receive(&in, &out)) can_bus_send(&bus, &out);
    }
    if (got < 0) return 0;
    if (can_bus_clock_ns(CLOCK_MONOTONIC) < due_ns) continue;
    due_ns = can_bus_clock_ns(CLOCK_MONOTONIC) + STATUS_NS;
    memset(&out, 0, sizeof out);
    out.id = STATUS, out.size = 2, out.data[0] = ecu.started, out.data[1] = 65;
    can_bus_send(&bus, &out);
  }
}
