"""Made by dbcgen --python from canhil.dbc: edit canhil.dbc instead."""

# estimator: the hash of the messages that its runs exchange
HASH24 = {
    "none": 0x91A9CA,
    "transfer_alignment": 0xEC38AD,
    "inflight_alignment": 0x3993ED,
    "los_rate": 0x695B46,
    "wind": 0xEB5C2D,
}

# name: {value: name}
VALUE_TABLES = {
    "TargetState": {0: "idle", 1: "ready", 2: "running", 3: "fault", },
    "Estimator": {0: "none", 1: "transfer_alignment", 2: "inflight_alignment", 3: "los_rate", 4: "wind", },
    "Algorithm": {0: "kalman", 1: "robust_h2", 2: "ekf", 3: "ukf", 4: "sin_cos", 8: "switched_table", 9: "combined", 10: "low_pass", 11: "h_infinity", 12: "adaptive_q", },
    "Command": {0: "none", 1: "reset", 2: "start", 3: "stop", 4: "add", },
    "ParameterStatus": {0: "accepted", 1: "unknown", 2: "out_of_range", 3: "wrong_state", },
    "Validity": {0: "invalid", 1: "valid", },
    "LosRateOutcome": {0: "waiting", 1: "started", 2: "updated", 3: "start_up", 4: "coasting", 5: "bad_step", 6: "non_finite", },
    "LosRateFault": {0: "none", 1: "error_angle", 2: "field_of_view", 3: "antenna", 4: "acceleration", 5: "range_invalid", 6: "range_stale", 7: "range_jump", 8: "closing_speed_invalid", },
    "WindOutcome": {0: "waiting", 1: "started", 2: "updated", 3: "coasting", 4: "out_of_order", 5: "non_finite", 6: "future", },
    "WindFault": {0: "none", 1: "invalid", 2: "not_finite", 3: "not_physical", 4: "pitch", 5: "stale", 6: "jump", },
    "FixOutcome": {0: "accepted", 1: "recovered", 2: "gated", 3: "late", 4: "future", 5: "out_of_order", 6: "wrong_source", 7: "invalid", 8: "before_start", 9: "numeric", 10: "predicted", },
    "FixSource": {0: "ssbl", 1: "gps", 2: "imu", },
    "Parameter": {0: "accel_bias_sigma_ug", 1: "gyro_bias_sigma_degph", 2: "accel_noise_ugprthz", 3: "gyro_noise_degprth", 4: "velocity_noise_m2ps", 5: "h2_case", 6: "h2_alpha_rule", 7: "h2_alpha_mps2", 8: "fading_per_s", 9: "mechanization", 10: "closed_loop", 11: "output_interval_ms", 12: "aiding", 13: "attitude_error_frame", 14: "ukf_root", 15: "ukf_covariance", 16: "fix_noise_horizontal_m", 17: "fix_noise_vertical_m", 18: "fix_bias_sigma_m", 19: "fix_bias_walk_mprts", 20: "initial_height_sigma_m", 21: "handover_sigma_deg", 22: "gate_nis", 23: "gate_recovery", 24: "late_fixes", 25: "fix_correlated_percent", 26: "fix_correlation_s", 40: "accel_scale_factor_sigma_ppm", 41: "accel_misalignment_sigma_mrad", 42: "gyro_scale_factor_sigma_ppm", 43: "gyro_misalignment_sigma_mrad", 44: "lever_arm_sigma_m", 45: "velocity_correlated_mps", 46: "velocity_correlation_s", 64: "jerk_density_m2ps5", 65: "thermal_noise_pitch_radpm2", 66: "thermal_noise_yaw_radpm2", 67: "glint_noise_pitch_m", 68: "glint_noise_yaw_m", 69: "constant_noise_pitch_rad", 70: "constant_noise_yaw_rad", 71: "sample_period_ms", 72: "los_rate_sigma_radps", 73: "target_acceleration_sigma_mps2", 74: "start_up_s", 75: "gap_limit_ms", 76: "low_pass_bandwidth_radps", 77: "low_pass_damping", 78: "range_max_m", 79: "closing_speed_max_mps", 80: "blind_range_m", 81: "range_sigma_m", 82: "range_gate_m", 83: "closing_speed_gate_mps", 84: "relock_samples", 85: "range_unchanged_limit_ms", 86: "field_of_view_rad", 87: "antenna_rate_sigma_radps", 88: "missile_acceleration_sigma_mps2", 89: "antenna_rate_bias_sigma_radps", 128: "process_noise", 129: "air_velocity_noise_mpsprts", 130: "body_rate_noise_degpsprts", 131: "attitude_noise_degprts", 132: "wind_noise_mpsprts", 133: "glider_velocity_sigma_mps", 134: "glider_rate_sigma_degps", 135: "glider_attitude_sigma_deg", 136: "theta_per_s", 137: "theta_cap_per_s", 138: "theta_rate_weight", 139: "adaptation_time_s", 140: "adaptation_limit", 141: "initial_air_velocity_sigma_mps", 142: "initial_rate_sigma_degps", 143: "initial_wind_sigma_mps", 144: "fins_late_ms", 145: "fins_missing_ms", 146: "glider_nav_coast_s", 147: "glider_nav_stale_ms", 148: "glider_nav_gate_mps", 149: "coefficient_sigma_percent", 150: "nav_velocity_bias_sigma_mps", 151: "nav_attitude_bias_sigma_deg", },
}

# Sample groups; a message without a group forms a group by itself. Messages in the order of transmission: (name, id, data id, size,
# signals), a signal: (name, start bit, length, kind, scale, offset, lowest raw value, highest, value table or None).
GROUPS = {
    "Seeker": (
        ("SeekerAntenna", 0x70, 0x4070, 8, (
            ("antenna_increment_roll_rad", 12, 17, "signed", 1e-06, 0.0, -65500.0, 65500.0, None),
            ("antenna_increment_pitch_rad", 29, 17, "signed", 1e-06, 0.0, -65500.0, 65500.0, None),
            ("antenna_increment_yaw_rad", 46, 17, "signed", 1e-06, 0.0, -65500.0, 65500.0, None),
            ("antenna_validity", 63, 1, "unsigned", 1.0, 0.0, 0.0, 1.0, "Validity"),
        )),
        ("SeekerAngles", 0x71, 0x4071, 8, (
            ("error_pitch_rad", 12, 16, "signed", 2e-05, 0.0, -32750.0, 32750.0, None),
            ("error_yaw_rad", 28, 16, "signed", 2e-05, 0.0, -32750.0, 32750.0, None),
            ("interval_us", 44, 12, "unsigned", 10.0, 0.0, 0.0, 4095.0, None),
            ("error_validity", 56, 1, "unsigned", 1.0, 0.0, 0.0, 1.0, "Validity"),
        )),
        ("SeekerMotion", 0x72, 0x4072, 8, (
            ("missile_acceleration_y_mps2", 12, 16, "signed", 0.02, 0.0, -32750.0, 32750.0, None),
            ("missile_acceleration_z_mps2", 28, 16, "signed", 0.02, 0.0, -32750.0, 32750.0, None),
            ("closing_speed_mps", 44, 14, "signed", 0.5, 0.0, -8190.0, 8190.0, None),
            ("acceleration_validity", 58, 1, "unsigned", 1.0, 0.0, 0.0, 1.0, "Validity"),
            ("closing_speed_validity", 59, 1, "unsigned", 1.0, 0.0, 0.0, 1.0, "Validity"),
        )),
        ("SeekerRange", 0x73, 0x4073, 8, (
            ("range_m", 12, 19, "signed", 0.1, 0.0, -262140.0, 262140.0, None),
            ("time_of_validity_us", 31, 32, "unsigned", 1.0, 0.0, 0.0, 4294967295.0, None),
            ("range_validity", 63, 1, "unsigned", 1.0, 0.0, 0.0, 1.0, "Validity"),
        )),
    ),
    "LosRate": (
        ("LosRateEstimate", 0x78, 0x4078, 8, (
            ("los_rate_pitch_radps", 12, 20, "signed", 1e-05, 0.0, -524000.0, 524000.0, None),
            ("los_rate_yaw_radps", 32, 20, "signed", 1e-05, 0.0, -524000.0, 524000.0, None),
            ("cause_counter", 52, 4, "unsigned", 1.0, 0.0, 0.0, 14.0, None),
            ("outcome", 56, 3, "unsigned", 1.0, 0.0, 0.0, 7.0, "LosRateOutcome"),
            ("fault", 59, 4, "unsigned", 1.0, 0.0, 0.0, 15.0, "LosRateFault"),
            ("blind", 63, 1, "unsigned", 1.0, 0.0, 0.0, 1.0, None),
        )),
        ("LosRateSigma", 0x79, 0x4079, 8, (
            ("los_rate_sigma_pitch_radps", 12, 14, "unsigned", 2e-05, 0.0, 0.0, 16350.0, None),
            ("los_rate_sigma_yaw_radps", 26, 14, "unsigned", 2e-05, 0.0, 0.0, 16350.0, None),
            ("target_acceleration_sigma_y_mps2", 40, 6, "unsigned", 2.5, 0.0, 0.0, 63.0, None),
            ("target_acceleration_sigma_z_mps2", 46, 6, "unsigned", 2.5, 0.0, 0.0, 63.0, None),
            ("nis", 52, 11, "unsigned", 0.1, 0.0, 0.0, 2047.0, None),
            ("degraded", 63, 1, "unsigned", 1.0, 0.0, 0.0, 1.0, None),
        )),
        ("LosRateTarget", 0x7A, 0x407A, 8, (
            ("target_acceleration_y_mps2", 12, 10, "signed", 0.5, 0.0, -510.0, 510.0, None),
            ("target_acceleration_z_mps2", 22, 10, "signed", 0.5, 0.0, -510.0, 510.0, None),
            ("cause_time_us", 32, 32, "unsigned", 1.0, 0.0, 0.0, 4294967295.0, None),
        )),
    ),
    "SlaveImu": (
        ("SlaveImuDeltaTheta", 0x80, 0x4080, 8, (
            ("delta_theta_x_rad", 12, 17, "signed", 2e-06, 0.0, -65500.0, 65500.0, None),
            ("delta_theta_y_rad", 29, 17, "signed", 2e-06, 0.0, -65500.0, 65500.0, None),
            ("delta_theta_z_rad", 46, 17, "signed", 2e-06, 0.0, -65500.0, 65500.0, None),
            ("gyro_validity", 63, 1, "unsigned", 1.0, 0.0, 0.0, 1.0, "Validity"),
        )),
        ("SlaveImuDeltaV", 0x81, 0x4081, 8, (
            ("delta_v_x_mps", 12, 17, "signed", 2e-05, 0.0, -65500.0, 65500.0, None),
            ("delta_v_y_mps", 29, 17, "signed", 2e-05, 0.0, -65500.0, 65500.0, None),
            ("delta_v_z_mps", 46, 17, "signed", 2e-05, 0.0, -65500.0, 65500.0, None),
            ("accel_validity", 63, 1, "unsigned", 1.0, 0.0, 0.0, 1.0, "Validity"),
        )),
        ("SlaveImuStatus", 0x82, 0x4082, 8, (
            ("time_of_validity_us", 12, 32, "unsigned", 1.0, 0.0, 0.0, 4294967295.0, None),
            ("interval_us", 44, 12, "unsigned", 10.0, 0.0, 0.0, 4095.0, None),
            ("temperature_degc", 56, 8, "signed", 1.0, 0.0, -128.0, 127.0, None),
        )),
    ),
    "Sync": (
        ("Sync", 0xA0, 0x40A0, 8, (
            ("time_us", 12, 40, "unsigned", 1.0, 0.0, 0.0, 1099511627775.0, None),
            ("step", 52, 11, "unsigned", 1.0, 0.0, 0.0, 2047.0, None),
            ("lockstep", 63, 1, "unsigned", 1.0, 0.0, 0.0, 1.0, None),
        )),
    ),
    "AlignNav": (
        ("AlignAttitude", 0xC0, 0x40C0, 8, (
            ("roll_deg", 12, 17, "signed", 0.003, 0.0, -60000.0, 60000.0, None),
            ("pitch_deg", 29, 17, "signed", 0.003, 0.0, -60000.0, 60000.0, None),
            ("heading_deg", 46, 17, "signed", 0.003, 0.0, -60000.0, 60000.0, None),
            ("coasting", 63, 1, "unsigned", 1.0, 0.0, 0.0, 1.0, None),
        )),
        ("AlignVelocityNE", 0xC1, 0x40C1, 8, (
            ("velocity_north_mps", 12, 24, "signed", 0.0002, 0.0, -8385000.0, 8385000.0, None),
            ("velocity_east_mps", 36, 24, "signed", 0.0002, 0.0, -8385000.0, 8385000.0, None),
            ("cause_counter", 60, 4, "unsigned", 1.0, 0.0, 0.0, 14.0, None),
        )),
        ("AlignVelocityD", 0xC2, 0x40C2, 8, (
            ("velocity_down_mps", 12, 20, "signed", 0.002, 0.0, -524000.0, 524000.0, None),
            ("cause_time_us", 32, 32, "unsigned", 1.0, 0.0, 0.0, 4294967295.0, None),
        )),
    ),
    "FixNav": (
        ("FixAttitude", 0xC4, 0x40C4, 8, (
            ("roll_deg", 12, 17, "signed", 0.003, 0.0, -60000.0, 60000.0, None),
            ("pitch_deg", 29, 17, "signed", 0.003, 0.0, -60000.0, 60000.0, None),
            ("heading_deg", 46, 17, "signed", 0.003, 0.0, -60000.0, 60000.0, None),
            ("coasting", 63, 1, "unsigned", 1.0, 0.0, 0.0, 1.0, None),
        )),
        ("FixVelocityNE", 0xC5, 0x40C5, 8, (
            ("velocity_north_mps", 12, 24, "signed", 0.0002, 0.0, -8385000.0, 8385000.0, None),
            ("velocity_east_mps", 36, 24, "signed", 0.0002, 0.0, -8385000.0, 8385000.0, None),
            ("cause_counter", 60, 4, "unsigned", 1.0, 0.0, 0.0, 14.0, None),
        )),
        ("FixVelocityD", 0xC6, 0x40C6, 8, (
            ("velocity_down_mps", 12, 20, "signed", 0.002, 0.0, -524000.0, 524000.0, None),
            ("cause_time_us", 32, 32, "unsigned", 1.0, 0.0, 0.0, 4294967295.0, None),
        )),
    ),
    "Fins": (
        ("FinDeflections", 0xE0, 0x40E0, 8, (
            ("elevator_deg", 12, 12, "signed", 0.02, 0.0, -2047.0, 2047.0, None),
            ("aileron_deg", 24, 12, "signed", 0.02, 0.0, -2047.0, 2047.0, None),
            ("rudder_deg", 36, 12, "signed", 0.02, 0.0, -2047.0, 2047.0, None),
            ("time_of_validity_us", 48, 16, "unsigned", 10.0, 0.0, 0.0, 65535.0, None),
        )),
    ),
    "GliderNav": (
        ("GliderNavVelocityNE", 0x100, 0x4100, 8, (
            ("velocity_north_mps", 12, 16, "signed", 0.02, 0.0, -32767.0, 32767.0, None),
            ("velocity_east_mps", 28, 16, "signed", 0.02, 0.0, -32767.0, 32767.0, None),
            ("height_m", 44, 20, "unsigned", 0.1, -10000.0, 0.0, 1048575.0, None),
        )),
        ("GliderNavAttitude", 0x101, 0x4101, 8, (
            ("roll_deg", 12, 17, "signed", 0.003, 0.0, -60000.0, 60000.0, None),
            ("pitch_deg", 29, 17, "signed", 0.003, 0.0, -60000.0, 60000.0, None),
            ("heading_deg", 46, 17, "signed", 0.003, 0.0, -60000.0, 60000.0, None),
            ("navigation_validity", 63, 1, "unsigned", 1.0, 0.0, 0.0, 1.0, "Validity"),
        )),
        ("GliderNavRates", 0x102, 0x4102, 8, (
            ("rate_x_degps", 12, 17, "signed", 0.005, 0.0, -65535.0, 65535.0, None),
            ("rate_y_degps", 29, 17, "signed", 0.005, 0.0, -65535.0, 65535.0, None),
            ("rate_z_degps", 46, 17, "signed", 0.005, 0.0, -65535.0, 65535.0, None),
        )),
        ("GliderNavVelocityD", 0x103, 0x4103, 8, (
            ("velocity_down_mps", 12, 20, "signed", 0.002, 0.0, -524000.0, 524000.0, None),
            ("time_of_validity_us", 32, 32, "unsigned", 1.0, 0.0, 0.0, 4294967295.0, None),
        )),
    ),
    "Wind": (
        ("WindVector", 0x110, 0x4110, 8, (
            ("wind_north_mps", 12, 17, "signed", 0.003, 0.0, -65533.0, 65533.0, None),
            ("wind_east_mps", 29, 17, "signed", 0.003, 0.0, -65533.0, 65533.0, None),
            ("wind_down_mps", 46, 17, "signed", 0.003, 0.0, -65533.0, 65533.0, None),
            ("started", 63, 1, "unsigned", 1.0, 0.0, 0.0, 1.0, None),
        )),
        ("WindSpeed", 0x111, 0x4111, 8, (
            ("wind_speed_mps", 12, 16, "unsigned", 0.005, 0.0, 0.0, 65535.0, None),
            ("wind_from_deg", 28, 16, "unsigned", 0.01, 0.0, 0.0, 36000.0, None),
            ("outcome", 44, 3, "unsigned", 1.0, 0.0, 0.0, 7.0, "WindOutcome"),
            ("fault", 47, 3, "unsigned", 1.0, 0.0, 0.0, 7.0, "WindFault"),
            ("outside_alpha", 50, 1, "unsigned", 1.0, 0.0, 0.0, 1.0, None),
            ("outside_beta", 51, 1, "unsigned", 1.0, 0.0, 0.0, 1.0, None),
            ("outside_speed", 52, 1, "unsigned", 1.0, 0.0, 0.0, 1.0, None),
            ("outside_mach", 53, 1, "unsigned", 1.0, 0.0, 0.0, 1.0, None),
            ("outside_altitude", 54, 1, "unsigned", 1.0, 0.0, 0.0, 1.0, None),
            ("outside_pitch", 55, 1, "unsigned", 1.0, 0.0, 0.0, 1.0, None),
            ("fins_late", 56, 1, "unsigned", 1.0, 0.0, 0.0, 1.0, None),
            ("fins_missing", 57, 1, "unsigned", 1.0, 0.0, 0.0, 1.0, None),
            ("fins_not_physical", 58, 1, "unsigned", 1.0, 0.0, 0.0, 1.0, None),
            ("theta_capped", 59, 1, "unsigned", 1.0, 0.0, 0.0, 1.0, None),
            ("degraded", 60, 1, "unsigned", 1.0, 0.0, 0.0, 1.0, None),
        )),
        ("WindSigma", 0x112, 0x4112, 8, (
            ("wind_sigma_north_mps", 12, 17, "unsigned", 0.001, 0.0, 0.0, 131000.0, None),
            ("wind_sigma_east_mps", 29, 17, "unsigned", 0.001, 0.0, 0.0, 131000.0, None),
            ("wind_sigma_down_mps", 46, 17, "unsigned", 0.001, 0.0, 0.0, 131000.0, None),
        )),
        ("WindCorrelation", 0x113, 0x4113, 8, (
            ("wind_correlation_ne", 12, 17, "signed", 2e-05, 0.0, -50000.0, 50000.0, None),
            ("wind_correlation_nd", 29, 17, "signed", 2e-05, 0.0, -50000.0, 50000.0, None),
            ("wind_correlation_ed", 46, 17, "signed", 2e-05, 0.0, -50000.0, 50000.0, None),
        )),
        ("WindTrackSigma", 0x114, 0x4114, 8, (
            ("along_track_sigma_mps", 12, 13, "unsigned", 0.005, 0.0, 0.0, 8191.0, None),
            ("cross_track_sigma_mps", 25, 13, "unsigned", 0.005, 0.0, 0.0, 8191.0, None),
            ("wind_speed_sigma_mps", 38, 13, "unsigned", 0.005, 0.0, 0.0, 8191.0, None),
            ("wind_from_sigma_deg", 51, 13, "unsigned", 0.02, 0.0, 0.0, 8191.0, None),
        )),
        ("WindAirVelocity", 0x115, 0x4115, 8, (
            ("air_velocity_x_mps", 12, 17, "signed", 0.01, 0.0, -65535.0, 65535.0, None),
            ("air_velocity_y_mps", 29, 17, "signed", 0.01, 0.0, -65535.0, 65535.0, None),
            ("air_velocity_z_mps", 46, 17, "signed", 0.01, 0.0, -65535.0, 65535.0, None),
        )),
        ("WindAttitude", 0x116, 0x4116, 8, (
            ("roll_deg", 12, 17, "signed", 0.003, 0.0, -60000.0, 60000.0, None),
            ("pitch_deg", 29, 17, "signed", 0.003, 0.0, -60000.0, 60000.0, None),
            ("heading_deg", 46, 17, "signed", 0.003, 0.0, -60000.0, 60000.0, None),
        )),
        ("WindInnovation", 0x117, 0x4117, 8, (
            ("innovation_north_mps", 12, 17, "signed", 0.003, 0.0, -65533.0, 65533.0, None),
            ("innovation_east_mps", 29, 17, "signed", 0.003, 0.0, -65533.0, 65533.0, None),
            ("innovation_down_mps", 46, 17, "signed", 0.003, 0.0, -65533.0, 65533.0, None),
        )),
        ("WindUpdate", 0x118, 0x4118, 8, (
            ("cause_time_us", 12, 32, "unsigned", 1.0, 0.0, 0.0, 4294967295.0, None),
            ("cause_counter", 44, 4, "unsigned", 1.0, 0.0, 0.0, 14.0, None),
            ("nis", 48, 16, "unsigned", 0.05, 0.0, 0.0, 65535.0, None),
        )),
    ),
    "MasterIns": (
        ("MasterInsVelocityNE", 0x180, 0x4180, 8, (
            ("velocity_north_mps", 12, 24, "signed", 0.0002, 0.0, -8385000.0, 8385000.0, None),
            ("velocity_east_mps", 36, 24, "signed", 0.0002, 0.0, -8385000.0, 8385000.0, None),
            ("velocity_validity", 60, 1, "unsigned", 1.0, 0.0, 0.0, 1.0, "Validity"),
        )),
        ("MasterInsAttitude", 0x181, 0x4181, 8, (
            ("roll_deg", 12, 17, "signed", 0.003, 0.0, -60000.0, 60000.0, None),
            ("pitch_deg", 29, 17, "signed", 0.003, 0.0, -60000.0, 60000.0, None),
            ("heading_deg", 46, 17, "signed", 0.003, 0.0, -60000.0, 60000.0, None),
        )),
        ("MasterInsLatitude", 0x182, 0x4182, 8, (
            ("latitude_deg", 12, 32, "signed", 1e-07, 0.0, -900000000.0, 900000000.0, None),
            ("height_m", 44, 20, "unsigned", 0.1, -10000.0, 0.0, 1048575.0, None),
        )),
        ("MasterInsLongitude", 0x183, 0x4183, 8, (
            ("longitude_deg", 12, 32, "signed", 1e-07, 0.0, -1800000001.0, 1800000001.0, None),
        )),
        ("MasterInsVelocityD", 0x184, 0x4184, 8, (
            ("velocity_down_mps", 12, 20, "signed", 0.002, 0.0, -524000.0, 524000.0, None),
            ("time_of_validity_us", 32, 32, "unsigned", 1.0, 0.0, 0.0, 4294967295.0, None),
        )),
    ),
    "AlignFilter": (
        ("AlignInnovation", 0x200, 0x4200, 8, (
            ("innovation_north_mps", 12, 17, "signed", 0.001, 0.0, -65500.0, 65500.0, None),
            ("innovation_east_mps", 29, 17, "signed", 0.001, 0.0, -65500.0, 65500.0, None),
            ("innovation_down_mps", 46, 17, "signed", 0.001, 0.0, -65500.0, 65500.0, None),
        )),
        ("AlignAttitudeSigma", 0x201, 0x4201, 8, (
            ("attitude_sigma_north_rad", 12, 17, "unsigned", 1e-05, 0.0, 0.0, 131000.0, None),
            ("attitude_sigma_east_rad", 29, 17, "unsigned", 1e-05, 0.0, 0.0, 131000.0, None),
            ("attitude_sigma_down_rad", 46, 17, "unsigned", 1e-05, 0.0, 0.0, 131000.0, None),
        )),
        ("AlignAttitudeCorrelation", 0x202, 0x4202, 8, (
            ("attitude_correlation_ne", 12, 17, "signed", 2e-05, 0.0, -50000.0, 50000.0, None),
            ("attitude_correlation_nd", 29, 17, "signed", 2e-05, 0.0, -50000.0, 50000.0, None),
            ("attitude_correlation_ed", 46, 17, "signed", 2e-05, 0.0, -50000.0, 50000.0, None),
        )),
        ("AlignVelocitySigma", 0x203, 0x4203, 8, (
            ("velocity_sigma_north_mps", 12, 17, "unsigned", 0.0001, 0.0, 0.0, 131000.0, None),
            ("velocity_sigma_east_mps", 29, 17, "unsigned", 0.0001, 0.0, 0.0, 131000.0, None),
            ("velocity_sigma_down_mps", 46, 17, "unsigned", 0.0001, 0.0, 0.0, 131000.0, None),
            ("degraded", 63, 1, "unsigned", 1.0, 0.0, 0.0, 1.0, None),
        )),
        ("AlignGyroBias", 0x204, 0x4204, 8, (
            ("gyro_bias_x_degph", 12, 17, "signed", 0.002, 0.0, -65500.0, 65500.0, None),
            ("gyro_bias_y_degph", 29, 17, "signed", 0.002, 0.0, -65500.0, 65500.0, None),
            ("gyro_bias_z_degph", 46, 17, "signed", 0.002, 0.0, -65500.0, 65500.0, None),
        )),
        ("AlignGyroBiasSigma", 0x205, 0x4205, 8, (
            ("gyro_bias_sigma_x_degph", 12, 17, "unsigned", 0.001, 0.0, 0.0, 131000.0, None),
            ("gyro_bias_sigma_y_degph", 29, 17, "unsigned", 0.001, 0.0, 0.0, 131000.0, None),
            ("gyro_bias_sigma_z_degph", 46, 17, "unsigned", 0.001, 0.0, 0.0, 131000.0, None),
        )),
        ("AlignAccelBias", 0x206, 0x4206, 8, (
            ("accel_bias_x_ug", 12, 17, "signed", 0.5, 0.0, -65534.0, 65534.0, None),
            ("accel_bias_y_ug", 29, 17, "signed", 0.5, 0.0, -65534.0, 65534.0, None),
            ("accel_bias_z_ug", 46, 17, "signed", 0.5, 0.0, -65534.0, 65534.0, None),
        )),
        ("AlignAccelBiasSigma", 0x207, 0x4207, 8, (
            ("accel_bias_sigma_x_ug", 12, 17, "unsigned", 0.5, 0.0, 0.0, 131070.0, None),
            ("accel_bias_sigma_y_ug", 29, 17, "unsigned", 0.5, 0.0, 0.0, 131070.0, None),
            ("accel_bias_sigma_z_ug", 46, 17, "unsigned", 0.5, 0.0, 0.0, 131070.0, None),
        )),
        ("AlignUpdate", 0x208, 0x4208, 8, (
            ("cause_time_us", 12, 32, "unsigned", 1.0, 0.0, 0.0, 4294967295.0, None),
            ("cause_counter", 44, 4, "unsigned", 1.0, 0.0, 0.0, 14.0, None),
            ("nis", 48, 16, "unsigned", 0.01, 0.0, 0.0, 65535.0, None),
        )),
    ),
    "TargetHeartbeat": (
        ("TargetHeartbeat", 0x300, 0x4300, 8, (
            ("state", 12, 3, "unsigned", 1.0, 0.0, 0.0, 7.0, "TargetState"),
            ("estimator", 15, 3, "unsigned", 1.0, 0.0, 0.0, 7.0, "Estimator"),
            ("algorithm", 18, 5, "unsigned", 1.0, 0.0, 0.0, 31.0, "Algorithm"),
            ("dbc_hash", 23, 24, "unsigned", 1.0, 0.0, 0.0, 16777215.0, None),
            ("version_major", 47, 4, "unsigned", 1.0, 0.0, 0.0, 15.0, None),
            ("version_minor", 51, 4, "unsigned", 1.0, 0.0, 0.0, 15.0, None),
            ("error_dbc_mismatch", 55, 1, "unsigned", 1.0, 0.0, 0.0, 1.0, None),
            ("error_not_initialised", 56, 1, "unsigned", 1.0, 0.0, 0.0, 1.0, None),
            ("error_input_lost", 57, 1, "unsigned", 1.0, 0.0, 0.0, 1.0, None),
            ("error_input_silent", 58, 1, "unsigned", 1.0, 0.0, 0.0, 1.0, None),
            ("error_numeric", 59, 1, "unsigned", 1.0, 0.0, 0.0, 1.0, None),
            ("error_command", 60, 1, "unsigned", 1.0, 0.0, 0.0, 1.0, None),
            ("degraded", 61, 1, "unsigned", 1.0, 0.0, 0.0, 1.0, None),
        )),
    ),
    "TargetTiming": (
        ("TargetTiming", 0x301, 0x4301, 8, (
            ("queue_max_us", 12, 13, "unsigned", 1.0, 0.0, 0.0, 8191.0, None),
            ("queue_mean_us", 25, 13, "unsigned", 1.0, 0.0, 0.0, 8191.0, None),
            ("compute_max_us", 38, 13, "unsigned", 1.0, 0.0, 0.0, 8191.0, None),
            ("compute_mean_us", 51, 13, "unsigned", 1.0, 0.0, 0.0, 8191.0, None),
        )),
    ),
    "TargetCounters": (
        ("TargetCounters", 0x302, 0x4302, 8, (
            ("frames_lost", 12, 13, "unsigned", 1.0, 0.0, 0.0, 8191.0, None),
            ("bad_crc", 25, 13, "unsigned", 1.0, 0.0, 0.0, 8191.0, None),
            ("bad_group", 38, 13, "unsigned", 1.0, 0.0, 0.0, 8191.0, None),
            ("late", 51, 13, "unsigned", 1.0, 0.0, 0.0, 8191.0, None),
        )),
    ),
    "Ssbl": (
        ("SsblRelativeNE", 0x380, 0x4380, 8, (
            ("relative_north_m", 12, 24, "signed", 0.01, 0.0, -8388600.0, 8388600.0, None),
            ("relative_east_m", 36, 24, "signed", 0.01, 0.0, -8388600.0, 8388600.0, None),
            ("position_validity", 60, 1, "unsigned", 1.0, 0.0, 0.0, 1.0, "Validity"),
        )),
        ("SsblShipLatitude", 0x381, 0x4381, 8, (
            ("latitude_deg", 12, 32, "signed", 1e-07, 0.0, -900000000.0, 900000000.0, None),
            ("height_m", 44, 20, "unsigned", 0.1, -10000.0, 0.0, 1048575.0, None),
        )),
        ("SsblShipLongitude", 0x382, 0x4382, 8, (
            ("longitude_deg", 12, 32, "signed", 1e-07, 0.0, -1800000001.0, 1800000001.0, None),
            ("relative_sigma_m", 44, 16, "unsigned", 0.01, 0.0, 0.0, 65535.0, None),
        )),
        ("SsblRelativeD", 0x383, 0x4383, 8, (
            ("relative_down_m", 12, 20, "signed", 0.01, 0.0, -524200.0, 524200.0, None),
            ("time_of_validity_us", 32, 32, "unsigned", 1.0, 0.0, 0.0, 4294967295.0, None),
        )),
    ),
    "Gps": (
        ("GpsLatitude", 0x390, 0x4390, 8, (
            ("latitude_deg", 12, 32, "signed", 1e-07, 0.0, -900000000.0, 900000000.0, None),
            ("height_m", 44, 20, "unsigned", 0.1, -10000.0, 0.0, 1048575.0, None),
        )),
        ("GpsLongitude", 0x391, 0x4391, 8, (
            ("longitude_deg", 12, 32, "signed", 1e-07, 0.0, -1800000001.0, 1800000001.0, None),
            ("satellites", 44, 5, "unsigned", 1.0, 0.0, 0.0, 31.0, None),
            ("position_validity", 63, 1, "unsigned", 1.0, 0.0, 0.0, 1.0, "Validity"),
        )),
        ("GpsTime", 0x392, 0x4392, 8, (
            ("horizontal_sigma_m", 12, 10, "unsigned", 0.1, 0.0, 0.0, 1023.0, None),
            ("vertical_sigma_m", 22, 10, "unsigned", 0.1, 0.0, 0.0, 1023.0, None),
            ("time_of_validity_us", 32, 32, "unsigned", 1.0, 0.0, 0.0, 4294967295.0, None),
        )),
    ),
    "FixFilter": (
        ("FixInnovation", 0x3C0, 0x43C0, 8, (
            ("innovation_north_m", 12, 17, "signed", 0.05, 0.0, -65520.0, 65520.0, None),
            ("innovation_east_m", 29, 17, "signed", 0.05, 0.0, -65520.0, 65520.0, None),
            ("innovation_down_m", 46, 17, "signed", 0.05, 0.0, -65520.0, 65520.0, None),
        )),
        ("FixPositionLatitude", 0x3C1, 0x43C1, 8, (
            ("latitude_deg", 12, 32, "signed", 1e-07, 0.0, -900000000.0, 900000000.0, None),
            ("height_m", 44, 20, "unsigned", 0.1, -10000.0, 0.0, 1048575.0, None),
        )),
        ("FixPositionLongitude", 0x3C2, 0x43C2, 8, (
            ("longitude_deg", 12, 32, "signed", 1e-07, 0.0, -1800000001.0, 1800000001.0, None),
        )),
        ("FixAttitudeSigma", 0x3C3, 0x43C3, 8, (
            ("tilt_sigma_north_deg", 12, 17, "unsigned", 0.0005, 0.0, 0.0, 131000.0, None),
            ("tilt_sigma_east_deg", 29, 17, "unsigned", 0.0005, 0.0, 0.0, 131000.0, None),
            ("heading_sigma_deg", 46, 18, "unsigned", 0.001, 0.0, 0.0, 262000.0, None),
        )),
        ("FixVelocitySigma", 0x3C4, 0x43C4, 8, (
            ("velocity_sigma_north_mps", 12, 17, "unsigned", 0.0005, 0.0, 0.0, 131000.0, None),
            ("velocity_sigma_east_mps", 29, 17, "unsigned", 0.0005, 0.0, 0.0, 131000.0, None),
            ("velocity_sigma_down_mps", 46, 17, "unsigned", 0.0005, 0.0, 0.0, 131000.0, None),
        )),
        ("FixPositionSigma", 0x3C5, 0x43C5, 8, (
            ("position_sigma_north_m", 12, 17, "unsigned", 0.02, 0.0, 0.0, 131050.0, None),
            ("position_sigma_east_m", 29, 17, "unsigned", 0.02, 0.0, 0.0, 131050.0, None),
            ("position_sigma_down_m", 46, 17, "unsigned", 0.02, 0.0, 0.0, 131050.0, None),
        )),
        ("FixGyroBias", 0x3C6, 0x43C6, 8, (
            ("gyro_bias_x_degph", 12, 17, "signed", 0.002, 0.0, -65500.0, 65500.0, None),
            ("gyro_bias_y_degph", 29, 17, "signed", 0.002, 0.0, -65500.0, 65500.0, None),
            ("gyro_bias_z_degph", 46, 17, "signed", 0.002, 0.0, -65500.0, 65500.0, None),
        )),
        ("FixGyroBiasSigma", 0x3C7, 0x43C7, 8, (
            ("gyro_bias_sigma_x_degph", 12, 17, "unsigned", 0.001, 0.0, 0.0, 131000.0, None),
            ("gyro_bias_sigma_y_degph", 29, 17, "unsigned", 0.001, 0.0, 0.0, 131000.0, None),
            ("gyro_bias_sigma_z_degph", 46, 17, "unsigned", 0.001, 0.0, 0.0, 131000.0, None),
        )),
        ("FixAccelBias", 0x3C8, 0x43C8, 8, (
            ("accel_bias_x_ug", 12, 17, "signed", 0.5, 0.0, -65534.0, 65534.0, None),
            ("accel_bias_y_ug", 29, 17, "signed", 0.5, 0.0, -65534.0, 65534.0, None),
            ("accel_bias_z_ug", 46, 17, "signed", 0.5, 0.0, -65534.0, 65534.0, None),
        )),
        ("FixAccelBiasSigma", 0x3C9, 0x43C9, 8, (
            ("accel_bias_sigma_x_ug", 12, 17, "unsigned", 0.5, 0.0, 0.0, 131070.0, None),
            ("accel_bias_sigma_y_ug", 29, 17, "unsigned", 0.5, 0.0, 0.0, 131070.0, None),
            ("accel_bias_sigma_z_ug", 46, 17, "unsigned", 0.5, 0.0, 0.0, 131070.0, None),
        )),
        ("FixBias", 0x3CA, 0x43CA, 8, (
            ("fix_bias_north_m", 12, 17, "signed", 0.002, 0.0, -65500.0, 65500.0, None),
            ("fix_bias_east_m", 29, 17, "signed", 0.002, 0.0, -65500.0, 65500.0, None),
            ("fix_bias_down_m", 46, 17, "signed", 0.002, 0.0, -65500.0, 65500.0, None),
        )),
        ("FixBiasSigma", 0x3CB, 0x43CB, 8, (
            ("fix_bias_sigma_north_m", 12, 17, "unsigned", 0.001, 0.0, 0.0, 131000.0, None),
            ("fix_bias_sigma_east_m", 29, 17, "unsigned", 0.001, 0.0, 0.0, 131000.0, None),
            ("fix_bias_sigma_down_m", 46, 17, "unsigned", 0.001, 0.0, 0.0, 131000.0, None),
        )),
        ("FixStatus", 0x3CC, 0x43CC, 8, (
            ("outcome", 12, 4, "unsigned", 1.0, 0.0, 0.0, 15.0, "FixOutcome"),
            ("source", 16, 2, "unsigned", 1.0, 0.0, 0.0, 3.0, "FixSource"),
            ("handed_over", 18, 1, "unsigned", 1.0, 0.0, 0.0, 1.0, None),
            ("degraded", 19, 1, "unsigned", 1.0, 0.0, 0.0, 1.0, None),
            ("repairs", 20, 16, "unsigned", 1.0, 0.0, 0.0, 65535.0, None),
            ("gated", 36, 14, "unsigned", 1.0, 0.0, 0.0, 16383.0, None),
            ("refused", 50, 14, "unsigned", 1.0, 0.0, 0.0, 16383.0, None),
        )),
        ("FixUpdate", 0x3CD, 0x43CD, 8, (
            ("cause_time_us", 12, 32, "unsigned", 1.0, 0.0, 0.0, 4294967295.0, None),
            ("cause_counter", 44, 4, "unsigned", 1.0, 0.0, 0.0, 14.0, None),
            ("nis", 48, 16, "unsigned", 0.01, 0.0, 0.0, 65535.0, None),
        )),
    ),
    "TargetCommand": (
        ("TargetCommand", 0x600, 0x4600, 8, (
            ("command", 12, 3, "unsigned", 1.0, 0.0, 0.0, 7.0, "Command"),
            ("estimator", 15, 3, "unsigned", 1.0, 0.0, 0.0, 7.0, "Estimator"),
            ("algorithm", 18, 5, "unsigned", 1.0, 0.0, 0.0, 31.0, "Algorithm"),
            ("dbc_hash", 23, 24, "unsigned", 1.0, 0.0, 0.0, 16777215.0, None),
        )),
    ),
    "ParamSet": (
        ("ParamSet", 0x601, 0x4601, 8, (
            ("parameter", 12, 8, "unsigned", 1.0, 0.0, 0.0, 255.0, "Parameter"),
            ("value", 20, 32, "float", 1.0, 0.0, -3.4e+38, 3.4e+38, None),
        )),
    ),
    "ParamAck": (
        ("ParamAck", 0x602, 0x4602, 8, (
            ("parameter", 12, 8, "unsigned", 1.0, 0.0, 0.0, 255.0, "Parameter"),
            ("value", 20, 32, "float", 1.0, 0.0, -3.4e+38, 3.4e+38, None),
            ("status", 52, 4, "unsigned", 1.0, 0.0, 0.0, 15.0, "ParameterStatus"),
        )),
    ),
    "StepDone": (
        ("StepDone", 0x603, 0x4603, 8, (
            ("step", 12, 11, "unsigned", 1.0, 0.0, 0.0, 2047.0, None),
        )),
    ),
    "TargetInitAir": (
        ("TargetInitRate", 0x608, 0x4608, 8, (
            ("rate_x_degps", 12, 17, "signed", 0.0005, 0.0, -65535.0, 65535.0, None),
            ("rate_y_degps", 29, 17, "signed", 0.0005, 0.0, -65535.0, 65535.0, None),
            ("rate_z_degps", 46, 17, "signed", 0.0005, 0.0, -65535.0, 65535.0, None),
        )),
        ("TargetInitAirVelocity", 0x609, 0x4609, 8, (
            ("air_velocity_x_mps", 12, 17, "signed", 0.01, 0.0, -65535.0, 65535.0, None),
            ("air_velocity_y_mps", 29, 17, "signed", 0.01, 0.0, -65535.0, 65535.0, None),
            ("air_velocity_z_mps", 46, 17, "signed", 0.01, 0.0, -65535.0, 65535.0, None),
        )),
    ),
    "TargetInit": (
        ("TargetInitLatitude", 0x610, 0x4610, 8, (
            ("latitude_deg", 12, 32, "signed", 1e-07, 0.0, -900000000.0, 900000000.0, None),
            ("height_m", 44, 20, "unsigned", 0.1, -10000.0, 0.0, 1048575.0, None),
        )),
        ("TargetInitLongitude", 0x611, 0x4611, 8, (
            ("longitude_deg", 12, 32, "signed", 1e-07, 0.0, -1800000001.0, 1800000001.0, None),
            ("position_sigma_m", 44, 20, "unsigned", 0.01, 0.0, 0.0, 1048500.0, None),
        )),
        ("TargetInitVelocityNE", 0x612, 0x4612, 8, (
            ("velocity_north_mps", 12, 24, "signed", 0.0002, 0.0, -8385000.0, 8385000.0, None),
            ("velocity_east_mps", 36, 24, "signed", 0.0002, 0.0, -8385000.0, 8385000.0, None),
        )),
        ("TargetInitAttitude", 0x613, 0x4613, 8, (
            ("roll_deg", 12, 17, "signed", 0.003, 0.0, -60000.0, 60000.0, None),
            ("pitch_deg", 29, 17, "signed", 0.003, 0.0, -60000.0, 60000.0, None),
            ("heading_deg", 46, 17, "signed", 0.003, 0.0, -60000.0, 60000.0, None),
        )),
        ("TargetInitSigma", 0x614, 0x4614, 8, (
            ("velocity_sigma_mps", 12, 16, "unsigned", 0.001, 0.0, 0.0, 65535.0, None),
            ("tilt_sigma_deg", 28, 16, "unsigned", 0.01, 0.0, 0.0, 65535.0, None),
            ("heading_sigma_deg", 44, 16, "unsigned", 0.01, 0.0, 0.0, 65535.0, None),
        )),
        ("TargetInitVelocityD", 0x615, 0x4615, 8, (
            ("velocity_down_mps", 12, 20, "signed", 0.002, 0.0, -524000.0, 524000.0, None),
            ("time_of_validity_us", 32, 32, "unsigned", 1.0, 0.0, 0.0, 4294967295.0, None),
        )),
    ),
}

# Group of answers: the groups that it answers.
ANSWERS = {
    "LosRate": ("Seeker", ),
    "AlignNav": ("SlaveImu", ),
    "FixNav": ("SlaveImu", ),
    "Wind": ("GliderNav", ),
    "AlignFilter": ("MasterIns", ),
    "FixFilter": ("Ssbl", "Gps", ),
}

CYCLE_MS = {
    "Seeker": 5,
    "LosRate": 5,
    "SlaveImu": 10,
    "Sync": 10,
    "AlignNav": 10,
    "FixNav": 10,
    "Fins": 10,
    "GliderNav": 20,
    "Wind": 20,
    "MasterIns": 100,
    "AlignFilter": 100,
    "TargetHeartbeat": 100,
    "TargetTiming": 100,
    "TargetCounters": 100,
    "Ssbl": 1000,
    "Gps": 1000,
    "FixFilter": 1000,
}

# The groups that a target sends.
FROM_TARGET = {
    "LosRate",
    "AlignNav",
    "FixNav",
    "Wind",
    "AlignFilter",
    "TargetHeartbeat",
    "TargetTiming",
    "TargetCounters",
    "FixFilter",
    "ParamAck",
    "StepDone",
}
