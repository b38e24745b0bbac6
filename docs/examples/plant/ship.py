"""A ship whose rudder turns its heading, as a program that hil-bench drives: [plant] kind = "program", command = "python3 ship.py".

The model is that of the bench's own plant "steered_heading" (Nomoto's first-order model, an actuator with lag, largest rate and stop, and a gust), with the same steps: fourth-order Runge-Kutta,
at most 1 ms each. So both plants make the same trajectory to rounding, and you can compare your own changes with the original.
"""
import math
import sys
from pathlib import Path

try:
    from canhil import partner  # the package, if it is installed
except ImportError:
    sys.path.append(str(Path(__file__).resolve().parents[3] / "python/canhil"))  # its file in a clone
    import partner

LONGEST = 0.001  # of a step of the integration, in s


def clamp(value, most):
    return max(-most, min(most, value))


class Ship:
    inputs = {"rudder": "rad"}
    outputs = {"attitude.heading": "rad turns", "velocity.north": "m/s", "velocity.east": "m/s", "turn_rate": "rad/s", "rudder": "rad"}

    def __init__(self, heading_deg, speed_mps, turn_time_constant_s, turn_gain_per_s, actuator_lag_s=0.0, actuator_rate_degps=1000.0, actuator_stop_deg=35.0,
                 actuator_offset_deg=0.0, gust_from_s=0.0, gust_to_s=0.0, gust_degps2=0.0):
        self.speed, self.time_constant, self.gain, self.lag = speed_mps, turn_time_constant_s, turn_gain_per_s, actuator_lag_s
        self.rate_limit, self.stop = math.radians(actuator_rate_degps), math.radians(actuator_stop_deg)
        self.offset = math.radians(actuator_offset_deg)
        self.gust_from, self.gust_to, self.gust_most = gust_from_s, gust_to_s, math.radians(gust_degps2)
        self.x = [math.radians(heading_deg), 0.0, 0.0]  # heading, turn rate, rudder

    def values(self):
        heading, turn_rate, rudder = self.x
        return [heading, self.speed * math.cos(heading), self.speed * math.sin(heading), turn_rate, rudder]

    def step(self, t, dt, inputs):
        steps = math.ceil(dt / LONGEST - 1e-6)  # dt may be a rounding error above a whole number of steps
        for i in range(steps):
            self.advance(t + i * dt / steps, dt / steps, clamp(inputs["rudder"] + self.offset, self.stop))

    def gust(self, t):
        """An angular acceleration that rises and falls once, as (1 - cos)/2."""
        if not self.gust_from < t < self.gust_to:
            return 0.0
        return self.gust_most * (1 - math.cos(2 * math.pi * (t - self.gust_from) / (self.gust_to - self.gust_from))) / 2

    def rates(self, t, x, wanted):
        moving = clamp((wanted - x[2]) / self.lag, self.rate_limit) if self.lag > 0 else 0.0
        return [x[1], (self.gain * x[2] - x[1]) / self.time_constant + self.gust(t), moving]

    def advance(self, t, dt, wanted):
        x = self.x
        if self.lag <= 0:
            x[2] += clamp(wanted - x[2], self.rate_limit * dt)

        def after(part, rates):
            return [value + part * rate for value, rate in zip(x, rates)]

        k1 = self.rates(t, x, wanted)
        k2 = self.rates(t + dt / 2, after(dt / 2, k1), wanted)
        k3 = self.rates(t + dt / 2, after(dt / 2, k2), wanted)
        k4 = self.rates(t + dt, after(dt, k3), wanted)
        self.x = [value + dt / 6 * (a + 2 * b + 2 * c + d) for value, a, b, c, d in zip(x, k1, k2, k3, k4)]


partner.serve(Ship)
