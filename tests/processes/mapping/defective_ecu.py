"""docs/examples/own_ecu/own_ecu.py with a defect: defective_ecu.py DEFECT [--answers ID] --bus BUS. ID: of its answers, one below that of its status."""
import math
import sys
import time
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[3] / "docs/examples/own_ecu"))
import own_ecu
from canhil_target import open_bus


class WrongSign(own_ecu.Ecu):
    """Uses the pitch rate with the wrong sign, as if the sensor were mounted the wrong way round."""

    def sample(self, rates, force):
        super().sample((rates[0], -rates[1], rates[2]), force)


class Stale(own_ecu.Ecu):
    """Sends in each answer the attitude that it had 50 ms before."""

    def __init__(self):
        super().__init__()
        self.past = []

    def answer(self, of):
        self.past = (self.past + [self.angles])[-6:]
        now, self.angles = self.angles, self.past[0]
        frame = super().answer(of)
        self.angles = now
        return frame


class WrongChecksum(own_ecu.Ecu):
    """Sends every hundredth answer with a wrong checksum."""

    def __init__(self):
        super().__init__()
        self.answers = 0

    def answer(self, of):
        self.answers += 1
        frame = super().answer(of)
        return frame if self.answers % 100 else frame[:7] + bytes([frame[7] ^ 1])


class FrozenCounter(own_ecu.Ecu):
    def answer(self, of):
        self.counter = 3
        return super().answer(of)


class Slow(own_ecu.Ecu):
    """Needs 15 ms for every twentieth sample."""

    def __init__(self):
        super().__init__()
        self.answers = 0

    def answer(self, of):
        self.answers += 1
        if self.answers % 20 == 0:
            time.sleep(0.015)
        return super().answer(of)


class Silent(own_ecu.Ecu):
    """Stops answering after 5 s but continues to send its status."""

    def __init__(self):
        super().__init__()
        self.answers = 0

    def answer(self, of):
        self.answers += 1
        return super().answer(of) if self.answers < 500 else None


class Zero(own_ecu.Ecu):
    """Always sends the angles 0 and 0."""

    def answer(self, of):
        self.angles = (0, 0)
        return super().answer(of)


class LateHeading(own_ecu.Ecu):
    """Sends in place of the roll angle the heading that it had 400 ms before. The flight starts at 180 deg, level."""

    def __init__(self):
        super().__init__()
        self.heading, self.past = math.pi, []

    def sample(self, rates, force):
        self.heading -= rates[2] * own_ecu.DT
        self.past = (self.past + [self.heading])[-41:]
        self.angles = (math.remainder(self.past[0], 2 * math.pi), 0)


class RoundLate(own_ecu.Ecu):
    """Is late by 16 samples: the counter of its samples comes round in this time."""

    def __init__(self):
        super().__init__()
        self.held, self.sent = [], 0

    def answer(self, of):
        self.held.append(super().answer(of))
        if len(self.held) <= 16:
            return None
        frame = self.held.pop(0)[:6] + bytes([self.sent % 16])
        self.sent += 1
        return frame + bytes([own_ecu.crc(frame)])


class Sparse(own_ecu.Ecu):
    """Answers every second sample."""

    def __init__(self):
        super().__init__()
        self.samples = 0

    def answer(self, of):
        self.samples += 1
        return super().answer(of) if self.samples % 2 == 0 else None


class Redundant(own_ecu.Ecu):
    """Answers the last frame of each sample, also if the others did not come: then it uses the newest ones that came."""

    def receive(self, identifier, data):
        for one in own_ecu.IMU[:2] if identifier == own_ecu.IMU[2] and len(self.parts) == 3 else ():
            self.parts[one] = self.parts[one][:6] + data[6:7] + self.parts[one][7:]
        return super().receive(identifier, data)


def serve(ecu, bus, status):
    """Answers samples; sends the status only if `status` is set, and only after the first sample."""
    due = time.monotonic()
    while (received := bus.receive()) is not None:
        answer = ecu.receive(*received[:2])
        if answer is not None:
            bus.send(own_ecu.ATTITUDE, answer)
        if status and time.monotonic() >= due:
            due = time.monotonic() + own_ecu.STATUS_S
            bus.send(own_ecu.STATUS, bytes([1, 65]))


DEFECTS = {"none": own_ecu.Ecu, "wrong_sign": WrongSign, "stale": Stale, "wrong_checksum": WrongChecksum,
           "frozen_counter": FrozenCounter, "slow": Slow, "silent": Silent, "zero": Zero, "late_heading": LateHeading,
           "round_late": RoundLate, "sparse": Sparse, "redundant": Redundant}

if __name__ == "__main__":
    if "--answers" in sys.argv:
        own_ecu.ATTITUDE = int(sys.argv[sys.argv.index("--answers") + 1], 0)
        own_ecu.STATUS = own_ecu.ATTITUDE + 1
    if sys.argv[1] in ("answers_only", "status_after_sample"):
        serve(own_ecu.Ecu(), open_bus(sys.argv[sys.argv.index("--bus") + 1]), sys.argv[1] == "status_after_sample")
        sys.exit()
    own_ecu.serve(DEFECTS[sys.argv[1]](), open_bus(sys.argv[sys.argv.index("--bus") + 1]))
