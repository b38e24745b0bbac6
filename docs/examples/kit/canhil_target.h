/* A target of the canhil bench, all but its estimator: the state machine, the protection of frames, sample groups, parameters,
 * heartbeat and counters of losses. C99; it allocates nothing and knows no operating system. docs/own-target.md tells the protocol.
 *
 *   static canhil_target target;
 *   canhil_target_init(&target, &my_estimator, my_send, my_bus);
 *   for (;;) {
 *     for each frame from the bus: canhil_target_receive(&target, &frame);
 *     canhil_target_poll(&target, now_ms);                   // at least every 20 ms
 *   }
 */
#ifndef CANHIL_TARGET_H
#define CANHIL_TARGET_H

#include <stdbool.h>
#include <stdint.h>

#include "canhil_messages.h"

/* A classic CAN frame with an 11-bit id. */
typedef struct {
  uint16_t id;
  uint8_t size;
  uint8_t data[8];
} canhil_frame;

/* Hands a frame to the bus. One that the bus does not take is lost; the bench sees that by the counters. */
typedef void (*canhil_send)(void* bus, const canhil_frame* frame);

/* A parameter in the unit of its name. */
typedef struct {
  uint8_t parameter; /* CANHIL_PARAMETER_... */
  double initial, minimum, maximum;
  bool whole;         /* takes integers alone */
  bool while_running; /* may be set after the start */
} canhil_parameter;

/* A sample group that the estimator listens to, and the group that answers it. */
typedef struct {
  uint8_t input;  /* CANHIL_GROUP_... */
  uint8_t answer; /* CANHIL_GROUP_...; CANHIL_GROUPS: none */
} canhil_answer;

/* What the user writes. Values of a group stand in an array of doubles, at CANHIL_<GROUP>_<SIGNAL>. */
typedef struct {
  uint8_t estimator;         /* CANHIL_ESTIMATOR_... */
  const uint8_t* algorithms; /* CANHIL_ALGORITHM_... */
  unsigned algorithm_count;
  const canhil_answer* answers;
  unsigned answer_count;
  const canhil_parameter* parameters;
  unsigned parameter_count; /* at most CANHIL_MOST_PARAMETERS */

  /* Begins anew. parameters: values in the order above, which stay there and may change. initial: of group TargetInit. */
  void (*start)(void* state, uint8_t algorithm, const double* parameters, const double* initial);

  /* One whole sample, newer than the one before; t_us: its time of validity in the bench's time base, unwrapped. Writes the values of
   * the answer, which are zero before, but cause_time_us and cause_counter. False: the filter cannot go on; the state becomes fault. */
  bool (*sample)(void* state, uint8_t group, const double* values, int64_t t_us, double* answer);

  void* state;
} canhil_estimator;

enum { CANHIL_MOST_PARAMETERS = 64, CANHIL_MOST_ANSWERS = 8 };

typedef struct {
  const canhil_estimator* estimator;
  canhil_send send;
  void* bus;

  uint8_t state;    /* CANHIL_TARGET_STATE_... */
  uint8_t selected; /* CANHIL_ESTIMATOR_... */
  uint8_t algorithm;
  bool dbc_mismatch, not_initialised, input_lost, input_silent, numeric, command; /* error bits of the heartbeat */
  bool untouched; /* nothing has happened since the start */
  uint32_t frames_lost, bad_crc, bad_group, late;

  double parameters[CANHIL_MOST_PARAMETERS];
  double initial[CANHIL_MOST_VALUES];
  uint8_t received[CANHIL_MESSAGES]; /* the last counter; 0xFF: none */
  uint8_t next[CANHIL_MESSAGES];     /* the counter of the next transmission */
  uint8_t data[CANHIL_MESSAGES][8];
  uint16_t seen[CANHIL_GROUPS]; /* a bit for each message of the group in progress */
  uint8_t group_counter[CANHIL_GROUPS];

  int64_t now_us, heartbeat_due_us, heard_us; /* time base of the bench; heard: the last sample */
  int64_t answered_us[CANHIL_MOST_ANSWERS];   /* time of validity of the last sample of each input */
  bool answered[CANHIL_MOST_ANSWERS];
  bool lockstep;

  uint32_t report_ms, bench_ms; /* of canhil_target_poll() */
  bool polled, bench_heard;
  uint32_t window, queue_max_us, compute_max_us;
  double queue_sum_us, compute_sum_us;
} canhil_target;

/* As after a start of the program. estimator and bus must outlive the target. */
void canhil_target_init(canhil_target* target, const canhil_estimator* estimator, canhil_send send, void* bus);

/* Takes a frame from the bus and sends what answers it. True: it completed a sample that was answered. Frames that are not for a target
 * do nothing. */
bool canhil_target_receive(canhil_target* target, const canhil_frame* frame);

/* The time on any clock in milliseconds that goes on steadily; may wrap. Sends a heartbeat while no bench keeps the time base, and
 * TargetTiming in a run in real time. */
void canhil_target_poll(canhil_target* target, uint32_t now_ms);

/* How long an answered frame waited before it was taken from the bus, and how long its answer took; both [us]. For TargetTiming. */
void canhil_target_measured(canhil_target* target, uint32_t queue_us, uint32_t compute_us);

/* Whether a frame is a target's heartbeat: a second target must not join the bus. */
bool canhil_is_heartbeat(const canhil_frame* frame);

/* AUTOSAR E2E profile 11: CRC-8 SAE J1850 (polynomial 0x1D, start value 0) over the data id, low byte first, and data[1..size-1]. */
uint8_t canhil_crc(const uint8_t* data, unsigned size, uint16_t data_id);

#endif
