/* Made by dbcgen --c from canhil.dbc: change that, not this. */
#ifndef CANHIL_MESSAGES_H
#define CANHIL_MESSAGES_H

#define CANHIL_DBC_HASH24 0x82E36DUL

enum { /* TargetState */
  CANHIL_TARGET_STATE_IDLE = 0,
  CANHIL_TARGET_STATE_READY = 1,
  CANHIL_TARGET_STATE_RUNNING = 2,
  CANHIL_TARGET_STATE_FAULT = 3
};
enum { /* Estimator */
  CANHIL_ESTIMATOR_NONE = 0,
  CANHIL_ESTIMATOR_TRANSFER_ALIGNMENT = 1,
  CANHIL_ESTIMATOR_INFLIGHT_ALIGNMENT = 2,
  CANHIL_ESTIMATOR_LOS_RATE = 3,
  CANHIL_ESTIMATOR_WIND = 4
};
enum { /* Algorithm */
  CANHIL_ALGORITHM_KALMAN = 0,
  CANHIL_ALGORITHM_ROBUST_H2 = 1,
  CANHIL_ALGORITHM_EKF = 2,
  CANHIL_ALGORITHM_UKF = 3,
  CANHIL_ALGORITHM_SIN_COS = 4,
  CANHIL_ALGORITHM_SWITCHED_TABLE = 8,
  CANHIL_ALGORITHM_COMBINED = 9,
  CANHIL_ALGORITHM_LOW_PASS = 10,
  CANHIL_ALGORITHM_H_INFINITY = 11,
  CANHIL_ALGORITHM_ADAPTIVE_Q = 12
};
enum { /* Command */
  CANHIL_COMMAND_NONE = 0,
  CANHIL_COMMAND_RESET = 1,
  CANHIL_COMMAND_START = 2,
  CANHIL_COMMAND_STOP = 3,
  CANHIL_COMMAND_ADD = 4
};
enum { /* ParameterStatus */
  CANHIL_PARAMETER_STATUS_ACCEPTED = 0,
  CANHIL_PARAMETER_STATUS_UNKNOWN = 1,
  CANHIL_PARAMETER_STATUS_OUT_OF_RANGE = 2,
  CANHIL_PARAMETER_STATUS_WRONG_STATE = 3
};
enum { /* Validity */
  CANHIL_VALIDITY_INVALID = 0,
  CANHIL_VALIDITY_VALID = 1
};
enum { /* LosRateOutcome */
  CANHIL_LOS_RATE_OUTCOME_WAITING = 0,
  CANHIL_LOS_RATE_OUTCOME_STARTED = 1,
  CANHIL_LOS_RATE_OUTCOME_UPDATED = 2,
  CANHIL_LOS_RATE_OUTCOME_START_UP = 3,
  CANHIL_LOS_RATE_OUTCOME_COASTING = 4,
  CANHIL_LOS_RATE_OUTCOME_BAD_STEP = 5,
  CANHIL_LOS_RATE_OUTCOME_NON_FINITE = 6
};
enum { /* LosRateFault */
  CANHIL_LOS_RATE_FAULT_NONE = 0,
  CANHIL_LOS_RATE_FAULT_ERROR_ANGLE = 1,
  CANHIL_LOS_RATE_FAULT_FIELD_OF_VIEW = 2,
  CANHIL_LOS_RATE_FAULT_ANTENNA = 3,
  CANHIL_LOS_RATE_FAULT_ACCELERATION = 4,
  CANHIL_LOS_RATE_FAULT_RANGE_INVALID = 5,
  CANHIL_LOS_RATE_FAULT_RANGE_STALE = 6,
  CANHIL_LOS_RATE_FAULT_RANGE_JUMP = 7,
  CANHIL_LOS_RATE_FAULT_CLOSING_SPEED_INVALID = 8
};
enum { /* WindOutcome */
  CANHIL_WIND_OUTCOME_WAITING = 0,
  CANHIL_WIND_OUTCOME_STARTED = 1,
  CANHIL_WIND_OUTCOME_UPDATED = 2,
  CANHIL_WIND_OUTCOME_COASTING = 3,
  CANHIL_WIND_OUTCOME_OUT_OF_ORDER = 4,
  CANHIL_WIND_OUTCOME_NON_FINITE = 5,
  CANHIL_WIND_OUTCOME_FUTURE = 6
};
enum { /* WindFault */
  CANHIL_WIND_FAULT_NONE = 0,
  CANHIL_WIND_FAULT_INVALID = 1,
  CANHIL_WIND_FAULT_NOT_FINITE = 2,
  CANHIL_WIND_FAULT_NOT_PHYSICAL = 3,
  CANHIL_WIND_FAULT_PITCH = 4,
  CANHIL_WIND_FAULT_STALE = 5,
  CANHIL_WIND_FAULT_JUMP = 6
};
enum { /* FixOutcome */
  CANHIL_FIX_OUTCOME_ACCEPTED = 0,
  CANHIL_FIX_OUTCOME_RECOVERED = 1,
  CANHIL_FIX_OUTCOME_GATED = 2,
  CANHIL_FIX_OUTCOME_LATE = 3,
  CANHIL_FIX_OUTCOME_FUTURE = 4,
  CANHIL_FIX_OUTCOME_OUT_OF_ORDER = 5,
  CANHIL_FIX_OUTCOME_WRONG_SOURCE = 6,
  CANHIL_FIX_OUTCOME_INVALID = 7,
  CANHIL_FIX_OUTCOME_BEFORE_START = 8,
  CANHIL_FIX_OUTCOME_NUMERIC = 9
};
enum { /* FixSource */
  CANHIL_FIX_SOURCE_SSBL = 0,
  CANHIL_FIX_SOURCE_GPS = 1
};
enum { /* Parameter */
  CANHIL_PARAMETER_ACCEL_BIAS_SIGMA_UG = 0,
  CANHIL_PARAMETER_GYRO_BIAS_SIGMA_DEGPH = 1,
  CANHIL_PARAMETER_ACCEL_NOISE_UGPRTHZ = 2,
  CANHIL_PARAMETER_GYRO_NOISE_DEGPRTH = 3,
  CANHIL_PARAMETER_VELOCITY_NOISE_M2PS = 4,
  CANHIL_PARAMETER_H2_CASE = 5,
  CANHIL_PARAMETER_H2_ALPHA_RULE = 6,
  CANHIL_PARAMETER_H2_ALPHA_MPS2 = 7,
  CANHIL_PARAMETER_FADING_PER_S = 8,
  CANHIL_PARAMETER_MECHANIZATION = 9,
  CANHIL_PARAMETER_CLOSED_LOOP = 10,
  CANHIL_PARAMETER_OUTPUT_INTERVAL_MS = 11,
  CANHIL_PARAMETER_AIDING = 12,
  CANHIL_PARAMETER_ATTITUDE_ERROR_FRAME = 13,
  CANHIL_PARAMETER_UKF_ROOT = 14,
  CANHIL_PARAMETER_UKF_COVARIANCE = 15,
  CANHIL_PARAMETER_FIX_NOISE_HORIZONTAL_M = 16,
  CANHIL_PARAMETER_FIX_NOISE_VERTICAL_M = 17,
  CANHIL_PARAMETER_FIX_BIAS_SIGMA_M = 18,
  CANHIL_PARAMETER_FIX_BIAS_WALK_MPRTS = 19,
  CANHIL_PARAMETER_INITIAL_HEIGHT_SIGMA_M = 20,
  CANHIL_PARAMETER_HANDOVER_SIGMA_DEG = 21,
  CANHIL_PARAMETER_GATE_NIS = 22,
  CANHIL_PARAMETER_GATE_RECOVERY = 23,
  CANHIL_PARAMETER_LATE_FIXES = 24,
  CANHIL_PARAMETER_JERK_DENSITY_M2PS5 = 64,
  CANHIL_PARAMETER_THERMAL_NOISE_PITCH_RADPM2 = 65,
  CANHIL_PARAMETER_THERMAL_NOISE_YAW_RADPM2 = 66,
  CANHIL_PARAMETER_GLINT_NOISE_PITCH_M = 67,
  CANHIL_PARAMETER_GLINT_NOISE_YAW_M = 68,
  CANHIL_PARAMETER_CONSTANT_NOISE_PITCH_RAD = 69,
  CANHIL_PARAMETER_CONSTANT_NOISE_YAW_RAD = 70,
  CANHIL_PARAMETER_SAMPLE_PERIOD_MS = 71,
  CANHIL_PARAMETER_LOS_RATE_SIGMA_RADPS = 72,
  CANHIL_PARAMETER_TARGET_ACCELERATION_SIGMA_MPS2 = 73,
  CANHIL_PARAMETER_START_UP_S = 74,
  CANHIL_PARAMETER_GAP_LIMIT_MS = 75,
  CANHIL_PARAMETER_LOW_PASS_BANDWIDTH_RADPS = 76,
  CANHIL_PARAMETER_LOW_PASS_DAMPING = 77,
  CANHIL_PARAMETER_RANGE_MAX_M = 78,
  CANHIL_PARAMETER_CLOSING_SPEED_MAX_MPS = 79,
  CANHIL_PARAMETER_BLIND_RANGE_M = 80,
  CANHIL_PARAMETER_RANGE_SIGMA_M = 81,
  CANHIL_PARAMETER_RANGE_GATE_M = 82,
  CANHIL_PARAMETER_CLOSING_SPEED_GATE_MPS = 83,
  CANHIL_PARAMETER_RELOCK_SAMPLES = 84,
  CANHIL_PARAMETER_RANGE_UNCHANGED_LIMIT_MS = 85,
  CANHIL_PARAMETER_FIELD_OF_VIEW_RAD = 86,
  CANHIL_PARAMETER_ANTENNA_RATE_SIGMA_RADPS = 87,
  CANHIL_PARAMETER_MISSILE_ACCELERATION_SIGMA_MPS2 = 88,
  CANHIL_PARAMETER_PROCESS_NOISE = 128,
  CANHIL_PARAMETER_AIR_VELOCITY_NOISE_MPSPRTS = 129,
  CANHIL_PARAMETER_BODY_RATE_NOISE_DEGPSPRTS = 130,
  CANHIL_PARAMETER_ATTITUDE_NOISE_DEGPRTS = 131,
  CANHIL_PARAMETER_WIND_NOISE_MPSPRTS = 132,
  CANHIL_PARAMETER_GLIDER_VELOCITY_SIGMA_MPS = 133,
  CANHIL_PARAMETER_GLIDER_RATE_SIGMA_DEGPS = 134,
  CANHIL_PARAMETER_GLIDER_ATTITUDE_SIGMA_DEG = 135,
  CANHIL_PARAMETER_THETA_PER_S = 136,
  CANHIL_PARAMETER_THETA_CAP_PER_S = 137,
  CANHIL_PARAMETER_THETA_RATE_WEIGHT = 138,
  CANHIL_PARAMETER_ADAPTATION_TIME_S = 139,
  CANHIL_PARAMETER_ADAPTATION_LIMIT = 140,
  CANHIL_PARAMETER_INITIAL_AIR_VELOCITY_SIGMA_MPS = 141,
  CANHIL_PARAMETER_INITIAL_RATE_SIGMA_DEGPS = 142,
  CANHIL_PARAMETER_INITIAL_WIND_SIGMA_MPS = 143,
  CANHIL_PARAMETER_FINS_LATE_MS = 144,
  CANHIL_PARAMETER_FINS_MISSING_MS = 145,
  CANHIL_PARAMETER_GLIDER_NAV_COAST_S = 146,
  CANHIL_PARAMETER_GLIDER_NAV_STALE_MS = 147,
  CANHIL_PARAMETER_GLIDER_NAV_GATE_MPS = 148
};

/* Sample groups; a message of no group is a group of its own. */
enum {
  CANHIL_GROUP_SEEKER,
  CANHIL_GROUP_LOS_RATE,
  CANHIL_GROUP_SLAVE_IMU,
  CANHIL_GROUP_SYNC,
  CANHIL_GROUP_ALIGN_NAV,
  CANHIL_GROUP_FIX_NAV,
  CANHIL_GROUP_FINS,
  CANHIL_GROUP_GLIDER_NAV,
  CANHIL_GROUP_WIND,
  CANHIL_GROUP_MASTER_INS,
  CANHIL_GROUP_ALIGN_FILTER,
  CANHIL_GROUP_TARGET_HEARTBEAT,
  CANHIL_GROUP_TARGET_TIMING,
  CANHIL_GROUP_TARGET_COUNTERS,
  CANHIL_GROUP_SSBL,
  CANHIL_GROUP_GPS,
  CANHIL_GROUP_FIX_FILTER,
  CANHIL_GROUP_TARGET_COMMAND,
  CANHIL_GROUP_PARAM_SET,
  CANHIL_GROUP_PARAM_ACK,
  CANHIL_GROUP_STEP_DONE,
  CANHIL_GROUP_TARGET_INIT_AIR,
  CANHIL_GROUP_TARGET_INIT,
  CANHIL_GROUPS
};

/* The values of each group, by their place in its array of doubles. */
enum {
  CANHIL_SEEKER_ANTENNA_INCREMENT_ROLL_RAD, /* [rad] */
  CANHIL_SEEKER_ANTENNA_INCREMENT_PITCH_RAD, /* [rad] */
  CANHIL_SEEKER_ANTENNA_INCREMENT_YAW_RAD, /* [rad] */
  CANHIL_SEEKER_ANTENNA_VALIDITY,
  CANHIL_SEEKER_ERROR_PITCH_RAD, /* [rad] */
  CANHIL_SEEKER_ERROR_YAW_RAD, /* [rad] */
  CANHIL_SEEKER_INTERVAL_US, /* [us] */
  CANHIL_SEEKER_ERROR_VALIDITY,
  CANHIL_SEEKER_MISSILE_ACCELERATION_Y_MPS2, /* [m/s2] */
  CANHIL_SEEKER_MISSILE_ACCELERATION_Z_MPS2, /* [m/s2] */
  CANHIL_SEEKER_CLOSING_SPEED_MPS, /* [m/s] */
  CANHIL_SEEKER_ACCELERATION_VALIDITY,
  CANHIL_SEEKER_CLOSING_SPEED_VALIDITY,
  CANHIL_SEEKER_RANGE_M, /* [m] */
  CANHIL_SEEKER_TIME_OF_VALIDITY_US, /* [us] */
  CANHIL_SEEKER_RANGE_VALIDITY,
  CANHIL_SEEKER_VALUES
};
enum {
  CANHIL_LOS_RATE_LOS_RATE_PITCH_RADPS, /* [rad/s] */
  CANHIL_LOS_RATE_LOS_RATE_YAW_RADPS, /* [rad/s] */
  CANHIL_LOS_RATE_CAUSE_COUNTER,
  CANHIL_LOS_RATE_OUTCOME,
  CANHIL_LOS_RATE_FAULT,
  CANHIL_LOS_RATE_BLIND,
  CANHIL_LOS_RATE_LOS_RATE_SIGMA_PITCH_RADPS, /* [rad/s] */
  CANHIL_LOS_RATE_LOS_RATE_SIGMA_YAW_RADPS, /* [rad/s] */
  CANHIL_LOS_RATE_TARGET_ACCELERATION_SIGMA_Y_MPS2, /* [m/s2] */
  CANHIL_LOS_RATE_TARGET_ACCELERATION_SIGMA_Z_MPS2, /* [m/s2] */
  CANHIL_LOS_RATE_NIS,
  CANHIL_LOS_RATE_TARGET_ACCELERATION_Y_MPS2, /* [m/s2] */
  CANHIL_LOS_RATE_TARGET_ACCELERATION_Z_MPS2, /* [m/s2] */
  CANHIL_LOS_RATE_CAUSE_TIME_US, /* [us] */
  CANHIL_LOS_RATE_VALUES
};
enum {
  CANHIL_SLAVE_IMU_DELTA_THETA_X_RAD, /* [rad] */
  CANHIL_SLAVE_IMU_DELTA_THETA_Y_RAD, /* [rad] */
  CANHIL_SLAVE_IMU_DELTA_THETA_Z_RAD, /* [rad] */
  CANHIL_SLAVE_IMU_GYRO_VALIDITY,
  CANHIL_SLAVE_IMU_DELTA_V_X_MPS, /* [m/s] */
  CANHIL_SLAVE_IMU_DELTA_V_Y_MPS, /* [m/s] */
  CANHIL_SLAVE_IMU_DELTA_V_Z_MPS, /* [m/s] */
  CANHIL_SLAVE_IMU_ACCEL_VALIDITY,
  CANHIL_SLAVE_IMU_TIME_OF_VALIDITY_US, /* [us] */
  CANHIL_SLAVE_IMU_INTERVAL_US, /* [us] */
  CANHIL_SLAVE_IMU_TEMPERATURE_DEGC, /* [degC] */
  CANHIL_SLAVE_IMU_VALUES
};
enum {
  CANHIL_SYNC_TIME_US, /* [us] */
  CANHIL_SYNC_STEP,
  CANHIL_SYNC_LOCKSTEP,
  CANHIL_SYNC_VALUES
};
enum {
  CANHIL_ALIGN_NAV_ROLL_DEG, /* [deg] */
  CANHIL_ALIGN_NAV_PITCH_DEG, /* [deg] */
  CANHIL_ALIGN_NAV_HEADING_DEG, /* [deg] */
  CANHIL_ALIGN_NAV_COASTING,
  CANHIL_ALIGN_NAV_VELOCITY_NORTH_MPS, /* [m/s] */
  CANHIL_ALIGN_NAV_VELOCITY_EAST_MPS, /* [m/s] */
  CANHIL_ALIGN_NAV_CAUSE_COUNTER,
  CANHIL_ALIGN_NAV_VELOCITY_DOWN_MPS, /* [m/s] */
  CANHIL_ALIGN_NAV_CAUSE_TIME_US, /* [us] */
  CANHIL_ALIGN_NAV_VALUES
};
enum {
  CANHIL_FIX_NAV_ROLL_DEG, /* [deg] */
  CANHIL_FIX_NAV_PITCH_DEG, /* [deg] */
  CANHIL_FIX_NAV_HEADING_DEG, /* [deg] */
  CANHIL_FIX_NAV_COASTING,
  CANHIL_FIX_NAV_VELOCITY_NORTH_MPS, /* [m/s] */
  CANHIL_FIX_NAV_VELOCITY_EAST_MPS, /* [m/s] */
  CANHIL_FIX_NAV_CAUSE_COUNTER,
  CANHIL_FIX_NAV_VELOCITY_DOWN_MPS, /* [m/s] */
  CANHIL_FIX_NAV_CAUSE_TIME_US, /* [us] */
  CANHIL_FIX_NAV_VALUES
};
enum {
  CANHIL_FINS_ELEVATOR_DEG, /* [deg] */
  CANHIL_FINS_AILERON_DEG, /* [deg] */
  CANHIL_FINS_RUDDER_DEG, /* [deg] */
  CANHIL_FINS_TIME_OF_VALIDITY_US, /* [us] */
  CANHIL_FINS_VALUES
};
enum {
  CANHIL_GLIDER_NAV_VELOCITY_NORTH_MPS, /* [m/s] */
  CANHIL_GLIDER_NAV_VELOCITY_EAST_MPS, /* [m/s] */
  CANHIL_GLIDER_NAV_HEIGHT_M, /* [m] */
  CANHIL_GLIDER_NAV_ROLL_DEG, /* [deg] */
  CANHIL_GLIDER_NAV_PITCH_DEG, /* [deg] */
  CANHIL_GLIDER_NAV_HEADING_DEG, /* [deg] */
  CANHIL_GLIDER_NAV_NAVIGATION_VALIDITY,
  CANHIL_GLIDER_NAV_RATE_X_DEGPS, /* [deg/s] */
  CANHIL_GLIDER_NAV_RATE_Y_DEGPS, /* [deg/s] */
  CANHIL_GLIDER_NAV_RATE_Z_DEGPS, /* [deg/s] */
  CANHIL_GLIDER_NAV_VELOCITY_DOWN_MPS, /* [m/s] */
  CANHIL_GLIDER_NAV_TIME_OF_VALIDITY_US, /* [us] */
  CANHIL_GLIDER_NAV_VALUES
};
enum {
  CANHIL_WIND_WIND_NORTH_MPS, /* [m/s] */
  CANHIL_WIND_WIND_EAST_MPS, /* [m/s] */
  CANHIL_WIND_WIND_DOWN_MPS, /* [m/s] */
  CANHIL_WIND_STARTED,
  CANHIL_WIND_WIND_SPEED_MPS, /* [m/s] */
  CANHIL_WIND_WIND_FROM_DEG, /* [deg] */
  CANHIL_WIND_OUTCOME,
  CANHIL_WIND_FAULT,
  CANHIL_WIND_OUTSIDE_ALPHA,
  CANHIL_WIND_OUTSIDE_BETA,
  CANHIL_WIND_OUTSIDE_SPEED,
  CANHIL_WIND_OUTSIDE_MACH,
  CANHIL_WIND_OUTSIDE_ALTITUDE,
  CANHIL_WIND_OUTSIDE_PITCH,
  CANHIL_WIND_FINS_LATE,
  CANHIL_WIND_FINS_MISSING,
  CANHIL_WIND_FINS_NOT_PHYSICAL,
  CANHIL_WIND_THETA_CAPPED,
  CANHIL_WIND_WIND_SIGMA_NORTH_MPS, /* [m/s] */
  CANHIL_WIND_WIND_SIGMA_EAST_MPS, /* [m/s] */
  CANHIL_WIND_WIND_SIGMA_DOWN_MPS, /* [m/s] */
  CANHIL_WIND_WIND_CORRELATION_NE,
  CANHIL_WIND_WIND_CORRELATION_ND,
  CANHIL_WIND_WIND_CORRELATION_ED,
  CANHIL_WIND_ALONG_TRACK_SIGMA_MPS, /* [m/s] */
  CANHIL_WIND_CROSS_TRACK_SIGMA_MPS, /* [m/s] */
  CANHIL_WIND_WIND_SPEED_SIGMA_MPS, /* [m/s] */
  CANHIL_WIND_WIND_FROM_SIGMA_DEG, /* [deg] */
  CANHIL_WIND_AIR_VELOCITY_X_MPS, /* [m/s] */
  CANHIL_WIND_AIR_VELOCITY_Y_MPS, /* [m/s] */
  CANHIL_WIND_AIR_VELOCITY_Z_MPS, /* [m/s] */
  CANHIL_WIND_ROLL_DEG, /* [deg] */
  CANHIL_WIND_PITCH_DEG, /* [deg] */
  CANHIL_WIND_HEADING_DEG, /* [deg] */
  CANHIL_WIND_INNOVATION_NORTH_MPS, /* [m/s] */
  CANHIL_WIND_INNOVATION_EAST_MPS, /* [m/s] */
  CANHIL_WIND_INNOVATION_DOWN_MPS, /* [m/s] */
  CANHIL_WIND_CAUSE_TIME_US, /* [us] */
  CANHIL_WIND_CAUSE_COUNTER,
  CANHIL_WIND_NIS,
  CANHIL_WIND_VALUES
};
enum {
  CANHIL_MASTER_INS_VELOCITY_NORTH_MPS, /* [m/s] */
  CANHIL_MASTER_INS_VELOCITY_EAST_MPS, /* [m/s] */
  CANHIL_MASTER_INS_VELOCITY_VALIDITY,
  CANHIL_MASTER_INS_ROLL_DEG, /* [deg] */
  CANHIL_MASTER_INS_PITCH_DEG, /* [deg] */
  CANHIL_MASTER_INS_HEADING_DEG, /* [deg] */
  CANHIL_MASTER_INS_LATITUDE_DEG, /* [deg] */
  CANHIL_MASTER_INS_HEIGHT_M, /* [m] */
  CANHIL_MASTER_INS_LONGITUDE_DEG, /* [deg] */
  CANHIL_MASTER_INS_VELOCITY_DOWN_MPS, /* [m/s] */
  CANHIL_MASTER_INS_TIME_OF_VALIDITY_US, /* [us] */
  CANHIL_MASTER_INS_VALUES
};
enum {
  CANHIL_ALIGN_FILTER_INNOVATION_NORTH_MPS, /* [m/s] */
  CANHIL_ALIGN_FILTER_INNOVATION_EAST_MPS, /* [m/s] */
  CANHIL_ALIGN_FILTER_INNOVATION_DOWN_MPS, /* [m/s] */
  CANHIL_ALIGN_FILTER_ATTITUDE_SIGMA_NORTH_RAD, /* [rad] */
  CANHIL_ALIGN_FILTER_ATTITUDE_SIGMA_EAST_RAD, /* [rad] */
  CANHIL_ALIGN_FILTER_ATTITUDE_SIGMA_DOWN_RAD, /* [rad] */
  CANHIL_ALIGN_FILTER_ATTITUDE_CORRELATION_NE,
  CANHIL_ALIGN_FILTER_ATTITUDE_CORRELATION_ND,
  CANHIL_ALIGN_FILTER_ATTITUDE_CORRELATION_ED,
  CANHIL_ALIGN_FILTER_VELOCITY_SIGMA_NORTH_MPS, /* [m/s] */
  CANHIL_ALIGN_FILTER_VELOCITY_SIGMA_EAST_MPS, /* [m/s] */
  CANHIL_ALIGN_FILTER_VELOCITY_SIGMA_DOWN_MPS, /* [m/s] */
  CANHIL_ALIGN_FILTER_GYRO_BIAS_X_DEGPH, /* [deg/h] */
  CANHIL_ALIGN_FILTER_GYRO_BIAS_Y_DEGPH, /* [deg/h] */
  CANHIL_ALIGN_FILTER_GYRO_BIAS_Z_DEGPH, /* [deg/h] */
  CANHIL_ALIGN_FILTER_GYRO_BIAS_SIGMA_X_DEGPH, /* [deg/h] */
  CANHIL_ALIGN_FILTER_GYRO_BIAS_SIGMA_Y_DEGPH, /* [deg/h] */
  CANHIL_ALIGN_FILTER_GYRO_BIAS_SIGMA_Z_DEGPH, /* [deg/h] */
  CANHIL_ALIGN_FILTER_ACCEL_BIAS_X_UG, /* [ug] */
  CANHIL_ALIGN_FILTER_ACCEL_BIAS_Y_UG, /* [ug] */
  CANHIL_ALIGN_FILTER_ACCEL_BIAS_Z_UG, /* [ug] */
  CANHIL_ALIGN_FILTER_ACCEL_BIAS_SIGMA_X_UG, /* [ug] */
  CANHIL_ALIGN_FILTER_ACCEL_BIAS_SIGMA_Y_UG, /* [ug] */
  CANHIL_ALIGN_FILTER_ACCEL_BIAS_SIGMA_Z_UG, /* [ug] */
  CANHIL_ALIGN_FILTER_CAUSE_TIME_US, /* [us] */
  CANHIL_ALIGN_FILTER_CAUSE_COUNTER,
  CANHIL_ALIGN_FILTER_NIS,
  CANHIL_ALIGN_FILTER_VALUES
};
enum {
  CANHIL_TARGET_HEARTBEAT_STATE,
  CANHIL_TARGET_HEARTBEAT_ESTIMATOR,
  CANHIL_TARGET_HEARTBEAT_ALGORITHM,
  CANHIL_TARGET_HEARTBEAT_DBC_HASH,
  CANHIL_TARGET_HEARTBEAT_VERSION_MAJOR,
  CANHIL_TARGET_HEARTBEAT_VERSION_MINOR,
  CANHIL_TARGET_HEARTBEAT_ERROR_DBC_MISMATCH,
  CANHIL_TARGET_HEARTBEAT_ERROR_NOT_INITIALISED,
  CANHIL_TARGET_HEARTBEAT_ERROR_INPUT_LOST,
  CANHIL_TARGET_HEARTBEAT_ERROR_INPUT_SILENT,
  CANHIL_TARGET_HEARTBEAT_ERROR_NUMERIC,
  CANHIL_TARGET_HEARTBEAT_ERROR_COMMAND,
  CANHIL_TARGET_HEARTBEAT_VALUES
};
enum {
  CANHIL_TARGET_TIMING_QUEUE_MAX_US, /* [us] */
  CANHIL_TARGET_TIMING_QUEUE_MEAN_US, /* [us] */
  CANHIL_TARGET_TIMING_COMPUTE_MAX_US, /* [us] */
  CANHIL_TARGET_TIMING_COMPUTE_MEAN_US, /* [us] */
  CANHIL_TARGET_TIMING_VALUES
};
enum {
  CANHIL_TARGET_COUNTERS_FRAMES_LOST,
  CANHIL_TARGET_COUNTERS_BAD_CRC,
  CANHIL_TARGET_COUNTERS_BAD_GROUP,
  CANHIL_TARGET_COUNTERS_LATE,
  CANHIL_TARGET_COUNTERS_VALUES
};
enum {
  CANHIL_SSBL_RELATIVE_NORTH_M, /* [m] */
  CANHIL_SSBL_RELATIVE_EAST_M, /* [m] */
  CANHIL_SSBL_POSITION_VALIDITY,
  CANHIL_SSBL_LATITUDE_DEG, /* [deg] */
  CANHIL_SSBL_HEIGHT_M, /* [m] */
  CANHIL_SSBL_LONGITUDE_DEG, /* [deg] */
  CANHIL_SSBL_RELATIVE_SIGMA_M, /* [m] */
  CANHIL_SSBL_RELATIVE_DOWN_M, /* [m] */
  CANHIL_SSBL_TIME_OF_VALIDITY_US, /* [us] */
  CANHIL_SSBL_VALUES
};
enum {
  CANHIL_GPS_LATITUDE_DEG, /* [deg] */
  CANHIL_GPS_HEIGHT_M, /* [m] */
  CANHIL_GPS_LONGITUDE_DEG, /* [deg] */
  CANHIL_GPS_SATELLITES,
  CANHIL_GPS_POSITION_VALIDITY,
  CANHIL_GPS_HORIZONTAL_SIGMA_M, /* [m] */
  CANHIL_GPS_VERTICAL_SIGMA_M, /* [m] */
  CANHIL_GPS_TIME_OF_VALIDITY_US, /* [us] */
  CANHIL_GPS_VALUES
};
enum {
  CANHIL_FIX_FILTER_INNOVATION_NORTH_M, /* [m] */
  CANHIL_FIX_FILTER_INNOVATION_EAST_M, /* [m] */
  CANHIL_FIX_FILTER_INNOVATION_DOWN_M, /* [m] */
  CANHIL_FIX_FILTER_LATITUDE_DEG, /* [deg] */
  CANHIL_FIX_FILTER_HEIGHT_M, /* [m] */
  CANHIL_FIX_FILTER_LONGITUDE_DEG, /* [deg] */
  CANHIL_FIX_FILTER_TILT_SIGMA_NORTH_DEG, /* [deg] */
  CANHIL_FIX_FILTER_TILT_SIGMA_EAST_DEG, /* [deg] */
  CANHIL_FIX_FILTER_HEADING_SIGMA_DEG, /* [deg] */
  CANHIL_FIX_FILTER_VELOCITY_SIGMA_NORTH_MPS, /* [m/s] */
  CANHIL_FIX_FILTER_VELOCITY_SIGMA_EAST_MPS, /* [m/s] */
  CANHIL_FIX_FILTER_VELOCITY_SIGMA_DOWN_MPS, /* [m/s] */
  CANHIL_FIX_FILTER_POSITION_SIGMA_NORTH_M, /* [m] */
  CANHIL_FIX_FILTER_POSITION_SIGMA_EAST_M, /* [m] */
  CANHIL_FIX_FILTER_POSITION_SIGMA_DOWN_M, /* [m] */
  CANHIL_FIX_FILTER_GYRO_BIAS_X_DEGPH, /* [deg/h] */
  CANHIL_FIX_FILTER_GYRO_BIAS_Y_DEGPH, /* [deg/h] */
  CANHIL_FIX_FILTER_GYRO_BIAS_Z_DEGPH, /* [deg/h] */
  CANHIL_FIX_FILTER_GYRO_BIAS_SIGMA_X_DEGPH, /* [deg/h] */
  CANHIL_FIX_FILTER_GYRO_BIAS_SIGMA_Y_DEGPH, /* [deg/h] */
  CANHIL_FIX_FILTER_GYRO_BIAS_SIGMA_Z_DEGPH, /* [deg/h] */
  CANHIL_FIX_FILTER_ACCEL_BIAS_X_UG, /* [ug] */
  CANHIL_FIX_FILTER_ACCEL_BIAS_Y_UG, /* [ug] */
  CANHIL_FIX_FILTER_ACCEL_BIAS_Z_UG, /* [ug] */
  CANHIL_FIX_FILTER_ACCEL_BIAS_SIGMA_X_UG, /* [ug] */
  CANHIL_FIX_FILTER_ACCEL_BIAS_SIGMA_Y_UG, /* [ug] */
  CANHIL_FIX_FILTER_ACCEL_BIAS_SIGMA_Z_UG, /* [ug] */
  CANHIL_FIX_FILTER_FIX_BIAS_NORTH_M, /* [m] */
  CANHIL_FIX_FILTER_FIX_BIAS_EAST_M, /* [m] */
  CANHIL_FIX_FILTER_FIX_BIAS_DOWN_M, /* [m] */
  CANHIL_FIX_FILTER_FIX_BIAS_SIGMA_NORTH_M, /* [m] */
  CANHIL_FIX_FILTER_FIX_BIAS_SIGMA_EAST_M, /* [m] */
  CANHIL_FIX_FILTER_FIX_BIAS_SIGMA_DOWN_M, /* [m] */
  CANHIL_FIX_FILTER_OUTCOME,
  CANHIL_FIX_FILTER_SOURCE,
  CANHIL_FIX_FILTER_HANDED_OVER,
  CANHIL_FIX_FILTER_REPAIRS,
  CANHIL_FIX_FILTER_GATED,
  CANHIL_FIX_FILTER_REFUSED,
  CANHIL_FIX_FILTER_CAUSE_TIME_US, /* [us] */
  CANHIL_FIX_FILTER_CAUSE_COUNTER,
  CANHIL_FIX_FILTER_NIS,
  CANHIL_FIX_FILTER_VALUES
};
enum {
  CANHIL_TARGET_COMMAND_COMMAND,
  CANHIL_TARGET_COMMAND_ESTIMATOR,
  CANHIL_TARGET_COMMAND_ALGORITHM,
  CANHIL_TARGET_COMMAND_DBC_HASH,
  CANHIL_TARGET_COMMAND_VALUES
};
enum {
  CANHIL_PARAM_SET_PARAMETER,
  CANHIL_PARAM_SET_VALUE,
  CANHIL_PARAM_SET_VALUES
};
enum {
  CANHIL_PARAM_ACK_PARAMETER,
  CANHIL_PARAM_ACK_VALUE,
  CANHIL_PARAM_ACK_STATUS,
  CANHIL_PARAM_ACK_VALUES
};
enum {
  CANHIL_STEP_DONE_STEP,
  CANHIL_STEP_DONE_VALUES
};
enum {
  CANHIL_TARGET_INIT_AIR_RATE_X_DEGPS, /* [deg/s] */
  CANHIL_TARGET_INIT_AIR_RATE_Y_DEGPS, /* [deg/s] */
  CANHIL_TARGET_INIT_AIR_RATE_Z_DEGPS, /* [deg/s] */
  CANHIL_TARGET_INIT_AIR_AIR_VELOCITY_X_MPS, /* [m/s] */
  CANHIL_TARGET_INIT_AIR_AIR_VELOCITY_Y_MPS, /* [m/s] */
  CANHIL_TARGET_INIT_AIR_AIR_VELOCITY_Z_MPS, /* [m/s] */
  CANHIL_TARGET_INIT_AIR_VALUES
};
enum {
  CANHIL_TARGET_INIT_LATITUDE_DEG, /* [deg] */
  CANHIL_TARGET_INIT_HEIGHT_M, /* [m] */
  CANHIL_TARGET_INIT_LONGITUDE_DEG, /* [deg] */
  CANHIL_TARGET_INIT_POSITION_SIGMA_M, /* [m] */
  CANHIL_TARGET_INIT_VELOCITY_NORTH_MPS, /* [m/s] */
  CANHIL_TARGET_INIT_VELOCITY_EAST_MPS, /* [m/s] */
  CANHIL_TARGET_INIT_ROLL_DEG, /* [deg] */
  CANHIL_TARGET_INIT_PITCH_DEG, /* [deg] */
  CANHIL_TARGET_INIT_HEADING_DEG, /* [deg] */
  CANHIL_TARGET_INIT_VELOCITY_SIGMA_MPS, /* [m/s] */
  CANHIL_TARGET_INIT_TILT_SIGMA_DEG, /* [deg] */
  CANHIL_TARGET_INIT_HEADING_SIGMA_DEG, /* [deg] */
  CANHIL_TARGET_INIT_VELOCITY_DOWN_MPS, /* [m/s] */
  CANHIL_TARGET_INIT_TIME_OF_VALIDITY_US, /* [us] */
  CANHIL_TARGET_INIT_VALUES
};

enum { CANHIL_MESSAGES = 81, CANHIL_MOST_VALUES = 42 };
#define CANHIL_HEARTBEAT_MS 100

#ifdef CANHIL_TABLES
enum { CANHIL_UNSIGNED, CANHIL_SIGNED, CANHIL_FLOAT };

/* value = raw * scale + offset; raw is held in [lowest, highest]. start counts as in an Intel DBC. */
typedef struct { unsigned char start, length, kind; double scale, offset, lowest, highest; } canhil_signal;
static const canhil_signal canhil_signals[] = {
  {12, 17, CANHIL_SIGNED, 1e-06, 0.0, -65500.0, 65500.0}, /* SeekerAntenna.antenna_increment_roll_rad */
  {29, 17, CANHIL_SIGNED, 1e-06, 0.0, -65500.0, 65500.0}, /* SeekerAntenna.antenna_increment_pitch_rad */
  {46, 17, CANHIL_SIGNED, 1e-06, 0.0, -65500.0, 65500.0}, /* SeekerAntenna.antenna_increment_yaw_rad */
  {63, 1, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 1.0}, /* SeekerAntenna.antenna_validity */
  {12, 16, CANHIL_SIGNED, 2e-05, 0.0, -32750.0, 32750.0}, /* SeekerAngles.error_pitch_rad */
  {28, 16, CANHIL_SIGNED, 2e-05, 0.0, -32750.0, 32750.0}, /* SeekerAngles.error_yaw_rad */
  {44, 12, CANHIL_UNSIGNED, 10.0, 0.0, 0.0, 4095.0}, /* SeekerAngles.interval_us */
  {56, 1, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 1.0}, /* SeekerAngles.error_validity */
  {12, 16, CANHIL_SIGNED, 0.02, 0.0, -32750.0, 32750.0}, /* SeekerMotion.missile_acceleration_y_mps2 */
  {28, 16, CANHIL_SIGNED, 0.02, 0.0, -32750.0, 32750.0}, /* SeekerMotion.missile_acceleration_z_mps2 */
  {44, 14, CANHIL_SIGNED, 0.5, 0.0, -8190.0, 8190.0}, /* SeekerMotion.closing_speed_mps */
  {58, 1, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 1.0}, /* SeekerMotion.acceleration_validity */
  {59, 1, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 1.0}, /* SeekerMotion.closing_speed_validity */
  {12, 19, CANHIL_SIGNED, 0.1, 0.0, -262140.0, 262140.0}, /* SeekerRange.range_m */
  {31, 32, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 4294967295.0}, /* SeekerRange.time_of_validity_us */
  {63, 1, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 1.0}, /* SeekerRange.range_validity */
  {12, 20, CANHIL_SIGNED, 1e-05, 0.0, -524000.0, 524000.0}, /* LosRateEstimate.los_rate_pitch_radps */
  {32, 20, CANHIL_SIGNED, 1e-05, 0.0, -524000.0, 524000.0}, /* LosRateEstimate.los_rate_yaw_radps */
  {52, 4, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 14.0}, /* LosRateEstimate.cause_counter */
  {56, 3, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 7.0}, /* LosRateEstimate.outcome */
  {59, 4, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 15.0}, /* LosRateEstimate.fault */
  {63, 1, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 1.0}, /* LosRateEstimate.blind */
  {12, 14, CANHIL_UNSIGNED, 2e-05, 0.0, 0.0, 16350.0}, /* LosRateSigma.los_rate_sigma_pitch_radps */
  {26, 14, CANHIL_UNSIGNED, 2e-05, 0.0, 0.0, 16350.0}, /* LosRateSigma.los_rate_sigma_yaw_radps */
  {40, 6, CANHIL_UNSIGNED, 2.5, 0.0, 0.0, 63.0}, /* LosRateSigma.target_acceleration_sigma_y_mps2 */
  {46, 6, CANHIL_UNSIGNED, 2.5, 0.0, 0.0, 63.0}, /* LosRateSigma.target_acceleration_sigma_z_mps2 */
  {52, 12, CANHIL_UNSIGNED, 0.05, 0.0, 0.0, 4095.0}, /* LosRateSigma.nis */
  {12, 10, CANHIL_SIGNED, 0.5, 0.0, -510.0, 510.0}, /* LosRateTarget.target_acceleration_y_mps2 */
  {22, 10, CANHIL_SIGNED, 0.5, 0.0, -510.0, 510.0}, /* LosRateTarget.target_acceleration_z_mps2 */
  {32, 32, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 4294967295.0}, /* LosRateTarget.cause_time_us */
  {12, 17, CANHIL_SIGNED, 2e-06, 0.0, -65500.0, 65500.0}, /* SlaveImuDeltaTheta.delta_theta_x_rad */
  {29, 17, CANHIL_SIGNED, 2e-06, 0.0, -65500.0, 65500.0}, /* SlaveImuDeltaTheta.delta_theta_y_rad */
  {46, 17, CANHIL_SIGNED, 2e-06, 0.0, -65500.0, 65500.0}, /* SlaveImuDeltaTheta.delta_theta_z_rad */
  {63, 1, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 1.0}, /* SlaveImuDeltaTheta.gyro_validity */
  {12, 17, CANHIL_SIGNED, 2e-05, 0.0, -65500.0, 65500.0}, /* SlaveImuDeltaV.delta_v_x_mps */
  {29, 17, CANHIL_SIGNED, 2e-05, 0.0, -65500.0, 65500.0}, /* SlaveImuDeltaV.delta_v_y_mps */
  {46, 17, CANHIL_SIGNED, 2e-05, 0.0, -65500.0, 65500.0}, /* SlaveImuDeltaV.delta_v_z_mps */
  {63, 1, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 1.0}, /* SlaveImuDeltaV.accel_validity */
  {12, 32, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 4294967295.0}, /* SlaveImuStatus.time_of_validity_us */
  {44, 12, CANHIL_UNSIGNED, 10.0, 0.0, 0.0, 4095.0}, /* SlaveImuStatus.interval_us */
  {56, 8, CANHIL_SIGNED, 1.0, 0.0, -128.0, 127.0}, /* SlaveImuStatus.temperature_degc */
  {12, 40, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 1099511627775.0}, /* Sync.time_us */
  {52, 11, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 2047.0}, /* Sync.step */
  {63, 1, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 1.0}, /* Sync.lockstep */
  {12, 17, CANHIL_SIGNED, 0.003, 0.0, -60000.0, 60000.0}, /* AlignAttitude.roll_deg */
  {29, 17, CANHIL_SIGNED, 0.003, 0.0, -60000.0, 60000.0}, /* AlignAttitude.pitch_deg */
  {46, 17, CANHIL_SIGNED, 0.003, 0.0, -60000.0, 60000.0}, /* AlignAttitude.heading_deg */
  {63, 1, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 1.0}, /* AlignAttitude.coasting */
  {12, 24, CANHIL_SIGNED, 0.0002, 0.0, -8385000.0, 8385000.0}, /* AlignVelocityNE.velocity_north_mps */
  {36, 24, CANHIL_SIGNED, 0.0002, 0.0, -8385000.0, 8385000.0}, /* AlignVelocityNE.velocity_east_mps */
  {60, 4, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 14.0}, /* AlignVelocityNE.cause_counter */
  {12, 20, CANHIL_SIGNED, 0.002, 0.0, -524000.0, 524000.0}, /* AlignVelocityD.velocity_down_mps */
  {32, 32, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 4294967295.0}, /* AlignVelocityD.cause_time_us */
  {12, 17, CANHIL_SIGNED, 0.003, 0.0, -60000.0, 60000.0}, /* FixAttitude.roll_deg */
  {29, 17, CANHIL_SIGNED, 0.003, 0.0, -60000.0, 60000.0}, /* FixAttitude.pitch_deg */
  {46, 17, CANHIL_SIGNED, 0.003, 0.0, -60000.0, 60000.0}, /* FixAttitude.heading_deg */
  {63, 1, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 1.0}, /* FixAttitude.coasting */
  {12, 24, CANHIL_SIGNED, 0.0002, 0.0, -8385000.0, 8385000.0}, /* FixVelocityNE.velocity_north_mps */
  {36, 24, CANHIL_SIGNED, 0.0002, 0.0, -8385000.0, 8385000.0}, /* FixVelocityNE.velocity_east_mps */
  {60, 4, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 14.0}, /* FixVelocityNE.cause_counter */
  {12, 20, CANHIL_SIGNED, 0.002, 0.0, -524000.0, 524000.0}, /* FixVelocityD.velocity_down_mps */
  {32, 32, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 4294967295.0}, /* FixVelocityD.cause_time_us */
  {12, 12, CANHIL_SIGNED, 0.02, 0.0, -2047.0, 2047.0}, /* FinDeflections.elevator_deg */
  {24, 12, CANHIL_SIGNED, 0.02, 0.0, -2047.0, 2047.0}, /* FinDeflections.aileron_deg */
  {36, 12, CANHIL_SIGNED, 0.02, 0.0, -2047.0, 2047.0}, /* FinDeflections.rudder_deg */
  {48, 16, CANHIL_UNSIGNED, 10.0, 0.0, 0.0, 65535.0}, /* FinDeflections.time_of_validity_us */
  {12, 16, CANHIL_SIGNED, 0.02, 0.0, -32767.0, 32767.0}, /* GliderNavVelocityNE.velocity_north_mps */
  {28, 16, CANHIL_SIGNED, 0.02, 0.0, -32767.0, 32767.0}, /* GliderNavVelocityNE.velocity_east_mps */
  {44, 20, CANHIL_UNSIGNED, 0.1, -10000.0, 0.0, 1048575.0}, /* GliderNavVelocityNE.height_m */
  {12, 17, CANHIL_SIGNED, 0.003, 0.0, -60000.0, 60000.0}, /* GliderNavAttitude.roll_deg */
  {29, 17, CANHIL_SIGNED, 0.003, 0.0, -60000.0, 60000.0}, /* GliderNavAttitude.pitch_deg */
  {46, 17, CANHIL_SIGNED, 0.003, 0.0, -60000.0, 60000.0}, /* GliderNavAttitude.heading_deg */
  {63, 1, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 1.0}, /* GliderNavAttitude.navigation_validity */
  {12, 17, CANHIL_SIGNED, 0.005, 0.0, -65535.0, 65535.0}, /* GliderNavRates.rate_x_degps */
  {29, 17, CANHIL_SIGNED, 0.005, 0.0, -65535.0, 65535.0}, /* GliderNavRates.rate_y_degps */
  {46, 17, CANHIL_SIGNED, 0.005, 0.0, -65535.0, 65535.0}, /* GliderNavRates.rate_z_degps */
  {12, 20, CANHIL_SIGNED, 0.002, 0.0, -524000.0, 524000.0}, /* GliderNavVelocityD.velocity_down_mps */
  {32, 32, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 4294967295.0}, /* GliderNavVelocityD.time_of_validity_us */
  {12, 17, CANHIL_SIGNED, 0.003, 0.0, -65533.0, 65533.0}, /* WindVector.wind_north_mps */
  {29, 17, CANHIL_SIGNED, 0.003, 0.0, -65533.0, 65533.0}, /* WindVector.wind_east_mps */
  {46, 17, CANHIL_SIGNED, 0.003, 0.0, -65533.0, 65533.0}, /* WindVector.wind_down_mps */
  {63, 1, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 1.0}, /* WindVector.started */
  {12, 16, CANHIL_UNSIGNED, 0.005, 0.0, 0.0, 65535.0}, /* WindSpeed.wind_speed_mps */
  {28, 16, CANHIL_UNSIGNED, 0.01, 0.0, 0.0, 36000.0}, /* WindSpeed.wind_from_deg */
  {44, 3, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 7.0}, /* WindSpeed.outcome */
  {47, 3, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 7.0}, /* WindSpeed.fault */
  {50, 1, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 1.0}, /* WindSpeed.outside_alpha */
  {51, 1, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 1.0}, /* WindSpeed.outside_beta */
  {52, 1, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 1.0}, /* WindSpeed.outside_speed */
  {53, 1, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 1.0}, /* WindSpeed.outside_mach */
  {54, 1, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 1.0}, /* WindSpeed.outside_altitude */
  {55, 1, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 1.0}, /* WindSpeed.outside_pitch */
  {56, 1, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 1.0}, /* WindSpeed.fins_late */
  {57, 1, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 1.0}, /* WindSpeed.fins_missing */
  {58, 1, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 1.0}, /* WindSpeed.fins_not_physical */
  {59, 1, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 1.0}, /* WindSpeed.theta_capped */
  {12, 17, CANHIL_UNSIGNED, 0.001, 0.0, 0.0, 131000.0}, /* WindSigma.wind_sigma_north_mps */
  {29, 17, CANHIL_UNSIGNED, 0.001, 0.0, 0.0, 131000.0}, /* WindSigma.wind_sigma_east_mps */
  {46, 17, CANHIL_UNSIGNED, 0.001, 0.0, 0.0, 131000.0}, /* WindSigma.wind_sigma_down_mps */
  {12, 17, CANHIL_SIGNED, 2e-05, 0.0, -50000.0, 50000.0}, /* WindCorrelation.wind_correlation_ne */
  {29, 17, CANHIL_SIGNED, 2e-05, 0.0, -50000.0, 50000.0}, /* WindCorrelation.wind_correlation_nd */
  {46, 17, CANHIL_SIGNED, 2e-05, 0.0, -50000.0, 50000.0}, /* WindCorrelation.wind_correlation_ed */
  {12, 13, CANHIL_UNSIGNED, 0.005, 0.0, 0.0, 8191.0}, /* WindTrackSigma.along_track_sigma_mps */
  {25, 13, CANHIL_UNSIGNED, 0.005, 0.0, 0.0, 8191.0}, /* WindTrackSigma.cross_track_sigma_mps */
  {38, 13, CANHIL_UNSIGNED, 0.005, 0.0, 0.0, 8191.0}, /* WindTrackSigma.wind_speed_sigma_mps */
  {51, 13, CANHIL_UNSIGNED, 0.02, 0.0, 0.0, 8191.0}, /* WindTrackSigma.wind_from_sigma_deg */
  {12, 17, CANHIL_SIGNED, 0.01, 0.0, -65535.0, 65535.0}, /* WindAirVelocity.air_velocity_x_mps */
  {29, 17, CANHIL_SIGNED, 0.01, 0.0, -65535.0, 65535.0}, /* WindAirVelocity.air_velocity_y_mps */
  {46, 17, CANHIL_SIGNED, 0.01, 0.0, -65535.0, 65535.0}, /* WindAirVelocity.air_velocity_z_mps */
  {12, 17, CANHIL_SIGNED, 0.003, 0.0, -60000.0, 60000.0}, /* WindAttitude.roll_deg */
  {29, 17, CANHIL_SIGNED, 0.003, 0.0, -60000.0, 60000.0}, /* WindAttitude.pitch_deg */
  {46, 17, CANHIL_SIGNED, 0.003, 0.0, -60000.0, 60000.0}, /* WindAttitude.heading_deg */
  {12, 17, CANHIL_SIGNED, 0.003, 0.0, -65533.0, 65533.0}, /* WindInnovation.innovation_north_mps */
  {29, 17, CANHIL_SIGNED, 0.003, 0.0, -65533.0, 65533.0}, /* WindInnovation.innovation_east_mps */
  {46, 17, CANHIL_SIGNED, 0.003, 0.0, -65533.0, 65533.0}, /* WindInnovation.innovation_down_mps */
  {12, 32, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 4294967295.0}, /* WindUpdate.cause_time_us */
  {44, 4, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 14.0}, /* WindUpdate.cause_counter */
  {48, 16, CANHIL_UNSIGNED, 0.05, 0.0, 0.0, 65535.0}, /* WindUpdate.nis */
  {12, 24, CANHIL_SIGNED, 0.0002, 0.0, -8385000.0, 8385000.0}, /* MasterInsVelocityNE.velocity_north_mps */
  {36, 24, CANHIL_SIGNED, 0.0002, 0.0, -8385000.0, 8385000.0}, /* MasterInsVelocityNE.velocity_east_mps */
  {60, 1, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 1.0}, /* MasterInsVelocityNE.velocity_validity */
  {12, 17, CANHIL_SIGNED, 0.003, 0.0, -60000.0, 60000.0}, /* MasterInsAttitude.roll_deg */
  {29, 17, CANHIL_SIGNED, 0.003, 0.0, -60000.0, 60000.0}, /* MasterInsAttitude.pitch_deg */
  {46, 17, CANHIL_SIGNED, 0.003, 0.0, -60000.0, 60000.0}, /* MasterInsAttitude.heading_deg */
  {12, 32, CANHIL_SIGNED, 1e-07, 0.0, -900000000.0, 900000000.0}, /* MasterInsLatitude.latitude_deg */
  {44, 20, CANHIL_UNSIGNED, 0.1, -10000.0, 0.0, 1048575.0}, /* MasterInsLatitude.height_m */
  {12, 32, CANHIL_SIGNED, 1e-07, 0.0, -1800000001.0, 1800000001.0}, /* MasterInsLongitude.longitude_deg */
  {12, 20, CANHIL_SIGNED, 0.002, 0.0, -524000.0, 524000.0}, /* MasterInsVelocityD.velocity_down_mps */
  {32, 32, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 4294967295.0}, /* MasterInsVelocityD.time_of_validity_us */
  {12, 17, CANHIL_SIGNED, 0.001, 0.0, -65500.0, 65500.0}, /* AlignInnovation.innovation_north_mps */
  {29, 17, CANHIL_SIGNED, 0.001, 0.0, -65500.0, 65500.0}, /* AlignInnovation.innovation_east_mps */
  {46, 17, CANHIL_SIGNED, 0.001, 0.0, -65500.0, 65500.0}, /* AlignInnovation.innovation_down_mps */
  {12, 17, CANHIL_UNSIGNED, 1e-05, 0.0, 0.0, 131000.0}, /* AlignAttitudeSigma.attitude_sigma_north_rad */
  {29, 17, CANHIL_UNSIGNED, 1e-05, 0.0, 0.0, 131000.0}, /* AlignAttitudeSigma.attitude_sigma_east_rad */
  {46, 17, CANHIL_UNSIGNED, 1e-05, 0.0, 0.0, 131000.0}, /* AlignAttitudeSigma.attitude_sigma_down_rad */
  {12, 17, CANHIL_SIGNED, 2e-05, 0.0, -50000.0, 50000.0}, /* AlignAttitudeCorrelation.attitude_correlation_ne */
  {29, 17, CANHIL_SIGNED, 2e-05, 0.0, -50000.0, 50000.0}, /* AlignAttitudeCorrelation.attitude_correlation_nd */
  {46, 17, CANHIL_SIGNED, 2e-05, 0.0, -50000.0, 50000.0}, /* AlignAttitudeCorrelation.attitude_correlation_ed */
  {12, 17, CANHIL_UNSIGNED, 0.0001, 0.0, 0.0, 131000.0}, /* AlignVelocitySigma.velocity_sigma_north_mps */
  {29, 17, CANHIL_UNSIGNED, 0.0001, 0.0, 0.0, 131000.0}, /* AlignVelocitySigma.velocity_sigma_east_mps */
  {46, 17, CANHIL_UNSIGNED, 0.0001, 0.0, 0.0, 131000.0}, /* AlignVelocitySigma.velocity_sigma_down_mps */
  {12, 17, CANHIL_SIGNED, 0.002, 0.0, -65500.0, 65500.0}, /* AlignGyroBias.gyro_bias_x_degph */
  {29, 17, CANHIL_SIGNED, 0.002, 0.0, -65500.0, 65500.0}, /* AlignGyroBias.gyro_bias_y_degph */
  {46, 17, CANHIL_SIGNED, 0.002, 0.0, -65500.0, 65500.0}, /* AlignGyroBias.gyro_bias_z_degph */
  {12, 17, CANHIL_UNSIGNED, 0.001, 0.0, 0.0, 131000.0}, /* AlignGyroBiasSigma.gyro_bias_sigma_x_degph */
  {29, 17, CANHIL_UNSIGNED, 0.001, 0.0, 0.0, 131000.0}, /* AlignGyroBiasSigma.gyro_bias_sigma_y_degph */
  {46, 17, CANHIL_UNSIGNED, 0.001, 0.0, 0.0, 131000.0}, /* AlignGyroBiasSigma.gyro_bias_sigma_z_degph */
  {12, 17, CANHIL_SIGNED, 0.5, 0.0, -65534.0, 65534.0}, /* AlignAccelBias.accel_bias_x_ug */
  {29, 17, CANHIL_SIGNED, 0.5, 0.0, -65534.0, 65534.0}, /* AlignAccelBias.accel_bias_y_ug */
  {46, 17, CANHIL_SIGNED, 0.5, 0.0, -65534.0, 65534.0}, /* AlignAccelBias.accel_bias_z_ug */
  {12, 17, CANHIL_UNSIGNED, 0.5, 0.0, 0.0, 131070.0}, /* AlignAccelBiasSigma.accel_bias_sigma_x_ug */
  {29, 17, CANHIL_UNSIGNED, 0.5, 0.0, 0.0, 131070.0}, /* AlignAccelBiasSigma.accel_bias_sigma_y_ug */
  {46, 17, CANHIL_UNSIGNED, 0.5, 0.0, 0.0, 131070.0}, /* AlignAccelBiasSigma.accel_bias_sigma_z_ug */
  {12, 32, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 4294967295.0}, /* AlignUpdate.cause_time_us */
  {44, 4, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 14.0}, /* AlignUpdate.cause_counter */
  {48, 16, CANHIL_UNSIGNED, 0.01, 0.0, 0.0, 65535.0}, /* AlignUpdate.nis */
  {12, 3, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 7.0}, /* TargetHeartbeat.state */
  {15, 3, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 7.0}, /* TargetHeartbeat.estimator */
  {18, 5, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 31.0}, /* TargetHeartbeat.algorithm */
  {23, 24, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 16777215.0}, /* TargetHeartbeat.dbc_hash */
  {47, 4, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 15.0}, /* TargetHeartbeat.version_major */
  {51, 4, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 15.0}, /* TargetHeartbeat.version_minor */
  {55, 1, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 1.0}, /* TargetHeartbeat.error_dbc_mismatch */
  {56, 1, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 1.0}, /* TargetHeartbeat.error_not_initialised */
  {57, 1, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 1.0}, /* TargetHeartbeat.error_input_lost */
  {58, 1, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 1.0}, /* TargetHeartbeat.error_input_silent */
  {59, 1, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 1.0}, /* TargetHeartbeat.error_numeric */
  {60, 1, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 1.0}, /* TargetHeartbeat.error_command */
  {12, 13, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 8191.0}, /* TargetTiming.queue_max_us */
  {25, 13, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 8191.0}, /* TargetTiming.queue_mean_us */
  {38, 13, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 8191.0}, /* TargetTiming.compute_max_us */
  {51, 13, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 8191.0}, /* TargetTiming.compute_mean_us */
  {12, 13, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 8191.0}, /* TargetCounters.frames_lost */
  {25, 13, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 8191.0}, /* TargetCounters.bad_crc */
  {38, 13, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 8191.0}, /* TargetCounters.bad_group */
  {51, 13, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 8191.0}, /* TargetCounters.late */
  {12, 24, CANHIL_SIGNED, 0.01, 0.0, -8388600.0, 8388600.0}, /* SsblRelativeNE.relative_north_m */
  {36, 24, CANHIL_SIGNED, 0.01, 0.0, -8388600.0, 8388600.0}, /* SsblRelativeNE.relative_east_m */
  {60, 1, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 1.0}, /* SsblRelativeNE.position_validity */
  {12, 32, CANHIL_SIGNED, 1e-07, 0.0, -900000000.0, 900000000.0}, /* SsblShipLatitude.latitude_deg */
  {44, 20, CANHIL_UNSIGNED, 0.1, -10000.0, 0.0, 1048575.0}, /* SsblShipLatitude.height_m */
  {12, 32, CANHIL_SIGNED, 1e-07, 0.0, -1800000001.0, 1800000001.0}, /* SsblShipLongitude.longitude_deg */
  {44, 16, CANHIL_UNSIGNED, 0.01, 0.0, 0.0, 65535.0}, /* SsblShipLongitude.relative_sigma_m */
  {12, 20, CANHIL_SIGNED, 0.01, 0.0, -524200.0, 524200.0}, /* SsblRelativeD.relative_down_m */
  {32, 32, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 4294967295.0}, /* SsblRelativeD.time_of_validity_us */
  {12, 32, CANHIL_SIGNED, 1e-07, 0.0, -900000000.0, 900000000.0}, /* GpsLatitude.latitude_deg */
  {44, 20, CANHIL_UNSIGNED, 0.1, -10000.0, 0.0, 1048575.0}, /* GpsLatitude.height_m */
  {12, 32, CANHIL_SIGNED, 1e-07, 0.0, -1800000001.0, 1800000001.0}, /* GpsLongitude.longitude_deg */
  {44, 5, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 31.0}, /* GpsLongitude.satellites */
  {63, 1, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 1.0}, /* GpsLongitude.position_validity */
  {12, 10, CANHIL_UNSIGNED, 0.1, 0.0, 0.0, 1023.0}, /* GpsTime.horizontal_sigma_m */
  {22, 10, CANHIL_UNSIGNED, 0.1, 0.0, 0.0, 1023.0}, /* GpsTime.vertical_sigma_m */
  {32, 32, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 4294967295.0}, /* GpsTime.time_of_validity_us */
  {12, 17, CANHIL_SIGNED, 0.05, 0.0, -65520.0, 65520.0}, /* FixInnovation.innovation_north_m */
  {29, 17, CANHIL_SIGNED, 0.05, 0.0, -65520.0, 65520.0}, /* FixInnovation.innovation_east_m */
  {46, 17, CANHIL_SIGNED, 0.05, 0.0, -65520.0, 65520.0}, /* FixInnovation.innovation_down_m */
  {12, 32, CANHIL_SIGNED, 1e-07, 0.0, -900000000.0, 900000000.0}, /* FixPositionLatitude.latitude_deg */
  {44, 20, CANHIL_UNSIGNED, 0.1, -10000.0, 0.0, 1048575.0}, /* FixPositionLatitude.height_m */
  {12, 32, CANHIL_SIGNED, 1e-07, 0.0, -1800000001.0, 1800000001.0}, /* FixPositionLongitude.longitude_deg */
  {12, 17, CANHIL_UNSIGNED, 0.0005, 0.0, 0.0, 131000.0}, /* FixAttitudeSigma.tilt_sigma_north_deg */
  {29, 17, CANHIL_UNSIGNED, 0.0005, 0.0, 0.0, 131000.0}, /* FixAttitudeSigma.tilt_sigma_east_deg */
  {46, 18, CANHIL_UNSIGNED, 0.001, 0.0, 0.0, 262000.0}, /* FixAttitudeSigma.heading_sigma_deg */
  {12, 17, CANHIL_UNSIGNED, 0.0005, 0.0, 0.0, 131000.0}, /* FixVelocitySigma.velocity_sigma_north_mps */
  {29, 17, CANHIL_UNSIGNED, 0.0005, 0.0, 0.0, 131000.0}, /* FixVelocitySigma.velocity_sigma_east_mps */
  {46, 17, CANHIL_UNSIGNED, 0.0005, 0.0, 0.0, 131000.0}, /* FixVelocitySigma.velocity_sigma_down_mps */
  {12, 17, CANHIL_UNSIGNED, 0.02, 0.0, 0.0, 131050.0}, /* FixPositionSigma.position_sigma_north_m */
  {29, 17, CANHIL_UNSIGNED, 0.02, 0.0, 0.0, 131050.0}, /* FixPositionSigma.position_sigma_east_m */
  {46, 17, CANHIL_UNSIGNED, 0.02, 0.0, 0.0, 131050.0}, /* FixPositionSigma.position_sigma_down_m */
  {12, 17, CANHIL_SIGNED, 0.002, 0.0, -65500.0, 65500.0}, /* FixGyroBias.gyro_bias_x_degph */
  {29, 17, CANHIL_SIGNED, 0.002, 0.0, -65500.0, 65500.0}, /* FixGyroBias.gyro_bias_y_degph */
  {46, 17, CANHIL_SIGNED, 0.002, 0.0, -65500.0, 65500.0}, /* FixGyroBias.gyro_bias_z_degph */
  {12, 17, CANHIL_UNSIGNED, 0.001, 0.0, 0.0, 131000.0}, /* FixGyroBiasSigma.gyro_bias_sigma_x_degph */
  {29, 17, CANHIL_UNSIGNED, 0.001, 0.0, 0.0, 131000.0}, /* FixGyroBiasSigma.gyro_bias_sigma_y_degph */
  {46, 17, CANHIL_UNSIGNED, 0.001, 0.0, 0.0, 131000.0}, /* FixGyroBiasSigma.gyro_bias_sigma_z_degph */
  {12, 17, CANHIL_SIGNED, 0.5, 0.0, -65534.0, 65534.0}, /* FixAccelBias.accel_bias_x_ug */
  {29, 17, CANHIL_SIGNED, 0.5, 0.0, -65534.0, 65534.0}, /* FixAccelBias.accel_bias_y_ug */
  {46, 17, CANHIL_SIGNED, 0.5, 0.0, -65534.0, 65534.0}, /* FixAccelBias.accel_bias_z_ug */
  {12, 17, CANHIL_UNSIGNED, 0.5, 0.0, 0.0, 131070.0}, /* FixAccelBiasSigma.accel_bias_sigma_x_ug */
  {29, 17, CANHIL_UNSIGNED, 0.5, 0.0, 0.0, 131070.0}, /* FixAccelBiasSigma.accel_bias_sigma_y_ug */
  {46, 17, CANHIL_UNSIGNED, 0.5, 0.0, 0.0, 131070.0}, /* FixAccelBiasSigma.accel_bias_sigma_z_ug */
  {12, 17, CANHIL_SIGNED, 0.002, 0.0, -65500.0, 65500.0}, /* FixBias.fix_bias_north_m */
  {29, 17, CANHIL_SIGNED, 0.002, 0.0, -65500.0, 65500.0}, /* FixBias.fix_bias_east_m */
  {46, 17, CANHIL_SIGNED, 0.002, 0.0, -65500.0, 65500.0}, /* FixBias.fix_bias_down_m */
  {12, 17, CANHIL_UNSIGNED, 0.001, 0.0, 0.0, 131000.0}, /* FixBiasSigma.fix_bias_sigma_north_m */
  {29, 17, CANHIL_UNSIGNED, 0.001, 0.0, 0.0, 131000.0}, /* FixBiasSigma.fix_bias_sigma_east_m */
  {46, 17, CANHIL_UNSIGNED, 0.001, 0.0, 0.0, 131000.0}, /* FixBiasSigma.fix_bias_sigma_down_m */
  {12, 4, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 15.0}, /* FixStatus.outcome */
  {16, 2, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 3.0}, /* FixStatus.source */
  {18, 1, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 1.0}, /* FixStatus.handed_over */
  {20, 16, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 65535.0}, /* FixStatus.repairs */
  {36, 14, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 16383.0}, /* FixStatus.gated */
  {50, 14, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 16383.0}, /* FixStatus.refused */
  {12, 32, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 4294967295.0}, /* FixUpdate.cause_time_us */
  {44, 4, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 14.0}, /* FixUpdate.cause_counter */
  {48, 16, CANHIL_UNSIGNED, 0.01, 0.0, 0.0, 65535.0}, /* FixUpdate.nis */
  {12, 3, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 7.0}, /* TargetCommand.command */
  {15, 3, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 7.0}, /* TargetCommand.estimator */
  {18, 5, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 31.0}, /* TargetCommand.algorithm */
  {23, 24, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 16777215.0}, /* TargetCommand.dbc_hash */
  {12, 8, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 255.0}, /* ParamSet.parameter */
  {20, 32, CANHIL_FLOAT, 1.0, 0.0, -3.4e+38, 3.4e+38}, /* ParamSet.value */
  {12, 8, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 255.0}, /* ParamAck.parameter */
  {20, 32, CANHIL_FLOAT, 1.0, 0.0, -3.4e+38, 3.4e+38}, /* ParamAck.value */
  {52, 4, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 15.0}, /* ParamAck.status */
  {12, 11, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 2047.0}, /* StepDone.step */
  {12, 17, CANHIL_SIGNED, 0.0005, 0.0, -65535.0, 65535.0}, /* TargetInitRate.rate_x_degps */
  {29, 17, CANHIL_SIGNED, 0.0005, 0.0, -65535.0, 65535.0}, /* TargetInitRate.rate_y_degps */
  {46, 17, CANHIL_SIGNED, 0.0005, 0.0, -65535.0, 65535.0}, /* TargetInitRate.rate_z_degps */
  {12, 17, CANHIL_SIGNED, 0.01, 0.0, -65535.0, 65535.0}, /* TargetInitAirVelocity.air_velocity_x_mps */
  {29, 17, CANHIL_SIGNED, 0.01, 0.0, -65535.0, 65535.0}, /* TargetInitAirVelocity.air_velocity_y_mps */
  {46, 17, CANHIL_SIGNED, 0.01, 0.0, -65535.0, 65535.0}, /* TargetInitAirVelocity.air_velocity_z_mps */
  {12, 32, CANHIL_SIGNED, 1e-07, 0.0, -900000000.0, 900000000.0}, /* TargetInitLatitude.latitude_deg */
  {44, 20, CANHIL_UNSIGNED, 0.1, -10000.0, 0.0, 1048575.0}, /* TargetInitLatitude.height_m */
  {12, 32, CANHIL_SIGNED, 1e-07, 0.0, -1800000001.0, 1800000001.0}, /* TargetInitLongitude.longitude_deg */
  {44, 20, CANHIL_UNSIGNED, 0.01, 0.0, 0.0, 1048500.0}, /* TargetInitLongitude.position_sigma_m */
  {12, 24, CANHIL_SIGNED, 0.0002, 0.0, -8385000.0, 8385000.0}, /* TargetInitVelocityNE.velocity_north_mps */
  {36, 24, CANHIL_SIGNED, 0.0002, 0.0, -8385000.0, 8385000.0}, /* TargetInitVelocityNE.velocity_east_mps */
  {12, 17, CANHIL_SIGNED, 0.003, 0.0, -60000.0, 60000.0}, /* TargetInitAttitude.roll_deg */
  {29, 17, CANHIL_SIGNED, 0.003, 0.0, -60000.0, 60000.0}, /* TargetInitAttitude.pitch_deg */
  {46, 17, CANHIL_SIGNED, 0.003, 0.0, -60000.0, 60000.0}, /* TargetInitAttitude.heading_deg */
  {12, 16, CANHIL_UNSIGNED, 0.001, 0.0, 0.0, 65535.0}, /* TargetInitSigma.velocity_sigma_mps */
  {28, 16, CANHIL_UNSIGNED, 0.01, 0.0, 0.0, 65535.0}, /* TargetInitSigma.tilt_sigma_deg */
  {44, 16, CANHIL_UNSIGNED, 0.01, 0.0, 0.0, 65535.0}, /* TargetInitSigma.heading_sigma_deg */
  {12, 20, CANHIL_SIGNED, 0.002, 0.0, -524000.0, 524000.0}, /* TargetInitVelocityD.velocity_down_mps */
  {32, 32, CANHIL_UNSIGNED, 1.0, 0.0, 0.0, 4294967295.0}, /* TargetInitVelocityD.time_of_validity_us */
};

/* In the order of groups, within a group in that of transmission. first_value: of its signals in the group's. */
typedef struct { unsigned short id, data_id; unsigned char size, group; unsigned short first_signal; unsigned char signals, first_value; } canhil_message;
static const canhil_message canhil_messages[] = {
  {0x70, 0x4070, 8, CANHIL_GROUP_SEEKER, 0, 4, 0}, /* SeekerAntenna */
  {0x71, 0x4071, 8, CANHIL_GROUP_SEEKER, 4, 4, 4}, /* SeekerAngles */
  {0x72, 0x4072, 8, CANHIL_GROUP_SEEKER, 8, 5, 8}, /* SeekerMotion */
  {0x73, 0x4073, 8, CANHIL_GROUP_SEEKER, 13, 3, 13}, /* SeekerRange */
  {0x78, 0x4078, 8, CANHIL_GROUP_LOS_RATE, 16, 6, 0}, /* LosRateEstimate */
  {0x79, 0x4079, 8, CANHIL_GROUP_LOS_RATE, 22, 5, 6}, /* LosRateSigma */
  {0x7A, 0x407A, 8, CANHIL_GROUP_LOS_RATE, 27, 3, 11}, /* LosRateTarget */
  {0x80, 0x4080, 8, CANHIL_GROUP_SLAVE_IMU, 30, 4, 0}, /* SlaveImuDeltaTheta */
  {0x81, 0x4081, 8, CANHIL_GROUP_SLAVE_IMU, 34, 4, 4}, /* SlaveImuDeltaV */
  {0x82, 0x4082, 8, CANHIL_GROUP_SLAVE_IMU, 38, 3, 8}, /* SlaveImuStatus */
  {0xA0, 0x40A0, 8, CANHIL_GROUP_SYNC, 41, 3, 0}, /* Sync */
  {0xC0, 0x40C0, 8, CANHIL_GROUP_ALIGN_NAV, 44, 4, 0}, /* AlignAttitude */
  {0xC1, 0x40C1, 8, CANHIL_GROUP_ALIGN_NAV, 48, 3, 4}, /* AlignVelocityNE */
  {0xC2, 0x40C2, 8, CANHIL_GROUP_ALIGN_NAV, 51, 2, 7}, /* AlignVelocityD */
  {0xC4, 0x40C4, 8, CANHIL_GROUP_FIX_NAV, 53, 4, 0}, /* FixAttitude */
  {0xC5, 0x40C5, 8, CANHIL_GROUP_FIX_NAV, 57, 3, 4}, /* FixVelocityNE */
  {0xC6, 0x40C6, 8, CANHIL_GROUP_FIX_NAV, 60, 2, 7}, /* FixVelocityD */
  {0xE0, 0x40E0, 8, CANHIL_GROUP_FINS, 62, 4, 0}, /* FinDeflections */
  {0x100, 0x4100, 8, CANHIL_GROUP_GLIDER_NAV, 66, 3, 0}, /* GliderNavVelocityNE */
  {0x101, 0x4101, 8, CANHIL_GROUP_GLIDER_NAV, 69, 4, 3}, /* GliderNavAttitude */
  {0x102, 0x4102, 8, CANHIL_GROUP_GLIDER_NAV, 73, 3, 7}, /* GliderNavRates */
  {0x103, 0x4103, 8, CANHIL_GROUP_GLIDER_NAV, 76, 2, 10}, /* GliderNavVelocityD */
  {0x110, 0x4110, 8, CANHIL_GROUP_WIND, 78, 4, 0}, /* WindVector */
  {0x111, 0x4111, 8, CANHIL_GROUP_WIND, 82, 14, 4}, /* WindSpeed */
  {0x112, 0x4112, 8, CANHIL_GROUP_WIND, 96, 3, 18}, /* WindSigma */
  {0x113, 0x4113, 8, CANHIL_GROUP_WIND, 99, 3, 21}, /* WindCorrelation */
  {0x114, 0x4114, 8, CANHIL_GROUP_WIND, 102, 4, 24}, /* WindTrackSigma */
  {0x115, 0x4115, 8, CANHIL_GROUP_WIND, 106, 3, 28}, /* WindAirVelocity */
  {0x116, 0x4116, 8, CANHIL_GROUP_WIND, 109, 3, 31}, /* WindAttitude */
  {0x117, 0x4117, 8, CANHIL_GROUP_WIND, 112, 3, 34}, /* WindInnovation */
  {0x118, 0x4118, 8, CANHIL_GROUP_WIND, 115, 3, 37}, /* WindUpdate */
  {0x180, 0x4180, 8, CANHIL_GROUP_MASTER_INS, 118, 3, 0}, /* MasterInsVelocityNE */
  {0x181, 0x4181, 8, CANHIL_GROUP_MASTER_INS, 121, 3, 3}, /* MasterInsAttitude */
  {0x182, 0x4182, 8, CANHIL_GROUP_MASTER_INS, 124, 2, 6}, /* MasterInsLatitude */
  {0x183, 0x4183, 8, CANHIL_GROUP_MASTER_INS, 126, 1, 8}, /* MasterInsLongitude */
  {0x184, 0x4184, 8, CANHIL_GROUP_MASTER_INS, 127, 2, 9}, /* MasterInsVelocityD */
  {0x200, 0x4200, 8, CANHIL_GROUP_ALIGN_FILTER, 129, 3, 0}, /* AlignInnovation */
  {0x201, 0x4201, 8, CANHIL_GROUP_ALIGN_FILTER, 132, 3, 3}, /* AlignAttitudeSigma */
  {0x202, 0x4202, 8, CANHIL_GROUP_ALIGN_FILTER, 135, 3, 6}, /* AlignAttitudeCorrelation */
  {0x203, 0x4203, 8, CANHIL_GROUP_ALIGN_FILTER, 138, 3, 9}, /* AlignVelocitySigma */
  {0x204, 0x4204, 8, CANHIL_GROUP_ALIGN_FILTER, 141, 3, 12}, /* AlignGyroBias */
  {0x205, 0x4205, 8, CANHIL_GROUP_ALIGN_FILTER, 144, 3, 15}, /* AlignGyroBiasSigma */
  {0x206, 0x4206, 8, CANHIL_GROUP_ALIGN_FILTER, 147, 3, 18}, /* AlignAccelBias */
  {0x207, 0x4207, 8, CANHIL_GROUP_ALIGN_FILTER, 150, 3, 21}, /* AlignAccelBiasSigma */
  {0x208, 0x4208, 8, CANHIL_GROUP_ALIGN_FILTER, 153, 3, 24}, /* AlignUpdate */
  {0x300, 0x4300, 8, CANHIL_GROUP_TARGET_HEARTBEAT, 156, 12, 0}, /* TargetHeartbeat */
  {0x301, 0x4301, 8, CANHIL_GROUP_TARGET_TIMING, 168, 4, 0}, /* TargetTiming */
  {0x302, 0x4302, 8, CANHIL_GROUP_TARGET_COUNTERS, 172, 4, 0}, /* TargetCounters */
  {0x380, 0x4380, 8, CANHIL_GROUP_SSBL, 176, 3, 0}, /* SsblRelativeNE */
  {0x381, 0x4381, 8, CANHIL_GROUP_SSBL, 179, 2, 3}, /* SsblShipLatitude */
  {0x382, 0x4382, 8, CANHIL_GROUP_SSBL, 181, 2, 5}, /* SsblShipLongitude */
  {0x383, 0x4383, 8, CANHIL_GROUP_SSBL, 183, 2, 7}, /* SsblRelativeD */
  {0x390, 0x4390, 8, CANHIL_GROUP_GPS, 185, 2, 0}, /* GpsLatitude */
  {0x391, 0x4391, 8, CANHIL_GROUP_GPS, 187, 3, 2}, /* GpsLongitude */
  {0x392, 0x4392, 8, CANHIL_GROUP_GPS, 190, 3, 5}, /* GpsTime */
  {0x3C0, 0x43C0, 8, CANHIL_GROUP_FIX_FILTER, 193, 3, 0}, /* FixInnovation */
  {0x3C1, 0x43C1, 8, CANHIL_GROUP_FIX_FILTER, 196, 2, 3}, /* FixPositionLatitude */
  {0x3C2, 0x43C2, 8, CANHIL_GROUP_FIX_FILTER, 198, 1, 5}, /* FixPositionLongitude */
  {0x3C3, 0x43C3, 8, CANHIL_GROUP_FIX_FILTER, 199, 3, 6}, /* FixAttitudeSigma */
  {0x3C4, 0x43C4, 8, CANHIL_GROUP_FIX_FILTER, 202, 3, 9}, /* FixVelocitySigma */
  {0x3C5, 0x43C5, 8, CANHIL_GROUP_FIX_FILTER, 205, 3, 12}, /* FixPositionSigma */
  {0x3C6, 0x43C6, 8, CANHIL_GROUP_FIX_FILTER, 208, 3, 15}, /* FixGyroBias */
  {0x3C7, 0x43C7, 8, CANHIL_GROUP_FIX_FILTER, 211, 3, 18}, /* FixGyroBiasSigma */
  {0x3C8, 0x43C8, 8, CANHIL_GROUP_FIX_FILTER, 214, 3, 21}, /* FixAccelBias */
  {0x3C9, 0x43C9, 8, CANHIL_GROUP_FIX_FILTER, 217, 3, 24}, /* FixAccelBiasSigma */
  {0x3CA, 0x43CA, 8, CANHIL_GROUP_FIX_FILTER, 220, 3, 27}, /* FixBias */
  {0x3CB, 0x43CB, 8, CANHIL_GROUP_FIX_FILTER, 223, 3, 30}, /* FixBiasSigma */
  {0x3CC, 0x43CC, 8, CANHIL_GROUP_FIX_FILTER, 226, 6, 33}, /* FixStatus */
  {0x3CD, 0x43CD, 8, CANHIL_GROUP_FIX_FILTER, 232, 3, 39}, /* FixUpdate */
  {0x600, 0x4600, 8, CANHIL_GROUP_TARGET_COMMAND, 235, 4, 0}, /* TargetCommand */
  {0x601, 0x4601, 8, CANHIL_GROUP_PARAM_SET, 239, 2, 0}, /* ParamSet */
  {0x602, 0x4602, 8, CANHIL_GROUP_PARAM_ACK, 241, 3, 0}, /* ParamAck */
  {0x603, 0x4603, 8, CANHIL_GROUP_STEP_DONE, 244, 1, 0}, /* StepDone */
  {0x608, 0x4608, 8, CANHIL_GROUP_TARGET_INIT_AIR, 245, 3, 0}, /* TargetInitRate */
  {0x609, 0x4609, 8, CANHIL_GROUP_TARGET_INIT_AIR, 248, 3, 3}, /* TargetInitAirVelocity */
  {0x610, 0x4610, 8, CANHIL_GROUP_TARGET_INIT, 251, 2, 0}, /* TargetInitLatitude */
  {0x611, 0x4611, 8, CANHIL_GROUP_TARGET_INIT, 253, 2, 2}, /* TargetInitLongitude */
  {0x612, 0x4612, 8, CANHIL_GROUP_TARGET_INIT, 255, 2, 4}, /* TargetInitVelocityNE */
  {0x613, 0x4613, 8, CANHIL_GROUP_TARGET_INIT, 257, 3, 6}, /* TargetInitAttitude */
  {0x614, 0x4614, 8, CANHIL_GROUP_TARGET_INIT, 260, 3, 9}, /* TargetInitSigma */
  {0x615, 0x4615, 8, CANHIL_GROUP_TARGET_INIT, 263, 2, 12}, /* TargetInitVelocityD */
};

/* time, cause_time, cause_counter: their place among the values; -1: the group has none. */
typedef struct { unsigned char first_message, messages, values, from_target; signed char time, cause_time, cause_counter; } canhil_group;
static const canhil_group canhil_groups[] = {
  {0, 4, 16, 0, 14, -1, -1}, /* Seeker */
  {4, 3, 14, 1, -1, 13, 2}, /* LosRate */
  {7, 3, 11, 0, 8, -1, -1}, /* SlaveImu */
  {10, 1, 3, 0, -1, -1, -1}, /* Sync */
  {11, 3, 9, 1, -1, 8, 6}, /* AlignNav */
  {14, 3, 9, 1, -1, 8, 6}, /* FixNav */
  {17, 1, 4, 0, 3, -1, -1}, /* Fins */
  {18, 4, 12, 0, 11, -1, -1}, /* GliderNav */
  {22, 9, 40, 1, -1, 37, 38}, /* Wind */
  {31, 5, 11, 0, 10, -1, -1}, /* MasterIns */
  {36, 9, 27, 1, -1, 24, 25}, /* AlignFilter */
  {45, 1, 12, 1, -1, -1, -1}, /* TargetHeartbeat */
  {46, 1, 4, 1, -1, -1, -1}, /* TargetTiming */
  {47, 1, 4, 1, -1, -1, -1}, /* TargetCounters */
  {48, 4, 9, 0, 8, -1, -1}, /* Ssbl */
  {52, 3, 8, 0, 7, -1, -1}, /* Gps */
  {55, 14, 42, 1, -1, 39, 40}, /* FixFilter */
  {69, 1, 4, 0, -1, -1, -1}, /* TargetCommand */
  {70, 1, 2, 0, -1, -1, -1}, /* ParamSet */
  {71, 1, 3, 1, -1, -1, -1}, /* ParamAck */
  {72, 1, 1, 1, -1, -1, -1}, /* StepDone */
  {73, 2, 6, 0, -1, -1, -1}, /* TargetInitAir */
  {75, 6, 14, 0, 13, -1, -1}, /* TargetInit */
};
#endif

#endif
