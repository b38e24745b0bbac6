/* The heading of a ship or a car: the equations and the method of bench/plant/steered_heading.cpp, in SI. */
#include <math.h>

#include "model.h"

const char model_token[] = "{heading}";

enum {
  rudder_command,
  /* parameters */
  start_heading,
  speed,
  time_constant,
  gain,
  lag,
  rate_limit,
  stop,
  gust,
  gust_from,
  gust_to,
  /* outputs */
  heading = 20,
  north,
  east,
  turn_rate,
  rudder
};

struct state {
  double heading, rate, rudder;
};

static double clamped(double value, double most) { return fmax(-most, fmin(value, most)); }

static double gust_at(const double* v, double t) {
  const double pi = 3.14159265358979323846;
  if (v[gust_to] <= v[gust_from] || t <= v[gust_from] || t >= v[gust_to]) return 0;
  return v[gust] * (1 - cos(2 * pi * (t - v[gust_from]) / (v[gust_to] - v[gust_from]))) / 2;
}

static struct state derivative(const double* v, double t, struct state x, double wanted) {
  const double moving = v[lag] > 0 ? clamped((wanted - x.rudder) / v[lag], v[rate_limit]) : 0;
  return (struct state){x.rate, (v[gain] * x.rudder - x.rate) / v[time_constant] + gust_at(v, t), moving};
}

static struct state plus(struct state x, double dt, struct state d) {
  return (struct state){x.heading + dt * d.heading, x.rate + dt * d.rate, x.rudder + dt * d.rudder};
}

static void show(double* v, struct state x) {
  v[heading] = x.heading;
  v[north] = v[speed] * cos(x.heading);
  v[east] = v[speed] * sin(x.heading);
  v[turn_rate] = x.rate;
  v[rudder] = x.rudder;
}

void model_create(struct model* m) {
  m->v[time_constant] = 1;
  m->v[gain] = 1;
  m->v[rate_limit] = 1;
  m->v[stop] = 1;
}

enum model_status model_initialize(struct model* m, const char* resources) {
  (void)resources;
  show(m->v, (struct state){m->v[start_heading], 0, 0});
  return model_ok;
}

enum model_status model_step(struct model* m, double from_s, double step_s) {
  double* v = m->v;
  const double wanted = clamped(v[rudder_command], v[stop]);
  const int steps = (int)ceil(step_s * 1e3 - 1e-6);
  const double dt = step_s / steps;
  struct state x = {v[heading], v[turn_rate], v[rudder]};
  for (int i = 0; i < steps; ++i) {
    const double t = from_s + i * dt;
    if (v[lag] <= 0) x.rudder += clamped(wanted - x.rudder, v[rate_limit] * dt);
    const struct state k1 = derivative(v, t, x, wanted);
    const struct state k2 = derivative(v, t + dt / 2, plus(x, dt / 2, k1), wanted);
    const struct state k3 = derivative(v, t + dt / 2, plus(x, dt / 2, k2), wanted);
    const struct state k4 = derivative(v, t + dt, plus(x, dt, k3), wanted);
    x.heading += dt / 6 * (k1.heading + 2 * k2.heading + 2 * k3.heading + k4.heading);
    x.rate += dt / 6 * (k1.rate + 2 * k2.rate + 2 * k3.rate + k4.rate);
    x.rudder += dt / 6 * (k1.rudder + 2 * k2.rudder + 2 * k3.rudder + k4.rudder);
  }
  show(v, x);
  return model_ok;
}
