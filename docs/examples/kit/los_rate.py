"""An example of the kit, the line-of-sight rate of a seeker by an alpha-beta-gamma filter:

    hil-bench run bench/flights/los_quick.toml --target 'python3 docs/examples/kit/los_rate.py'

los_rate.c is the same filter in C; its answers are bit for bit the same."""

import argparse
import math
import sys

import canhil_target
from canhil_target import Parameter

LEAST_RANGE_M = 50.0  # a shorter measured range is replaced by this one, because the filter divides by the range


class Plane:
    """One plane of the seeker: angle from antenna to LOS [rad], inertial LOS rate [rad/s], acceleration of the seeker's target [m/s2]."""

    def __init__(self):
        self.error = self.rate = self.target = self.sigma = self.nis = 0.0

    def step(self, measured, turned, missile, dt, reach, closing, noise, agility, n):
        """Processes the n-th sample. measured: error angle; turned: rotation of the antenna; missile: acceleration of the missile; reach:
        range; noise [rad]; agility [m/s2]. The model: d(rate)/dt = (2 closing rate + target - missile) / range."""
        self.error += self.rate * dt - turned
        self.rate += (2 * closing * self.rate + self.target - missile) / reach * dt
        # The gains follow from Kalata's tracking index, the ratio of target manoeuvre to measurement noise (IEEE AES-20 (1984), 174).
        index = agility / reach * dt * dt / noise
        root = (4 + index - math.sqrt(8 * index + index * index)) / 4
        alpha = 1 - root * root
        beta = 2 * (2 - alpha) - 4 * root
        gamma = beta * beta / alpha
        if n > 1:  # the gains of a straight line through the first n samples are used as long as they are larger
            alpha, beta = max(alpha, min(2 * (2 * n - 1) / (n * (n + 1)), 0.99)), max(beta, 6 / (n * (n + 1)))
        else:
            alpha, beta = 0.99, 0.0
        innovation = measured - self.error
        self.error += alpha * innovation
        self.rate += beta / dt * innovation
        self.target += reach * gamma / (dt * dt) * innovation
        self.nis = innovation * innovation * (1 - alpha) / (noise * noise)  # because alpha = P / (P + noise^2)
        self.sigma = noise / dt * math.sqrt(max(beta * (alpha - beta / 2) / (1 - alpha), 0.0))


class LosRate(canhil_target.Estimator):
    estimator = "los_rate"
    algorithms = ("combined", "low_pass")
    answers = {"Seeker": "LosRate"}
    parameters = {  # the parameters that los_quick.toml sets
        "thermal_noise_pitch_radpm2": Parameter(1e-10, 1e-14, 1e-6),
        "thermal_noise_yaw_radpm2": Parameter(1e-10, 1e-14, 1e-6),
        "glint_noise_pitch_m": Parameter(0.5, 1e-3, 100),
        "glint_noise_yaw_m": Parameter(0.5, 1e-3, 100),
        "sample_period_ms": Parameter(5, 0.5, 50),
        "range_sigma_m": Parameter(15, 0, 1e3),
        "jerk_density_m2ps5": Parameter(300, 1e-3, 1e6, while_running=True),
    }

    def __init__(self, gain):
        self.gain = gain

    def start(self, algorithm, parameters, initial):
        self.parameter, self.updates, self.t_us = parameters, 0, None
        self.pitch, self.yaw = Plane(), Plane()

    def sample(self, group, values, t_us):
        dt = self.parameter["sample_period_ms"] * 1e-3 if self.t_us is None else (t_us - self.t_us) * 1e-6
        self.t_us = t_us
        if any(values[what + "_validity"] != "valid" for what in ("error", "antenna", "acceleration", "closing_speed", "range")):
            return self.answer("coasting" if self.updates else "waiting", 0)
        self.updates += 1
        reach = max(values["range_m"], LEAST_RANGE_M)
        agility = self.gain * math.sqrt(self.parameter["jerk_density_m2ps5"])
        for plane, axis, missile in ((self.pitch, "pitch", -values["missile_acceleration_z_mps2"]),
                                     (self.yaw, "yaw", values["missile_acceleration_y_mps2"])):
            thermal = self.parameter[f"thermal_noise_{axis}_radpm2"] * reach * reach
            glint = self.parameter[f"glint_noise_{axis}_m"] / reach
            plane.step(values[f"error_{axis}_rad"], values[f"antenna_increment_{axis}_rad"], missile, dt, reach,
                       values["closing_speed_mps"], math.sqrt(thermal * thermal + glint * glint), agility, self.updates)
        return self.answer("updated" if self.updates > 1 else "started", self.pitch.nis + self.yaw.nis)

    def answer(self, outcome, nis):
        return {"los_rate_pitch_radps": self.pitch.rate, "los_rate_yaw_radps": self.yaw.rate,
                "los_rate_sigma_pitch_radps": self.pitch.sigma, "los_rate_sigma_yaw_radps": self.yaw.sigma,
                "target_acceleration_z_mps2": -self.pitch.target, "target_acceleration_y_mps2": self.yaw.target,
                "nis": nis, "outcome": outcome}


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--bus", required=True, help="can0, vcan0 or local:NAME; hil-bench appends it")
    parser.add_argument("--gain", type=float, default=4.0, help="more follows the target sooner, less smooths more")
    given = parser.parse_args()
    sys.exit(canhil_target.serve(LosRate(given.gain), given.bus))
