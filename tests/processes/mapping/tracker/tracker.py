"""A tracker with a DBC of its own, tracker.dbc: tracker.py [zero | mirrored | late] --bus BUS."""
import sys
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[4] / "docs/examples/kit"))
from canhil_target import open_bus

ANGLES, RATES, PITCH, YAW = 0x120, 0x121, 0x130, 0x131
DT, ALPHA, BETA = 0.005, 0.1, 0.006


def signed(data, at):
    return int.from_bytes(data[at:at + 2], "little", signed=True)


class Tracker:
    """An alpha-beta filter for each plane: the LOS rate is the antenna's rate and the rate of the error angle."""

    def __init__(self, defect):
        self.defect, self.angles, self.past = defect, None, []
        self.planes = [[0.0, 0.0], [0.0, 0.0]]  # error angle and its rate

    def receive(self, identifier, data):
        if identifier == ANGLES:
            self.angles = data
        if identifier != RATES or self.angles is None:
            return []
        rates = []
        for plane, state in enumerate(self.planes):
            state[0] += state[1] * DT
            if self.angles[5] & 1:
                residual = signed(self.angles, 2 * plane) * 1e-5 - state[0]
                state[0] += ALPHA * residual
                state[1] += BETA / DT * residual
            rates.append(state[1] + signed(data, 2 * plane) * 1e-4)
        if self.defect == "zero":
            rates = [0, 0]
        if self.defect == "mirrored":
            rates[1] = -rates[1]
        self.past = (self.past + [rates])[-80:]
        if self.defect == "late":
            rates = self.past[0]
        return [(identifier, round(rate * 1e6).to_bytes(3, "little", signed=True) + data[4:5])
                for identifier, rate in zip((PITCH, YAW), rates)]


if __name__ == "__main__":
    bus = open_bus(sys.argv[sys.argv.index("--bus") + 1])
    tracker = Tracker(sys.argv[1])
    while (received := bus.receive()) is not None:
        for answer in tracker.receive(*received[:2]):
            bus.send(*answer)
