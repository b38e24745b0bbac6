/* A target for the canhil bench; only the estimator is missing. It contains the state machine, the protection of frames, sample groups,
 * parameters, the heartbeat, and counts of lost frames. C99, without allocation and operating system. docs/own-target.md describes the
 * protocol.
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

/* Sends a frame to the bus. If the bus does not accept the frame, the frame is lost; the bench detects this by the counters. */
typedef void (*canhil_send)(void* bus, const canhil_frame* frame);

/* A parameter. Its values are in the unit that its name contains. */
typedef struct {
  uint8_t parameter; /* CANHIL_PARAMETER_... */
  double initial, minimum, maximum;
  bool whole;         /* integers only */
  bool while_running; /* the bench may change the parameter during a run */
} canhil_parameter;

/* A sample group that the estimator receives, and the group with which the target answers it. */
typedef struct {
  uint8_t input;  /* CANHIL_GROUP_... */
  uint8_t answer; /* CANHIL_GROUP_...; CANHIL_GROUPS: no answer */
} canhil_answer;

/* The user writes the estimator. The values of a group are an array of doubles with the indices CANHIL_<GROUP>_<SIGNAL>. */
typedef struct {
  uint8_t estimator;         /* CANHIL_ESTIMATOR_... */
  const uint8_t* algorithms; /* CANHIL_ALGORITHM_... */
  unsigned algorithm_count;
  const canhil_answer* answers;
  unsigned answer_count;
  const canhil_parameter* parameters;
  unsigned parameter_count; /* at most CANHIL_MOST_PARAMETERS */

  /* Starts the estimator from the beginning. parameters: values in the order of the field `parameters`; the array stays valid, and the kit may
   * change its values during the run. initial: the values of group TargetInit. */
  void (*start)(void* state, uint8_t algorithm, const double* parameters, const double* initial);

  /* Processes one complete sample that is newer than the sample before. t_us: its time of validity in the bench's time base, unwrapped.
   * Writes the values of the answer, which are zero before the call; the kit itself writes cause_time_us and cause_counter. Returns false
   * if the filter cannot continue; then the target's state becomes fault. */
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
  bool untouched; /* neither a Sync nor a sample has come since the start */
  uint32_t frames_lost, bad_crc, bad_group, late;

  double parameters[CANHIL_MOST_PARAMETERS];
  double initial[CANHIL_MOST_VALUES];
  uint8_t received[CANHIL_MESSAGES]; /* the last received counter; 0xFF: none */
  uint8_t next[CANHIL_MESSAGES];     /* the counter for the next transmission */
  uint8_t data[CANHIL_MESSAGES][8];
  uint16_t seen[CANHIL_GROUPS]; /* a bit for each received message of the incomplete group */
  uint8_t group_counter[CANHIL_GROUPS];

  int64_t now_us, heartbeat_due_us, heard_us; /* in the bench's time base; heard_us: time of the last sample */
  int64_t answered_us[CANHIL_MOST_ANSWERS];   /* time of validity of the last sample of each input */
  bool answered[CANHIL_MOST_ANSWERS];
  bool lockstep;

  uint32_t report_ms, bench_ms; /* times of canhil_target_poll() */
  bool polled, bench_heard;
  uint32_t window, queue_max_us, compute_max_us;
  double queue_sum_us, compute_sum_us;
} canhil_target;

/* Sets the state that the target has after program start. `estimator` and `bus` must exist as long as the target. */
void canhil_target_init(canhil_target* target, const canhil_estimator* estimator, canhil_send send, void* bus);

/* Processes a frame from the bus and sends the reply, if any. Returns true if the frame completed a sample that was answered. Frames that are
 * not for a target have no effect. */
bool canhil_target_receive(canhil_target* target, const canhil_frame* frame);

/* now_ms: the time of any steady clock in milliseconds; it may wrap. While no bench sends Sync, this function sends the heartbeats; in a run in
 * real time it sends TargetTiming. */
void canhil_target_poll(canhil_target* target, uint32_t now_ms);

/* Call this after an answered frame: passes two times [us] for TargetTiming, how long the frame waited in the receive queue and how long the
 * computation of the answer took. */
void canhil_target_measured(canhil_target* target, uint32_t queue_us, uint32_t compute_us);

/* True if the frame is the heartbeat of a target. With it, a target detects that the bus already has a target. */
bool canhil_is_heartbeat(const canhil_frame* frame);

/* AUTOSAR E2E profile 11: CRC-8 SAE J1850 (polynomial 0x1D, start value 0) over the data id, low byte first, and data[1..size-1]. */
uint8_t canhil_crc(const uint8_t* data, unsigned size, uint16_t data_id);

#endif
