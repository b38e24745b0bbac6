/* A model behind the functions of FMI 2.0 (fmi2.c) or FMI 3.0 (fmi3.c). Its variables are numbers; the value
   reference of a variable is the index of its first element. */
#ifndef MODEL_H
#define MODEL_H

enum { model_variables = 100, model_texts = 4 };

/* The status that a function returns; the numbers are those of FMI. model_ends: the simulation shall end. */
enum model_status { model_ok = 0, model_discard = 2, model_error = 3, model_fatal = 4, model_ends = 100 };

struct model {
  double v[model_variables];
  char texts[model_texts][64];
  const char* message; /* what the model logs when it fails; may be null */
};

/* The token by which modelDescription.xml names the model. */
extern const char model_token[];

/* Sets the start values. */
void model_create(struct model* m);
/* Computes the outputs after all parameters and start values are set. */
enum model_status model_initialize(struct model* m, const char* resources);
enum model_status model_step(struct model* m, double from_s, double step_s);

#endif
