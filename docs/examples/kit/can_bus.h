/* A CAN bus for a Linux process: SocketCAN, or the embedded bus local:NAME of hil-bench. Classic frames with 11-bit ids. */
#ifndef CANHIL_CAN_BUS_H
#define CANHIL_CAN_BUS_H

#include <time.h>

#include "canhil_target.h"

typedef struct {
  int socket;
  bool local;
  clockid_t stamp_clock; /* clock of the stamps of received frames */
} can_bus;

/* Opens can0, vcan0 or local:NAME. On failure returns false and sets errno. */
bool can_bus_open(can_bus* b, const char* name);
/* Sends a frame; b is a can_bus. A frame is lost if the bus has no room for 50 ms. */
void can_bus_send(void* b, const canhil_frame* frame);
/* Returns 1: a frame, with its stamp [ns]; 0: no frame waits; -1: the bus has ended. A frame of another kind gets the id 0xFFFF, which no
 * message has. */
int can_bus_receive(can_bus* b, canhil_frame* frame, int64_t* stamp_ns);
/* Now [ns]. */
int64_t can_bus_clock_ns(clockid_t clock);

#endif
