/* Access of a Linux process to a CAN bus: SocketCAN, or the embedded bus local:NAME of hil-bench. Only classic frames with 11-bit ids. */
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
/* Sends a frame; b points to a can_bus. If the bus accepts no frame for 50 ms, the frame is lost. */
void can_bus_send(void* b, const canhil_frame* frame);
/* Receives a frame and its stamp [ns]. Returns 1 if there was one, 0 if no frame is waiting, -1 if the bus has ended. A frame that is not a
 * classic frame with an 11-bit id gets the id 0xFFFF, which no message has. */
int can_bus_receive(can_bus* b, canhil_frame* frame, int64_t* stamp_ns);
/* The present time of this clock [ns]. */
int64_t can_bus_clock_ns(clockid_t clock);

#endif
