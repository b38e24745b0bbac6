/* Runs the kit's target as a Linux process, on SocketCAN or on the embedded bus local:NAME. */
#ifndef CANHIL_LINUX_BUS_H
#define CANHIL_LINUX_BUS_H

#include "canhil_target.h"

/* Runs the target until a signal comes or the bus ends. argv must contain `--bus BUS`, which hil-bench appends to the target's command.
 * Returns the exit code of the program: 0, or 2 after one line on standard error. */
int canhil_serve(const canhil_estimator* estimator, int argc, char** argv);

#endif
