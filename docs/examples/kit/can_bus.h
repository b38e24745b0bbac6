/* A CAN bus for a Linux process: SocketCAN, or the embedded bus local:NAME of hil-bench. Classic frames with ids of 11 bits. */
#ifndef CANHIL_CAN_BUS_H
#define CANHIL_CAN_BUS_H

#include <time.h>

#include "canhil_target.h"

typedef struct {
  int socket;
  bool local;
  clockid_t stamp_clock; /* of the stamps of received frames */
} can_bus;

/* Opens can0, vcan0 or local:NAME. False: errno says why not. */
bool can_bus_open(can_bus* b, const char* name);
/* Of a can_bus. One who has no room for 50 ms loses the frame. */
void can_bus_send(void* b, const canhil_frame* frame);
/* 1: a frame, with its stamp [ns]; 0: none waits; -1: the bus is gone. Frames of no interest have an id that no message has. */
int can_bus_receive(can_bus* b, canhil_frame* frame, int64_t* stamp_ns);
/* Now [ns]. */
int64_t can_bus_clock_ns(clockid_t clock);

#endif
