/* The kit's target as a Linux process, on SocketCAN or on the embedded bus local:NAME. */
#ifndef CANHIL_LINUX_BUS_H
#define CANHIL_LINUX_BUS_H

#include "canhil_target.h"

/* Runs the target until a signal or the end of the bus. The command line is the one that hil-bench appends: --bus BUS. Returns the exit
 * code: 0, or 2 after one line on standard error. */
int canhil_serve(const canhil_estimator* estimator, int argc, char** argv);

#endif
