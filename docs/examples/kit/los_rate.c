/* An example of the kit: an alpha-beta-gamma filter that estimates the line-of-sight rate of a seeker.
 *   cc -std=c99 -O2 -ffp-contract=off -o los_rate los_rate.c canhil_target.c linux_bus.c can_bus.c -lm
 *   hil-bench run bench/flights/los_quick.toml --target ./los_rate
 * los_rate.py is the same filter in Python; its answers are bit for bit the same. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "linux_bus.h"

/* The parameters that los_quick.toml sets. */
enum { THERMAL_PITCH, THERMAL_YAW, GLINT_PITCH, GLINT_YAW, SAMPLE_PERIOD, RANGE_SIGMA, JERK, PARAMETERS };
static const canhil_parameter parameters[PARAMETERS] = {
    {CANHIL_PARAMETER_THERMAL_NOISE_PITCH_RADPM2, 1e-10, 1e-14, 1e-6, false, false},
    {CANHIL_PARAMETER_THERMAL_NOISE_YAW_RADPM2, 1e-10, 1e-14, 1e-6, false, false},
    {CANHIL_PARAMETER_GLINT_NOISE_PITCH_M, 0.5, 1e-3, 100, false, false},
    {CANHIL_PARAMETER_GLINT_NOISE_YAW_M, 0.5, 1e-3, 100, false, false},
    {CANHIL_PARAMETER_SAMPLE_PERIOD_MS, 5, 0.5, 50, false, false},
    {CANHIL_PARAMETER_RANGE_SIGMA_M, 15, 0, 1e3, false, false},
    {CANHIL_PARAMETER_JERK_DENSITY_M2PS5, 300, 1e-3, 1e6, false, true},
};
static const uint8_t algorithms[] = {CANHIL_ALGORITHM_COMBINED, CANHIL_ALGORITHM_LOW_PASS};
static const canhil_answer answers[] = {{CANHIL_GROUP_SEEKER, CANHIL_GROUP_LOS_RATE}};
static const double least_range_m = 50; /* a shorter measured range is replaced by this one, because the filter divides by the range */

/* One plane of the seeker. */
typedef struct {
  double error, rate, target; /* angle from antenna to LOS [rad], inertial LOS rate [rad/s], acceleration of the seeker's target [m/s2] */
  double sigma, nis;
} plane;

typedef struct {
  const double* parameters;
  double gain; /* a larger gain follows the target faster, a smaller gain smooths more */
  plane pitch, yaw;
  unsigned updates;
  int64_t t_us;
  bool timed;
} filter;

/* Processes the n-th sample. measured: error angle; turned: rotation of the antenna; missile: acceleration of the missile; reach: range;
 * noise [rad]; agility [m/s2]. The model: d(rate)/dt = (2 closing rate + target - missile) / range. */
static void step(plane* p, double measured, double turned, double missile, double dt, double reach, double closing, double noise,
                 double agility, double n) {
  /* The gains follow from Kalata's tracking index, the ratio of target manoeuvre to measurement noise (IEEE AES-20 (1984), 174). */
  const double index = agility / reach * dt * dt / noise;
  const double root = (4 + index - sqrt(8 * index + index * index)) / 4;
  double alpha = 1 - root * root, beta = 2 * (2 - alpha) - 4 * root;
  const double gamma = beta * beta / alpha;
  double innovation;
  p->error += p->rate * dt - turned;
  p->rate += (2 * closing * p->rate + p->target - missile) / reach * dt;
  if (n > 1) { /* the gains of a straight line through the first n samples are used as long as they are larger */
    alpha = fmax(alpha, fmin(2 * (2 * n - 1) / (n * (n + 1)), 0.99));
    beta = fmax(beta, 6 / (n * (n + 1)));
  } else {
    alpha = 0.99;
    beta = 0;
  }
  innovation = measured - p->error;
  p->error += alpha * innovation;
  p->rate += beta / dt * innovation;
  p->target += reach * gamma / (dt * dt) * innovation;
  p->nis = innovation * innovation * (1 - alpha) / (noise * noise); /* because alpha = P / (P + noise^2) */
  p->sigma = noise / dt * sqrt(fmax(beta * (alpha - beta / 2) / (1 - alpha), 0));
}

static double noise_at(double thermal, double glint, double reach) {
  const double a = thermal * reach * reach, b = glint / reach;
  return sqrt(a * a + b * b);
}

static void start(void* state, uint8_t algorithm, const double* values, const double* initial) {
  const plane nothing = {0, 0, 0, 0, 0};
  filter* f = state;
  (void)algorithm;
  (void)initial;
  f->parameters = values;
  f->pitch = f->yaw = nothing;
  f->updates = 0;
  f->timed = false;
}

static bool sample(void* state, uint8_t group, const double* v, int64_t t_us, double* answer) {
  filter* f = state;
  const double* p = f->parameters;
  const double dt = f->timed ? (double)(t_us - f->t_us) * 1e-6 : p[SAMPLE_PERIOD] * 1e-3;
  const bool valid = v[CANHIL_SEEKER_ERROR_VALIDITY] != 0 && v[CANHIL_SEEKER_ANTENNA_VALIDITY] != 0 &&
                     v[CANHIL_SEEKER_ACCELERATION_VALIDITY] != 0 && v[CANHIL_SEEKER_CLOSING_SPEED_VALIDITY] != 0 &&
                     v[CANHIL_SEEKER_RANGE_VALIDITY] != 0;
  double outcome = f->updates > 0 ? CANHIL_LOS_RATE_OUTCOME_COASTING : CANHIL_LOS_RATE_OUTCOME_WAITING;
  (void)group; /* there is only one input group */
  f->t_us = t_us;
  f->timed = true;
  if (valid) {
    const double reach = fmax(v[CANHIL_SEEKER_RANGE_M], least_range_m), closing = v[CANHIL_SEEKER_CLOSING_SPEED_MPS];
    const double agility = f->gain * sqrt(p[JERK]);
    outcome = f->updates > 0 ? CANHIL_LOS_RATE_OUTCOME_UPDATED : CANHIL_LOS_RATE_OUTCOME_STARTED;
    ++f->updates;
    step(&f->pitch, v[CANHIL_SEEKER_ERROR_PITCH_RAD], v[CANHIL_SEEKER_ANTENNA_INCREMENT_PITCH_RAD],
         -v[CANHIL_SEEKER_MISSILE_ACCELERATION_Z_MPS2], dt, reach, closing, noise_at(p[THERMAL_PITCH], p[GLINT_PITCH], reach), agility,
         f->updates);
    step(&f->yaw, v[CANHIL_SEEKER_ERROR_YAW_RAD], v[CANHIL_SEEKER_ANTENNA_INCREMENT_YAW_RAD],
         v[CANHIL_SEEKER_MISSILE_ACCELERATION_Y_MPS2], dt, reach, closing, noise_at(p[THERMAL_YAW], p[GLINT_YAW], reach), agility,
         f->updates);
    answer[CANHIL_LOS_RATE_NIS] = f->pitch.nis + f->yaw.nis;
  }
  answer[CANHIL_LOS_RATE_OUTCOME] = outcome;
  answer[CANHIL_LOS_RATE_LOS_RATE_PITCH_RADPS] = f->pitch.rate;
  answer[CANHIL_LOS_RATE_LOS_RATE_YAW_RADPS] = f->yaw.rate;
  answer[CANHIL_LOS_RATE_LOS_RATE_SIGMA_PITCH_RADPS] = f->pitch.sigma;
  answer[CANHIL_LOS_RATE_LOS_RATE_SIGMA_YAW_RADPS] = f->yaw.sigma;
  answer[CANHIL_LOS_RATE_TARGET_ACCELERATION_Z_MPS2] = -f->pitch.target;
  answer[CANHIL_LOS_RATE_TARGET_ACCELERATION_Y_MPS2] = f->yaw.target;
  return true;
}

int main(int argc, char** argv) {
  static filter state;
  static const canhil_estimator estimator = {CANHIL_ESTIMATOR_LOS_RATE, algorithms, sizeof algorithms, answers, 1, parameters,
                                             PARAMETERS, start, sample, &state};
  state.gain = 4;
  if (argc > 2 && strcmp(argv[1], "--gain") == 0) { /* an option of this example */
    state.gain = strtod(argv[2], NULL);
    argv[2] = argv[0];
    argv += 2;
    argc -= 2;
  }
  return canhil_serve(&estimator, argc, argv);
}
