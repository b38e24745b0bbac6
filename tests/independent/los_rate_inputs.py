"""What the seeker's inputs are worth: range and closing speed that may jump or stand still, motion of the missile that may be missing."""

import math


class Track:
    """A measured quantity. A value further than the gate from the extrapolated one is a jump, until several jumps in a row agree with each other."""

    def __init__(self, gate, relock_samples):
        self.gate, self.relock_samples = gate, relock_samples
        self.value = self.candidate = None
        self.agreeing = 0

    def step(self, measured, change):
        """Extrapolates by the expected change, then takes the measured value (None: there is none). Returns False if it is a jump."""
        if self.value is not None:
            self.value += change
        if measured is None:
            self.agreeing = 0
            return True
        if self.value is None or abs(measured - self.value) <= self.gate:
            self.value, self.agreeing = measured, 0
            return True
        agrees = self.agreeing > 0 and abs(measured - self.candidate - change) <= self.gate
        self.agreeing, self.candidate = self.agreeing + 1 if agrees else 1, measured
        if self.agreeing < self.relock_samples:
            return False
        self.value, self.agreeing = measured, 0
        return True


class Approach:
    """Range and closing speed."""

    def __init__(self, range_gate_m, closing_speed_gate_mps, relock_samples, unchanged_limit_s):
        self.range = Track(range_gate_m, relock_samples)
        self.speed = Track(closing_speed_gate_mps, relock_samples)
        self.unchanged_limit_s = unchanged_limit_s
        self.last_range, self.unchanged_s = None, 0.0

    @property
    def known(self):
        return self.range.value is not None and self.speed.value is not None

    def step(self, range_m, closing_speed_mps, dt):
        """Processes the values of a sample, None if invalid, dt after the last one. Returns what was wrong with them, by the DBC's names."""
        speed_used = self.speed.step(closing_speed_mps, 0.0)
        wrong = []
        if range_m is not None and range_m <= 0:
            range_m = None
        if range_m is None:
            wrong.append("range_invalid")
        repeats = range_m is not None and range_m == self.last_range
        self.unchanged_s = self.unchanged_s + dt if repeats else 0.0
        if self.unchanged_s > self.unchanged_limit_s:
            wrong.append("range_stale")
        # A range that repeats itself says nothing new: the extrapolated range is better, from the first repetition on.
        change = -(self.speed.value or 0.0) * dt
        used = self.range.step(None if repeats else range_m, change)
        if not used or (repeats and abs(range_m - self.range.value) > self.range.gate):
            wrong.append("range_jump")
        if range_m is not None:
            self.last_range = range_m
        if closing_speed_mps is None or not speed_used:
            wrong.append("closing_speed_invalid")
        return wrong


class Motion:
    """A motion of the missile that each sample reports as its mean over the sample's interval: a complex number, yaw + j pitch."""

    def __init__(self, sigma, bridged_s):
        self.sigma, self.bridged_s = sigma, bridged_s  # of an unmeasured motion; the longest gap that is bridged
        self.last = None

    def step(self, mean, dt, gap):
        """Processes the mean over the last dt - gap seconds (None: not measured). The gap before is bridged by the mean of the motions before
        and after it. Returns the mean over dt, the time without measurement [s], and the 1-sigmas (yaw, pitch) of the error in this time."""
        before = self.last
        if mean is None:
            return before or 0j, dt, (self.sigma, self.sigma)
        self.last = mean
        if before is None or gap == 0:
            return mean, gap, (self.sigma, self.sigma)
        between = (before + mean) / 2
        change = mean - before
        # Where between both ends the motion was is not known: as if it were distributed evenly.
        bridge = (abs(change.real) / math.sqrt(12), abs(change.imag) / math.sqrt(12))
        return mean + (between - mean) * gap / dt, gap, bridge if gap <= self.bridged_s else (self.sigma, self.sigma)
