/* The functions of FMI 2.0 for a model: only what a co-simulation calls, and each in its state. */
#include <stdlib.h>
#include <string.h>

#include "model.h"

struct callbacks {
  void (*logger)(void*, const char*, int, const char*, const char*, ...);
  void* (*allocate)(size_t, size_t);
  void (*release)(void*);
  void (*finished)(void*, int);
  void* environment;
};

enum state { instantiated, experiment_set, initializing, stepping, ended };

struct instance {
  struct model m;
  const struct callbacks* calls;
  enum state state;
  char resources[512];
  int ends;
};

static int done(struct instance* i, enum model_status status) {
  if (status != model_ok && i->m.message)
    i->calls->logger(i->calls->environment, "", (int)status, "logStatusError", "%s (%d)", i->m.message, 42);
  if (status != model_ok) i->state = ended;
  if (status == model_fatal) i->calls->release(i); /* nothing may be called any more */
  return (int)status;
}

static int change(struct instance* i, enum state from, enum state to) {
  i->m.message = "called in a wrong order";
  if (i->state != from) return done(i, model_error);
  i->m.message = 0;
  i->state = to;
  return 0;
}

void* fmi2Instantiate(const char* name, int kind, const char* guid, const char* resources,
                      const struct callbacks* calls, int visible, int log) {
  if (!name || !*name || kind != 1 || visible || strncmp(resources, "file:///", 8) != 0) return 0;
  if (strcmp(guid, model_token) != 0) {
    calls->logger(calls->environment, name, 3, "logStatusError", "wrong guid %s", guid);
    return 0;
  }
  struct instance* i = calls->allocate(1, sizeof *i);
  i->calls = calls;
  strncpy(i->resources, resources + 7, sizeof i->resources - 1);
  model_create(&i->m);
  if (log) calls->logger(calls->environment, name, 0, "logEvents", "hello\n");
  return i;
}
void fmi2FreeInstance(struct instance* i) { i->calls->release(i); }

int fmi2SetupExperiment(struct instance* i, int tolerance_defined, double tolerance, double start_s,
                        int stop_defined, double stop_s) {
  (void)tolerance_defined, (void)tolerance, (void)stop_s;
  if (start_s != 0 || stop_defined) return 3;
  return change(i, instantiated, experiment_set);
}
int fmi2EnterInitializationMode(struct instance* i) { return change(i, experiment_set, initializing); }
int fmi2ExitInitializationMode(struct instance* i) {
  const int status = change(i, initializing, stepping);
  return status ? status : done(i, model_initialize(&i->m, i->resources));
}
int fmi2Terminate(struct instance* i) { return change(i, stepping, ended); }

#ifndef WITHOUT_STEP
int fmi2DoStep(struct instance* i, double from_s, double step_s, int no_return) {
  if (i->state != stepping || !no_return) return 3;
  const enum model_status status = model_step(&i->m, from_s, step_s);
  i->ends = status == model_ends;
  return i->ends ? 2 : done(i, status);
}
#endif
int fmi2GetBooleanStatus(struct instance* i, int kind, int* value) {
  *value = i->ends;
  return kind == 3 ? 0 : 3;
}

#define ACCESS(NAME, TYPE)                                                               \
  int fmi2Set##NAME(struct instance* i, const unsigned* at, size_t n, const TYPE* from) { \
    for (size_t k = 0; k < n; ++k) i->m.v[at[k]] = from[k];                               \
    return 0;                                                                             \
  }                                                                                       \
  int fmi2Get##NAME(struct instance* i, const unsigned* at, size_t n, TYPE* to) {         \
    if (i->state != stepping) return 3;                                                   \
    for (size_t k = 0; k < n; ++k) to[k] = (TYPE)i->m.v[at[k]];                           \
    return 0;                                                                             \
  }
ACCESS(Real, double)
ACCESS(Integer, int)
ACCESS(Boolean, int)

int fmi2SetString(struct instance* i, const unsigned* at, size_t n, const char* const* from) {
  for (size_t k = 0; k < n; ++k) strncpy(i->m.texts[at[k]], from[k], sizeof i->m.texts[0] - 1);
  return 0;
}
