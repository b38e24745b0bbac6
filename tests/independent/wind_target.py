"""What the wind estimator needs of the protocol beyond the kit, and the record of the fins' deflections."""

import canhil_target

NAVIGATION, FINS = "GliderNav", "Fins"
FINS_AHEAD_US = 200_000  # the times of FinDeflections, 16 bits, are at most this far ahead
JITTER_US = 1_000  # of the sampling; an answer that is due so much later is sent


class Target(canhil_target.Target):
    def forget(self):
        super().forget()
        self.initial_air = {}
        self.sent_us = None

    def dispatch(self, group, place, counter, data, signals):
        """The initial air velocity is a group of its own, before TargetInit."""
        if group != "TargetInitAir":
            return super().dispatch(group, place, counter, data, signals)
        if self.state == "running":
            self.errors["command"] = True
            return False
        self.initial_air = self.completed(group, place, counter, canhil_target.decode(data, signals)) or self.initial_air
        return False

    def on_initial(self, values):
        super().on_initial({**values, **self.initial_air})

    def send_group(self, group, values):
        if group == "TargetHeartbeat":
            values = {**values, "degraded": self.state == "running" and self.estimator.degraded}
        super().send_group(group, values)

    def start(self):
        self.sent_us = None
        super().start()

    def unwrapped_us(self, group, value):
        if group != FINS:
            return super().unwrapped_us(group, value)
        latest, period = self.now_us + FINS_AHEAD_US, 655_360
        return latest - (latest - round(value)) % period

    def on_sample(self, group, counter, values):
        """Unlike the kit's: a sample that is not used has an answer too, which says why; and answers have a least interval."""
        t_us = self.unwrapped_us(group, values["time_of_validity_us"])
        self.estimator.now_us = self.now_us
        try:
            answer = self.estimator.sample(group, values, t_us)
        except ArithmeticError:
            self.errors["numeric"] = True
            self.enter("fault")
            return False
        refused = self.estimator.refused
        if refused:
            self.losses[refused] += 1
            self.errors["input_lost"] = self.errors["input_lost"] or refused != "late"
        if group == FINS:
            return False
        self.heard_us, self.errors["input_silent"] = self.now_us, False
        if self.sent_us is not None and 0 <= t_us - self.sent_us < 1000 * self.parameters["output_interval_ms"] - JITTER_US:
            return False
        self.sent_us = t_us
        self.send_group(self.estimator.answers[group], {**answer, "cause_time_us": t_us % 2**32, "cause_counter": counter})
        return True


class FinRecord:
    """Deflections over time. A time in the future is outvoted by the next two that ascend, more than 0.1 s before it."""
    KEPT = 400
    FALSE_TIME_S = 0.1
    PHYSICAL_DEG = 21.0  # the stops are at 20 deg; the rest is for errors of the measurement

    def __init__(self):
        self.times, self.values, self.earlier = [], [], []
        self.not_physical = False
        self.gap_s = 0.0  # longest time between two deflections since the reader has set it to 0

    def add(self, t, deflections, physical):
        """Returns the count of losses that this sample belongs to, or ''."""
        self.not_physical = not physical
        if not physical:
            return ""
        if self.times and t <= self.times[-1]:
            return self.outvoted(t, deflections)
        self.earlier = []
        if self.times:
            self.gap_s = max(self.gap_s, t - self.times[-1])
        self.times.append(t)
        self.values.append(deflections)
        if len(self.times) > 2 * self.KEPT:
            del self.times[:self.KEPT], self.values[:self.KEPT]
        return ""

    def outvoted(self, t, deflections):
        if t >= self.times[-1] - self.FALSE_TIME_S or (self.earlier and t <= self.earlier[-1][0]):
            self.earlier = []
            return "late"
        self.earlier.append((t, deflections))
        if len(self.earlier) < 2:
            return "late"
        while self.times and self.times[-1] >= self.earlier[0][0]:
            self.times.pop()
            self.values.pop()
        for time, value in self.earlier:
            self.times.append(time)
            self.values.append(value)
        self.earlier = []
        return ""

    def at(self, t):
        """Interpolated; before the first and after the last the deflections are those. Neutral if none is known."""
        times, values = self.times, self.values
        index = len(times)
        while index and times[index - 1] > t:
            index -= 1
        if index == len(times):
            return values[-1] if values else (0.0, 0.0, 0.0)
        if index == 0:
            return values[0]
        share = (t - times[index - 1]) / (times[index] - times[index - 1])
        return tuple(a + share * (b - a) for a, b in zip(values[index - 1], values[index]))

    def age(self, t):
        """Time from the newest deflection to t [s]."""
        return t - self.times[-1] if self.times else float("inf")
