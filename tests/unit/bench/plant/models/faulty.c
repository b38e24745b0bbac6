/* Does something wrong in the step that reaches parameter 1 [s]; parameter 0 says what. Output 2 is the time. */
#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <unistd.h>

#include "model.h"

const char model_token[] = "{faulty}";

enum { what, at_s, output };
enum { nothing, fails, discards, is_fatal, hangs, crashes, exits, writes_nan, fails_at_start, ends };

void model_create(struct model* m) { m->v[at_s] = 1; }

enum model_status model_initialize(struct model* m, const char* resources) {
  (void)resources;
  m->message = "no such luck";
  return m->v[what] == fails_at_start ? model_error : model_ok;
}

enum model_status model_step(struct model* m, double from_s, double step_s) {
  const double to_s = from_s + step_s;
  m->v[output] = to_s;
  m->message = "the valve is stuck\nat the stop";
  if (to_s < m->v[at_s] - 1e-9) return model_ok;
  switch ((int)m->v[what]) {
    case fails:
      return model_error;
    case discards:
      return model_discard;
    case is_fatal:
      return model_fatal;
    case hangs:
      for (;;) pause();
    case crashes:
      signal(SIGSEGV, SIG_DFL); /* a sanitizer handles it otherwise */
      raise(SIGSEGV);
      return model_ok;
    case exits:
      exit(3);
    case ends:
      return model_ends;
    case writes_nan:
      m->v[output] = NAN;
      return model_ok;
    default:
      return model_ok;
  }
}
