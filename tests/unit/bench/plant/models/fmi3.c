/* The functions of FMI 3.0 for a model: only what a co-simulation calls, and each in its state. */
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "model.h"

typedef void log_message(void*, int, const char*, const char*);

enum state { instantiated, configuring, initializing, stepping, ended };

struct instance {
  struct model m;
  log_message* log;
  void* environment;
  enum state state;
  char resources[512];
};

static int done(struct instance* i, enum model_status status) {
  if (status != model_ok && i->m.message)
    i->log(i->environment, (int)status, "logStatusError", i->m.message);
  if (status != model_ok) i->state = ended;
  if (status == model_fatal) free(i); /* nothing may be called any more */
  return (int)status;
}

static int change(struct instance* i, enum state from, enum state to) {
  i->m.message = "called in a wrong order";
  if (i->state != from) return done(i, model_error);
  i->m.message = 0;
  i->state = to;
  return 0;
}

void* fmi3InstantiateCoSimulation(const char* name, const char* token, const char* resources, bool visible,
                                  bool log, bool event_mode, bool early_return, const uint32_t* intermediate,
                                  size_t intermediates, void* environment, log_message* logger,
                                  void (*update)(void)) {
  (void)intermediate, (void)update;
  if (!name || !*name || visible || event_mode || early_return || intermediates) return 0;
  if (strcmp(token, model_token) != 0) {
    logger(environment, 3, "logStatusError", "wrong token");
    return 0;
  }
  struct instance* i = calloc(1, sizeof *i);
  i->log = logger;
  i->environment = environment;
  if (resources) strncpy(i->resources, resources, sizeof i->resources - 1);
  model_create(&i->m);
  if (log) logger(environment, 0, "logEvents", "hello\n");
  return i;
}
void fmi3FreeInstance(struct instance* i) { free(i); }

int fmi3EnterConfigurationMode(struct instance* i) { return change(i, instantiated, configuring); }
int fmi3ExitConfigurationMode(struct instance* i) { return change(i, configuring, instantiated); }
int fmi3EnterInitializationMode(struct instance* i, bool tolerance_defined, double tolerance, double start_s,
                                bool stop_defined, double stop_s) {
  (void)tolerance_defined, (void)tolerance, (void)stop_s;
  if (start_s != 0 || stop_defined) return 3;
  return change(i, instantiated, initializing);
}
int fmi3ExitInitializationMode(struct instance* i) {
  const int status = change(i, initializing, stepping);
  return status ? status : done(i, model_initialize(&i->m, i->resources));
}
int fmi3Terminate(struct instance* i) { return change(i, stepping, ended); }

#ifndef WITHOUT_STEP
int fmi3DoStep(struct instance* i, double from_s, double step_s, bool no_return, bool* event, bool* terminate,
               bool* early, double* reached_s) {
  if (i->state != stepping || !no_return) return 3;
  *event = *terminate = *early = false;
  *reached_s = from_s + step_s;
#ifdef RETURNS_EARLY /* it makes a step in four calls, although it may not */
  static int calls = 0;
  if (++calls % 4 != 0) {
    *early = true;
    *reached_s = from_s + step_s / 2;
    step_s /= 2;
  }
#endif
  const enum model_status status = model_step(&i->m, from_s, step_s);
  *terminate = status == model_ends;
  return *terminate ? 0 : done(i, status);
}
#endif

#define ACCESS(NAME, TYPE)                                                                           \
  int fmi3Set##NAME(struct instance* i, const uint32_t* at, size_t n, const TYPE* from, size_t all) { \
    if (n != 1) return 3;                                                                             \
    for (size_t k = 0; k < all; ++k) i->m.v[at[0] + k] = (double)from[k];                             \
    return 0;                                                                                         \
  }                                                                                                   \
  int fmi3Get##NAME(struct instance* i, const uint32_t* at, size_t n, TYPE* to, size_t all) {         \
    if (n != 1 || i->state != stepping) return 3;                                                     \
    for (size_t k = 0; k < all; ++k) to[k] = (TYPE)i->m.v[at[0] + k];                                 \
    return 0;                                                                                         \
  }
ACCESS(Float32, float)
ACCESS(Float64, double)
ACCESS(Int8, int8_t)
ACCESS(UInt8, uint8_t)
ACCESS(Int16, int16_t)
ACCESS(UInt16, uint16_t)
ACCESS(Int32, int32_t)
ACCESS(UInt32, uint32_t)
ACCESS(Int64, int64_t)
ACCESS(UInt64, uint64_t)
ACCESS(Boolean, bool)

int fmi3SetString(struct instance* i, const uint32_t* at, size_t n, const char* const* from, size_t all) {
  if (n != 1) return 3;
  for (size_t k = 0; k < all; ++k) strncpy(i->m.texts[at[0] + k], from[k], sizeof i->m.texts[0] - 1);
  return 0;
}
