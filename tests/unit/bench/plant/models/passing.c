/* Passes its inputs on: element k of the inputs (value references 0 to 39) becomes element k of the outputs
   (40 to 79), plus the parameter 80. Output 79 is the length of text 0 plus the first byte of the file
   resources/offset.txt, if there is one. */
#include <stdio.h>
#include <string.h>

#include "model.h"

const char model_token[] = "{passing}";

static void pass(struct model* m) {
  for (int k = 0; k < 39; ++k) m->v[40 + k] = m->v[k] + m->v[80];
}

void model_create(struct model* m) { strcpy(m->texts[0], "abc"); }

enum model_status model_initialize(struct model* m, const char* resources) {
  char path[600];
  snprintf(path, sizeof path, "%s/offset.txt", resources);
  FILE* file = fopen(path, "r");
  m->v[79] = (double)strlen(m->texts[0]) + (file ? fgetc(file) : 0);
  if (file) fclose(file);
  pass(m);
  return model_ok;
}

enum model_status model_step(struct model* m, double from_s, double step_s) {
  (void)from_s, (void)step_s;
  pass(m);
  return model_ok;
}
