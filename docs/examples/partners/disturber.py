"""A node that disturbs: in turns above 15 deg of roll it floods the bus for 50 ms, and spoils the first IMU (docs/programs.md)."""
import math
import sys
from pathlib import Path

try:
    from canhil import partner  # the package, if it is installed
except ImportError:
    sys.path.append(str(Path(__file__).resolve().parents[3] / "python/canhil"))  # its file in a clone
    import partner


class Disturber:
    period = 0.005
    truth = ["attitude.roll"]

    def __init__(self, fault, for_s=0.05):
        self.fault, self.for_s, self.since = fault, for_s, None

    def step(self, bench):
        turns = abs(bench.truth["attitude.roll"]) > math.radians(15)
        if not turns:
            self.since = None
        elif self.since is None:
            self.since = bench.t
            bench.begin(self.fault)
        if turns and bench.t < self.since + self.for_s:
            bench.frame("001#DEADBEEF")
        elif turns:
            bench.end(self.fault)


partner.serve(Disturber)
