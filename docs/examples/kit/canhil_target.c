#define CANHIL_TABLES
#include "canhil_target.h"

#include <math.h>
#include <string.h>

enum { NO_COUNTER = 0xFF, COUNTERS = 15 };
static const int64_t lead_limit_us = 100000;  /* a sample whose time is further ahead of the time base is rejected */
static const int64_t silence_limit_us = 500000; /* the target reports a longer silence of the sensor */
static const uint32_t bench_silent_ms = 2 * CANHIL_HEARTBEAT_MS, bench_gone_ms = 2000;

/* ---- frames ---- */

uint8_t canhil_crc(const uint8_t* data, unsigned size, uint16_t data_id) {
  uint8_t crc = 0;
  unsigned i, bit;
  for (i = 0; i <= size; ++i) { /* first the two bytes of the data id, then data[1..] */
    crc ^= i == 0 ? (uint8_t)(data_id & 0xFFU) : i == 1 ? (uint8_t)(data_id >> 8U) : data[i - 1];
    for (bit = 0; bit < 8; ++bit) crc = (uint8_t)((crc & 0x80U) != 0 ? ((unsigned)crc << 1U) ^ 0x1DU : (unsigned)crc << 1U);
  }
  return crc;
}

static uint64_t mask(unsigned length) { return length >= 64 ? ~(uint64_t)0 : ((uint64_t)1 << length) - 1; }

static double value_of(const uint8_t* data, const canhil_signal* signal) {
  uint64_t word = 0;
  unsigned i;
  double raw;
  for (i = 0; i < 8; ++i) word |= (uint64_t)data[i] << (8 * i);
  word = (word >> signal->start) & mask(signal->length);
  if (signal->kind == CANHIL_FLOAT) {
    const uint32_t bits = (uint32_t)word;
    float real;
    memcpy(&real, &bits, sizeof real);
    raw = (double)real;
  } else if (signal->kind == CANHIL_SIGNED && (word >> (signal->length - 1U)) != 0) {
    raw = -(double)(mask(signal->length) - word + 1);
  } else {
    raw = (double)word;
  }
  return raw * signal->scale + signal->offset;
}

/* Rounds half to even and clamps to the signal's range; NaN becomes the lowest value. */
static void put_value(uint8_t* data, const canhil_signal* signal, double value) {
  double raw = (value - signal->offset) / signal->scale;
  uint64_t word;
  unsigned i;
  if (!(raw > signal->lowest)) raw = signal->lowest;
  if (raw > signal->highest) raw = signal->highest;
  if (signal->kind == CANHIL_FLOAT) {
    const float real = (float)raw;
    uint32_t bits;
    memcpy(&bits, &real, sizeof bits);
    word = bits;
  } else {
    word = (uint64_t)(int64_t)nearbyint(raw);
  }
  word = (word & mask(signal->length)) << signal->start;
  for (i = 0; i < 8; ++i) data[i] = (uint8_t)(data[i] | (uint8_t)(word >> (8 * i)));
}

static void values_of(const canhil_target* target, unsigned group, double* values) {
  unsigned m, s;
  for (m = 0; m < canhil_groups[group].messages; ++m) {
    const unsigned index = canhil_groups[group].first_message + m;
    const canhil_message* message = &canhil_messages[index];
    for (s = 0; s < message->signals; ++s)
      values[message->first_value + s] = value_of(target->data[index], &canhil_signals[message->first_signal + s]);
  }
}

/* Sends all messages of a group in the order of their ids. The last message contains the time. */
static void send_group(canhil_target* target, unsigned group, const double* values) {
  unsigned m, s;
  for (m = 0; m < canhil_groups[group].messages; ++m) {
    const unsigned index = canhil_groups[group].first_message + m;
    const canhil_message* message = &canhil_messages[index];
    canhil_frame frame = {0, 0, {0}};
    frame.id = message->id;
    frame.size = message->size;
    for (s = 0; s < message->signals; ++s)
      put_value(frame.data, &canhil_signals[message->first_signal + s], values[message->first_value + s]);
    frame.data[1] = (uint8_t)(frame.data[1] | target->next[index]);
    frame.data[0] = canhil_crc(frame.data, frame.size, message->data_id);
    target->next[index] = (uint8_t)((target->next[index] + 1) % COUNTERS);
    target->send(target->bus, &frame);
  }
}

/* ---- status messages of the target ---- */

/* The hash of the messages that a run with this estimator exchanges. An unknown estimator exchanges those of every run, like none. */
static double hash_of(unsigned estimator) {
  unsigned i;
  for (i = 0; i < sizeof canhil_exchanges / sizeof canhil_exchanges[0]; ++i)
    if (canhil_exchanges[i].estimator == estimator) return (double)canhil_exchanges[i].hash24;
  return hash_of(CANHIL_ESTIMATOR_NONE);
}

static void send_heartbeat(canhil_target* target) {
  double v[CANHIL_TARGET_HEARTBEAT_VALUES] = {0};
  v[CANHIL_TARGET_HEARTBEAT_STATE] = target->state;
  v[CANHIL_TARGET_HEARTBEAT_ESTIMATOR] = target->selected;
  v[CANHIL_TARGET_HEARTBEAT_ALGORITHM] = target->algorithm;
  v[CANHIL_TARGET_HEARTBEAT_DBC_HASH] = hash_of(target->selected);
  v[CANHIL_TARGET_HEARTBEAT_ERROR_DBC_MISMATCH] = target->dbc_mismatch;
  v[CANHIL_TARGET_HEARTBEAT_ERROR_NOT_INITIALISED] = target->not_initialised;
  v[CANHIL_TARGET_HEARTBEAT_ERROR_INPUT_LOST] = target->input_lost;
  v[CANHIL_TARGET_HEARTBEAT_ERROR_INPUT_SILENT] = target->input_silent;
  v[CANHIL_TARGET_HEARTBEAT_ERROR_NUMERIC] = target->numeric;
  v[CANHIL_TARGET_HEARTBEAT_ERROR_COMMAND] = target->command;
  send_group(target, CANHIL_GROUP_TARGET_HEARTBEAT, v);
}

static void send_counters(canhil_target* target) {
  double v[CANHIL_TARGET_COUNTERS_VALUES];
  v[CANHIL_TARGET_COUNTERS_FRAMES_LOST] = target->frames_lost;
  v[CANHIL_TARGET_COUNTERS_BAD_CRC] = target->bad_crc;
  v[CANHIL_TARGET_COUNTERS_BAD_GROUP] = target->bad_group;
  v[CANHIL_TARGET_COUNTERS_LATE] = target->late;
  send_group(target, CANHIL_GROUP_TARGET_COUNTERS, v); /* a count beyond the signal's range is sent as the largest value */
}

static void enter(canhil_target* target, uint8_t state) {
  target->state = state;
  send_heartbeat(target);
}

/* ---- commands ---- */

/* Restores the state that the target has after program start. Keeps the clock of canhil_target_poll(). */
static void forget(canhil_target* target) {
  const canhil_target fresh = {0};
  canhil_target old = *target;
  unsigned i;
  *target = fresh;
  target->estimator = old.estimator;
  target->send = old.send;
  target->bus = old.bus;
  target->report_ms = old.report_ms;
  target->bench_ms = old.bench_ms;
  target->polled = old.polled;
  target->bench_heard = old.bench_heard;
  memset(target->received, NO_COUNTER, sizeof target->received);
  for (i = 0; i < target->estimator->parameter_count; ++i)
    target->parameters[i] = target->estimator->parameters[i].initial;
}

static void reset(canhil_target* target, uint8_t estimator, uint8_t algorithm) {
  unsigned i;
  forget(target);
  target->algorithm = algorithm;
  target->command = true;
  for (i = 0; i < target->estimator->algorithm_count; ++i) {
    if (estimator != target->estimator->estimator || algorithm != target->estimator->algorithms[i]) continue;
    target->selected = estimator;
    target->command = false;
  }
  enter(target, CANHIL_TARGET_STATE_IDLE);
}

static void start(canhil_target* target) {
  const bool again = target->state == CANHIL_TARGET_STATE_RUNNING && target->untouched;
  if (target->state == CANHIL_TARGET_STATE_READY || again) {
    memset(target->next, 0, sizeof target->next); /* with these resets, a repeated start command has the same effect as a single one */
    memset(target->answered, 0, sizeof target->answered);
    memset(target->seen, 0, sizeof target->seen);
    target->untouched = true;
    target->heard_us = target->now_us;
    target->estimator->start(target->estimator->state, target->algorithm, target->parameters, target->initial);
    enter(target, CANHIL_TARGET_STATE_RUNNING);
    return;
  }
  if (target->state == CANHIL_TARGET_STATE_IDLE) target->not_initialised = true;
  else target->command = true;
  send_heartbeat(target);
}

static void on_command(canhil_target* target, const double* v) {
  if (v[CANHIL_TARGET_COMMAND_DBC_HASH] != hash_of((unsigned)v[CANHIL_TARGET_COMMAND_ESTIMATOR])) {
    target->dbc_mismatch = true;
    send_heartbeat(target);
    return;
  }
  switch ((int)v[CANHIL_TARGET_COMMAND_COMMAND]) {
    case CANHIL_COMMAND_RESET:
      reset(target, (uint8_t)v[CANHIL_TARGET_COMMAND_ESTIMATOR], (uint8_t)v[CANHIL_TARGET_COMMAND_ALGORITHM]);
      return;
    case CANHIL_COMMAND_START:
      start(target);
      return;
    case CANHIL_COMMAND_STOP:
      enter(target, target->state == CANHIL_TARGET_STATE_RUNNING ? CANHIL_TARGET_STATE_IDLE : target->state);
      return;
    case CANHIL_COMMAND_NONE:
      break;
    default: /* unknown commands, and add: this target can run only one estimator */
      target->command = true;
  }
  send_heartbeat(target);
}

static void on_parameter(canhil_target* target, const double* request) {
  const double value = request[CANHIL_PARAM_SET_VALUE];
  double ack[CANHIL_PARAM_ACK_VALUES];
  unsigned i;
  ack[CANHIL_PARAM_ACK_PARAMETER] = request[CANHIL_PARAM_SET_PARAMETER];
  ack[CANHIL_PARAM_ACK_VALUE] = value;
  ack[CANHIL_PARAM_ACK_STATUS] = CANHIL_PARAMETER_STATUS_UNKNOWN;
  for (i = 0; target->selected != CANHIL_ESTIMATOR_NONE && i < target->estimator->parameter_count; ++i) {
    const canhil_parameter* parameter = &target->estimator->parameters[i];
    if (parameter->parameter != request[CANHIL_PARAM_SET_PARAMETER]) continue;
    if (target->state == CANHIL_TARGET_STATE_RUNNING && !parameter->while_running) {
      ack[CANHIL_PARAM_ACK_STATUS] = CANHIL_PARAMETER_STATUS_WRONG_STATE;
    } else if (!(value >= parameter->minimum && value <= parameter->maximum) ||
               (parameter->whole && nearbyint(value) != value)) {
      ack[CANHIL_PARAM_ACK_STATUS] = CANHIL_PARAMETER_STATUS_OUT_OF_RANGE; /* also for NaN */
    } else {
      ack[CANHIL_PARAM_ACK_STATUS] = CANHIL_PARAMETER_STATUS_ACCEPTED;
      target->parameters[i] = value;
    }
    ack[CANHIL_PARAM_ACK_VALUE] = target->parameters[i];
  }
  send_group(target, CANHIL_GROUP_PARAM_ACK, ack);
}

static void on_initial(canhil_target* target, const double* values) {
  memcpy(target->initial, values, sizeof target->initial);
  if (target->selected == CANHIL_ESTIMATOR_NONE || target->state == CANHIL_TARGET_STATE_FAULT) {
    target->command = true;
    send_heartbeat(target);
  } else {
    enter(target, CANHIL_TARGET_STATE_READY);
  }
}

/* ---- time and samples ---- */

static void on_sync(canhil_target* target, const double* v) {
  target->now_us = (int64_t)v[CANHIL_SYNC_TIME_US];
  target->lockstep = v[CANHIL_SYNC_LOCKSTEP] != 0;
  target->untouched = false;
  if (target->state == CANHIL_TARGET_STATE_RUNNING && target->now_us - target->heard_us > silence_limit_us)
    target->input_silent = true;
  if (target->now_us >= target->heartbeat_due_us) {
    const int64_t period_us = CANHIL_HEARTBEAT_MS * 1000;
    target->heartbeat_due_us = (target->now_us / period_us + 1) * period_us;
    send_heartbeat(target);
    send_counters(target);
  }
  if (target->lockstep) {
    double done[CANHIL_STEP_DONE_VALUES];
    done[CANHIL_STEP_DONE_STEP] = v[CANHIL_SYNC_STEP];
    send_group(target, CANHIL_GROUP_STEP_DONE, done);
  }
}

/* Unwraps a time that was sent modulo 2^length steps: returns the possible time that is nearest to the present time. */
static int64_t unwrapped_us(const canhil_target* target, unsigned group, double value) {
  const canhil_group* g = &canhil_groups[group];
  const canhil_message* last = &canhil_messages[g->first_message + g->messages - 1];
  const canhil_signal* signal = &canhil_signals[last->first_signal + (unsigned)(g->time - last->first_value)];
  const int64_t period = (int64_t)ldexp(signal->scale, signal->length);
  int64_t difference = ((int64_t)value - target->now_us) % period;
  if (difference < -(period / 2)) difference += period;
  if (difference >= period / 2) difference -= period;
  return target->now_us + difference;
}

static bool on_sample(canhil_target* target, unsigned which, const double* values) {
  const canhil_answer* pair = &target->estimator->answers[which];
  const canhil_group* input = &canhil_groups[pair->input];
  double answer[CANHIL_MOST_VALUES] = {0};
  int64_t t_us = target->now_us;
  if (input->time >= 0) t_us = unwrapped_us(target, pair->input, values[input->time]);
  if (t_us > target->now_us + lead_limit_us) {
    ++target->bad_group;
    target->input_lost = true;
    return false;
  }
  if (target->answered[which] && t_us <= target->answered_us[which]) {
    ++target->late;
    return false;
  }
  target->answered[which] = true;
  target->answered_us[which] = t_us;
  target->heard_us = t_us;
  if (!target->estimator->sample(target->estimator->state, pair->input, values, t_us, answer)) {
    target->numeric = true;
    enter(target, CANHIL_TARGET_STATE_FAULT);
    return false;
  }
  if (pair->answer == CANHIL_GROUPS) return false;
  if (canhil_groups[pair->answer].cause_time >= 0)
    answer[canhil_groups[pair->answer].cause_time] = (double)(uint32_t)t_us; /* this time wraps every 71.6 minutes */
  if (canhil_groups[pair->answer].cause_counter >= 0)
    answer[canhil_groups[pair->answer].cause_counter] = target->group_counter[pair->input];
  send_group(target, pair->answer, answer);
  return true;
}

/* ---- frames to groups ---- */

/* Stores a message. Returns true if its group is now complete. If the message has another counter than the incomplete group so far, this
 * group is discarded. */
static bool completes(canhil_target* target, unsigned index, const uint8_t* data) {
  const unsigned group = canhil_messages[index].group;
  const unsigned place = index - canhil_groups[group].first_message;
  const uint8_t counter = data[1] & 0x0FU;
  memcpy(target->data[index], data, 8);
  if (target->seen[group] != 0 && counter != target->group_counter[group]) {
    target->seen[group] = 0;
    ++target->bad_group;
    target->input_lost = true;
  }
  target->group_counter[group] = counter;
  target->seen[group] = (uint16_t)(target->seen[group] | (1U << place));
  if (target->seen[group] != (1U << canhil_groups[group].messages) - 1U) return false;
  target->seen[group] = 0;
  return true;
}

static bool dispatch(canhil_target* target, unsigned index, const uint8_t* data) {
  const unsigned group = canhil_messages[index].group;
  const bool running = target->state == CANHIL_TARGET_STATE_RUNNING;
  unsigned which = 0;
  double values[CANHIL_MOST_VALUES] = {0};
  while (which < target->estimator->answer_count && target->estimator->answers[which].input != group) ++which;
  const bool sample = which < target->estimator->answer_count;
  if (group == CANHIL_GROUP_TARGET_INIT && running) {
    target->command = true;
    return false;
  }
  if (sample && !running) return false;
  if (sample) target->untouched = false;
  if (!completes(target, index, data)) return false;
  values_of(target, group, values);
  if (sample) return on_sample(target, which, values);
  if (group == CANHIL_GROUP_SYNC) on_sync(target, values);
  if (group == CANHIL_GROUP_TARGET_COMMAND) on_command(target, values);
  if (group == CANHIL_GROUP_PARAM_SET) on_parameter(target, values);
  if (group == CANHIL_GROUP_TARGET_INIT) on_initial(target, values);
  return false;
}

static void damaged(canhil_target* target) {
  ++target->bad_crc;
  target->input_lost = true;
}

bool canhil_target_receive(canhil_target* target, const canhil_frame* frame) {
  unsigned index = 0;
  uint8_t counter, before;
  unsigned lost;
  while (index < CANHIL_MESSAGES && canhil_messages[index].id != frame->id) ++index;
  if (index == CANHIL_MESSAGES || canhil_groups[canhil_messages[index].group].from_target) return false;
  counter = frame->data[1] & 0x0FU;
  if (frame->size != canhil_messages[index].size || counter >= COUNTERS ||
      frame->data[0] != canhil_crc(frame->data, frame->size, canhil_messages[index].data_id)) {
    damaged(target);
    return false;
  }
  if (canhil_messages[index].group == CANHIL_GROUP_SYNC || canhil_messages[index].group == CANHIL_GROUP_TARGET_COMMAND)
    target->bench_heard = true;
  before = target->received[index];
  target->received[index] = counter;
  /* Commands are always obeyed, because a restarted bench can send the same counter again. */
  if (before == counter && canhil_messages[index].group != CANHIL_GROUP_TARGET_COMMAND) {
    ++target->late;
    return false;
  }
  lost = before == NO_COUNTER || before == counter ? 0 : (unsigned)(counter + COUNTERS - before - 1) % COUNTERS;
  if (lost > 0) {
    target->frames_lost += lost;
    target->input_lost = true;
  }
  return dispatch(target, index, frame->data);
}

/* ---- the functions that the process calls ---- */

void canhil_target_init(canhil_target* target, const canhil_estimator* estimator, canhil_send send, void* bus) {
  memset(target, 0, sizeof *target);
  target->estimator = estimator;
  target->send = send;
  target->bus = bus;
  forget(target);
}

bool canhil_is_heartbeat(const canhil_frame* frame) {
  return frame->id == canhil_messages[canhil_groups[CANHIL_GROUP_TARGET_HEARTBEAT].first_message].id;
}

void canhil_target_measured(canhil_target* target, uint32_t queue_us, uint32_t compute_us) {
  ++target->window;
  if (queue_us > target->queue_max_us) target->queue_max_us = queue_us;
  if (compute_us > target->compute_max_us) target->compute_max_us = compute_us;
  target->queue_sum_us += queue_us;
  target->compute_sum_us += compute_us;
}

static void send_timing(canhil_target* target) {
  const double n = target->window == 0 ? 1 : target->window;
  double v[CANHIL_TARGET_TIMING_VALUES];
  v[CANHIL_TARGET_TIMING_QUEUE_MAX_US] = target->queue_max_us;
  v[CANHIL_TARGET_TIMING_QUEUE_MEAN_US] = target->queue_sum_us / n;
  v[CANHIL_TARGET_TIMING_COMPUTE_MAX_US] = target->compute_max_us;
  v[CANHIL_TARGET_TIMING_COMPUTE_MEAN_US] = target->compute_sum_us / n;
  send_group(target, CANHIL_GROUP_TARGET_TIMING, v);
  target->window = target->queue_max_us = target->compute_max_us = 0;
  target->queue_sum_us = target->compute_sum_us = 0;
}

/* In a run the target sends no heartbeat by its own clock, so that a replay produces the same frames. When the bench is gone, the target
 * sends heartbeats by its own clock again. */
void canhil_target_poll(canhil_target* target, uint32_t now_ms) {
  if (!target->polled) {
    target->polled = true;
    target->report_ms = now_ms;
    target->bench_ms = now_ms - bench_silent_ms;
  }
  if (now_ms - target->report_ms < CANHIL_HEARTBEAT_MS) return;
  target->report_ms = now_ms;
  if (target->bench_heard) target->bench_ms = now_ms;
  target->bench_heard = false;
  if (now_ms - target->bench_ms >= (target->state == CANHIL_TARGET_STATE_RUNNING ? bench_gone_ms : bench_silent_ms)) {
    send_heartbeat(target);
  } else if (!target->lockstep) {
    send_timing(target);
  }
}
