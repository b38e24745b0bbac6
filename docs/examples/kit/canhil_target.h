/* A target for the canhil bench without the estimator: state machine, protection of frames, sample groups, parameters, heartbeat and
 * counts of lost frames. C99, without allocation and operating system. docs/own-target.md describes the protocol.
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

/* Sends a frame to the bus. If the bus does not accept it, it is lost; the bench detects this by the counters. */
typedef void (*canhil_send)(void* bus, const canhil_frame* frame);

/* A parameter in the unit of its name. */
typedef struct {
  uint8_t parameter; /* CANHIL_PARAMETER_... */
  double initial, minimum, maximum;
  bool whole;         /* integers only */
  bool while_running; /* may be set after the start */
} canhil_parameter;

/* A sample group that the estimator receives, and the group of its answer. */
typedef struct {
  uint8_t input;  /* CANHIL_GROUP_... */
  uint8_t answer; /* CANHIL_GROUP_...; CANHIL_GROUPS: no answer */
} canhil_answer;

/* The user writes this. The values of a group are an array of doubles with the indices CANHIL_<GROUP>_<SIGNAL>. */
typedef struct {
  uint8_t estimator;         /* CANHIL_ESTIMATOR_... */
  const uint8_t* algorithms; /* CANHIL_ALGORITHM_... */
  unsigned algorithm_count;
  const canhil_answer* answers;
  unsigned answer_count;
  const canhil_parameter* parameters;
  unsigned parameter_count; /* at most CANHIL_MOST_PARAMETERS */

  /* Starts from the beginning. parameters: values in the order of the field `parameters`; the array stays valid and its values may change.
   * initial: the values of group TargetInit. */
  void (*start)(void* state, uint8_t algorithm, const double* parameters, const double* initial);

  /* Processes one complete sample, newer than the one before. t_us: its time of validity in the bench's time base, unwrapped. Writes the
   * values of the answer, which are initially zero; the kit writes cause_time_us and cause_counter. Returns false if the filter cannot
   * continue; the state becomes fault. */
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
  bool untouched; /* no Sync and no sample came since the start */
  uint32_t frames_lost, bad_crc, bad_group, late;

  double parameters[CANHIL_MOST_PARAMETERS];
  double initial[CANHIL_MOST_VALUES];
  uint8_t received[CANHIL_MESSAGES]; /* the last counter; 0xFF: none */
  uint8_t next[CANHIL_MESSAGES];     /* the counter of the next transmission */
  uint8_t data[CANHIL_MESSAGES][8];
  uint16_t seen[CANHIL_GROUPS]; /* a bit for each message of the group in progress */
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

/* Sets the state after program start. estimator and bus must outlive the target. */
void canhil_target_init(canhil_target* target, const canhil_estimator* estimator, canhil_send send, void* bus);

/* Processes a frame from the bus and sends the reply, if any. Returns true if the frame completed a sample that was answered. Frames that are
 * not for a target have no effect. */
bool canhil_target_receive(canhil_target* target, const canhil_frame* frame);

/* now_ms: the time of any steady clock in milliseconds; may wrap. Sends a heartbeat while no bench sends Sync, and TargetTiming in a run in
 * real time. */
void canhil_target_poll(canhil_target* target, uint32_t now_ms);

/* Reports the times of an answered frame for TargetTiming: waiting in the receive queue and computing the answer, both [us]. */
void canhil_target_measured(canhil_target* target, uint32_t queue_us, uint32_t compute_us);

/* True if the frame is a target's heartbeat: a second target must not join the bus. */
bool canhil_is_heartbeat(const canhil_frame* frame);

/* AUTOSAR E2E profile 11: CRC-8 SAE J1850 (polynomial 0x1D, start value 0) over the data id, low byte first, and data[1..size-1]. */
uint8_t canhil_crc(const uint8_t* data, unsigned size, uint16_t data_id);

#endif
