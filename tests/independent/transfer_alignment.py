"""Transfer alignment by velocity matching: a slave INS is aligned to a master INS by a Kalman filter or a robust H2 filter."""

import os

os.environ.update(OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1")  # the matrices are small: threads would only wait

import collections  # noqa: E402
import copy  # noqa: E402
import math  # noqa: E402

import numpy as np  # noqa: E402

import defects  # noqa: E402  (names the folder of the kit)
import canhil_target  # noqa: E402
from canhil_target import Parameter  # noqa: E402
from transfer_alignment_errors import DEG, DEGPH, DF, DW, PHI, UG, V, ErrorFilter  # noqa: E402
from transfer_alignment_ins import ImuStream, Ins, Silent, attitude, euler, split  # noqa: E402

HISTORY_US = 500_000  # a velocity that is so late still finds the state of its time
LONGEST_STEP_S = 1.5  # of the filter: without velocities it predicts on its own
SILENCE_US = 500_000  # after so long without IMU samples the alignment ends


class Filter(canhil_target.Estimator):
    estimator = "transfer_alignment"
    algorithms = ("kalman", "robust_h2")
    answers = {"SlaveImu": "AlignNav", "MasterIns": "AlignFilter"}
    parameters = {
        "accel_bias_sigma_ug": Parameter(300, 0, 1e6),
        "gyro_bias_sigma_degph": Parameter(3, 0, 1e6),
        "accel_noise_ugprthz": Parameter(50, 0, 1e6, while_running=True),
        "gyro_noise_degprth": Parameter(0.125, 0, 1e4, while_running=True),
        "velocity_noise_m2ps": Parameter(0.01, 1e-9, 1e4, while_running=True),
        "h2_case": Parameter(2, 1, 4, whole=True),
        "h2_alpha_rule": Parameter(0, 0, 1, whole=True),
        "h2_alpha_mps2": Parameter(0, 0, 1000, while_running=True),
        "fading_per_s": Parameter(0, 0, 10, while_running=True),
        "mechanization": Parameter(1, 0, 1, whole=True),
        "closed_loop": Parameter(2, 0, 2, whole=True),
        "output_interval_ms": Parameter(10, 1, 1000, while_running=True),
        "gate_nis": Parameter(2000, 0, 1e9, while_running=True),
        "gate_recovery": Parameter(5, 0, 1e6, whole=True, while_running=True),
        "accel_scale_factor_sigma_ppm": Parameter(300, 0, 1e5),
        "accel_misalignment_sigma_mrad": Parameter(0.5, 0, 100),
        "gyro_scale_factor_sigma_ppm": Parameter(300, 0, 1e5),
        "gyro_misalignment_sigma_mrad": Parameter(0.5, 0, 100),
        "lever_arm_sigma_m": Parameter(0.5, 0, 100),
        "velocity_correlated_mps": Parameter(0.05, 0, 100),
        "velocity_correlation_s": Parameter(5, 0.001, 1e6),
    }

    def start(self, algorithm, parameters, initial):
        self.parameter, self.initial = parameters, dict(initial)
        self.errors = ErrorFilter(algorithm, parameters, initial)
        self.base = self.now = None  # the INS at the last step of the filter or later, and at the last IMU sample
        self.between = collections.deque()  # the motion from base to now
        self.answered_us, self.coasting, self.master_us, self.master_period_us = -math.inf, False, None, math.inf

    def begin(self, t_us):
        """The initial state came with the low 32 bits of its time."""
        self.start_us = t_us + (self.initial["time_of_validity_us"] - t_us + 2**31) % 2**32 - 2**31
        C = attitude(*(self.initial[f"{angle}_deg"] * DEG for angle in ("roll", "pitch", "heading")))
        self.now = Ins(self.start_us, C, velocity_of(self.initial), self.initial["latitude_deg"] * DEG, self.initial["height_m"],
                       self.errors.with_products)
        self.base, self.master_us = copy.copy(self.now), self.start_us
        self.imu = ImuStream(self.start_us, self.parameter["mechanization"] == 1)

    def has_reached(self, t_us):
        return self.now is not None and self.now.t_us >= t_us

    def sample(self, group, values, t_us):
        """Returns None if this sample has no answer."""
        if self.now is None:
            self.begin(t_us)
        return self.on_imu(values, t_us) if group == "SlaveImu" else self.on_master(values, t_us)

    # ---- the IMU ----

    def on_imu(self, values, t_us):
        if t_us <= self.now.t_us or not values["gyro_validity"] == values["accel_validity"] == "valid":
            return None
        for motion in self.imu.take(values, t_us):
            self.coasting = self.coasting or motion.variance is not None
            self.between.append(motion)
            self.now.advance(motion)
        while t_us - self.between[0].end_us > HISTORY_US:
            self.base.advance(self.between.popleft())
        if self.base.time > LONGEST_STEP_S:
            self.step()
            self.restart_from_base()
        if t_us - self.answered_us < self.parameter["output_interval_ms"] * 1e3:
            return None
        return self.navigation(t_us)

    def navigation(self, t_us):
        C, velocity = self.now.C, self.now.V
        if self.errors.x.any():  # the INS is not corrected, but its answers are
            C, velocity = self.errors.corrected(C, velocity, self.errors.extrapolated(self.now))
        roll, pitch, heading = euler(C)
        answer = {"roll_deg": roll / DEG, "pitch_deg": pitch / DEG, "heading_deg": heading / DEG, "coasting": self.coasting,
                  **named("velocity_{}_mps", velocity, NED)}
        self.answered_us, self.coasting = t_us, False
        return answer

    # ---- the master ----

    def on_master(self, values, t_us):
        if values["velocity_validity"] != "valid" or t_us <= self.base.t_us:
            return None
        self.move_base_to(t_us)
        self.step()
        innovation, nis = self.errors.update(self.base.V - velocity_of(values), self.velocity_variance(t_us), self.base)
        answer = self.state_of_filter(innovation, nis)
        if self.parameter["closed_loop"]:
            self.errors.correct(self.base)
        self.restart_from_base()
        return answer

    def velocity_variance(self, t_us):
        """R / dt. As published, dt is the time since the last velocity. In the invariant loop it is the period, the shortest such time so far, so
        that a velocity is not trusted more because others were lost."""
        dt_us = t_us - self.master_us
        if self.errors.invariant and self.master_us > self.start_us:
            self.master_period_us = dt_us = min(dt_us, self.master_period_us)
        self.master_us = t_us
        return self.parameter["velocity_noise_m2ps"] / (dt_us * 1e-6)

    def move_base_to(self, t_us):
        if t_us == self.now.t_us:
            self.base = self.now
            self.between.clear()
            return
        while self.base.t_us < t_us:
            motion = self.between.popleft()
            if motion.end_us > t_us:
                motion, rest = split(motion, t_us)
                self.between.appendleft(rest)
            self.base.advance(motion)

    def step(self):
        self.errors.predict(self.base)
        self.base.clear_sums()

    def restart_from_base(self):
        self.now = copy.copy(self.base)
        for motion in self.between:
            self.now.advance(motion)

    def state_of_filter(self, innovation, nis):
        P = self.errors.P
        sigma = np.sqrt(np.maximum(P.diagonal(), 0.0))
        n, e, d = sigma[PHI]
        correlation = [P[i, j] / product if product > 0 else 0.0 for i, j, product in ((3, 4, n * e), (3, 5, n * d), (4, 5, e * d))]
        return {**named("innovation_{}_mps", innovation, NED), **named("attitude_sigma_{}_rad", sigma[PHI], NED),
                **named("attitude_correlation_{}", correlation, ("ne", "nd", "ed")), **named("velocity_sigma_{}_mps", sigma[V], NED),
                **named("gyro_bias_{}_degph", (self.base.gyro_bias + self.errors.x[DW]) / DEGPH, XYZ),
                **named("gyro_bias_sigma_{}_degph", sigma[DW] / DEGPH, XYZ),
                **named("accel_bias_{}_ug", (self.base.accel_bias + self.errors.x[DF]) / UG, XYZ),
                **named("accel_bias_sigma_{}_ug", sigma[DF] / UG, XYZ), "nis": nis, "degraded": self.errors.degraded}


NED, XYZ = ("north", "east", "down"), ("x", "y", "z")


def named(name, values, axes):
    return {name.format(axis): float(value) for axis, value in zip(axes, values)}


def velocity_of(values):
    return np.array([values[f"velocity_{axis}_mps"] for axis in NED])


class Target(canhil_target.Target):
    """The kit's target answers each sample at once. This one may leave a sample unanswered (output interval, invalid samples), lets a velocity wait
    until the IMU samples have reached its time, ends the alignment if the IMU is silent, and reports degraded."""

    def enter(self, state):
        if state == "running":
            self.waiting, self.imu_us = collections.deque(), None
        super().enter(state)

    def on_sync(self, sync):
        if self.state == "running":
            self.imu_us = sync["time_us"] if self.imu_us is None else self.imu_us
            if sync["time_us"] - self.imu_us > SILENCE_US:
                self.give_up("input_silent")
        super().on_sync(sync)

    def on_sample(self, group, counter, values):
        t_us = self.unwrapped_us(group, values["time_of_validity_us"])
        if t_us > self.now_us + canhil_target.LEAD_LIMIT_US:
            self.losses["bad_group"] += 1
            self.errors["input_lost"] = True
            return False
        if t_us <= max(self.answered_us.get(group, -math.inf), self.now_us - HISTORY_US):
            self.losses["late"] += 1
            return False
        self.answered_us[group] = self.heard_us = t_us
        if group == "MasterIns":
            self.waiting.append((group, counter, values, t_us))
            answered = False
        else:
            self.imu_us = t_us
            answered = self.process(group, counter, values, t_us)
        while self.state == "running" and self.waiting and self.estimator.has_reached(self.waiting[0][-1]):
            answered = self.process(*self.waiting.popleft()) or answered
        return answered

    def process(self, group, counter, values, t_us):
        try:
            answer = self.estimator.sample(group, values, t_us)
        except Silent:
            self.give_up("input_silent")
            return False
        except (ArithmeticError, np.linalg.LinAlgError):
            self.give_up("numeric")
            return False
        if answer is None:
            return False
        self.send_group(self.estimator.answers[group], {**answer, "cause_time_us": t_us % 2**32, "cause_counter": counter})
        return True

    def give_up(self, error):
        self.errors[error] = True
        self.enter("fault")

    def send_group(self, group, values):
        if group == "TargetHeartbeat" and self.state == "running":
            values = {**values, "degraded": self.estimator.errors.degraded}
        super().send_group(group, values)


if __name__ == "__main__":
    increments = [f"delta_{what}_{axis}_{unit}" for what, unit in (("theta", "rad"), ("v", "mps")) for axis in XYZ]
    defects.main(Filter, sign_of="delta_theta_z_rad", delay_of=increments, make_target=Target)
