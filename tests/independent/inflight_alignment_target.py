"""The target of the kit, with what in-flight alignment needs beside it: samples without an answer, answers that wait, and the end at a silent IMU."""

import canhil_target
from canhil_target import LEAD_LIMIT_US, SILENCE_LIMIT_US

WAIT_LIMIT_US = 500_000  # a fix that is valid later than the newest IMU sample waits for the IMU, if it is not further ahead


class Silent(ArithmeticError):
    """The samples of the IMU have a gap that cannot be bridged."""


class Target(canhil_target.Target):
    def enter(self, state):
        self.waiting = []  # fixes: (time of validity, group, counter, values)
        super().enter(state)

    def send_group(self, group, values):
        if group == "TargetHeartbeat":
            values = {**values, "degraded": self.state == "running" and self.estimator.degraded}
        super().send_group(group, values)

    def on_sync(self, sync):
        if self.state == "running" and sync["time_us"] - self.heard_us > SILENCE_LIMIT_US:
            self.end("input_silent")
        super().on_sync(sync)

    def end(self, error):
        self.errors[error] = True
        self.enter("fault")

    def on_sample(self, group, counter, values):
        t_us = self.unwrapped_us(group, values["time_of_validity_us"])
        if group != "SlaveImu":
            ahead_us = t_us - self.estimator.time_us
            if self.estimator.time_us and 0 < ahead_us <= WAIT_LIMIT_US:
                self.waiting.append((t_us, group, counter, values))
                return False
            return self.answer(group, counter, values, t_us)
        if t_us > self.now_us + LEAD_LIMIT_US:
            self.losses["bad_group"] += 1
            self.errors["input_lost"] = True
            return False
        if t_us <= self.answered_us.get(group, -1):
            self.losses["late"] += 1
            return False
        self.answered_us[group] = self.heard_us = t_us
        answered = self.answer(group, counter, values, t_us)
        ready = [fix for fix in self.waiting if fix[0] <= self.estimator.time_us]
        self.waiting = [fix for fix in self.waiting if fix[0] > self.estimator.time_us]
        for fix_us, fix_group, fix_counter, fix in ready:
            self.answer(fix_group, fix_counter, fix, fix_us)
        if answered and self.state == "running":
            self.send_answer("FixFilter", self.estimator.predicted(), counter, t_us)
        return answered

    def answer(self, group, counter, values, t_us):
        """Returns whether the sample was answered."""
        if self.state != "running":
            return False
        try:
            answer = self.estimator.sample(group, values, t_us)
        except ArithmeticError as error:
            self.end("input_silent" if isinstance(error, Silent) else "numeric")
            return False
        return self.send_answer(self.estimator.answers[group], answer, counter, t_us)

    def send_answer(self, group, answer, counter, t_us):
        if answer is None:
            return False
        self.send_group(group, {**answer, "cause_time_us": t_us % 2**32, "cause_counter": counter})
        return True
