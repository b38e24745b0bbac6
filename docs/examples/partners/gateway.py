"""A gateway: repeats the height of NAV_State for a display, twice a second, on an id of its own (docs/programs.md)."""
import struct
import sys
from pathlib import Path

try:
    from canhil import partner  # the package, if it is installed
except ImportError:
    sys.path.append(str(Path(__file__).resolve().parents[3] / "python/canhil"))  # its file in a clone
    import partner


class Gateway:
    period = 0.5
    hears = ["NAV_State"]

    def step(self, bench):
        if bench.heard:
            newest = bench.heard[-1].values
            bench.frame("5A0#" + struct.pack(">if", round(bench.t * 1000), newest["NAV_Height"]).hex())


partner.serve(Gateway)
