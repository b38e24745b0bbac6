"""A magnetometer of one's own: [magnetometer] command = "python3 magnetometer.py" (docs/programs.md).

The earth's field in the axes of the body, with a hard iron and noise; and the magnetic heading of a compass with an ideal level.
"""
import math
import random
import sys
from pathlib import Path

try:
    from canhil import partner  # the package, if it is installed
except ImportError:
    sys.path.append(str(Path(__file__).resolve().parents[3] / "python/canhil"))  # its file in a clone
    import partner

FIELD, INCLINATION, DECLINATION = 48e-6, math.radians(63), math.radians(3)  # T, rad, rad


class Magnetometer:
    inputs = {"attitude.roll": "rad", "attitude.pitch": "rad", "attitude.heading": "rad"}
    outputs = {"field_x": "T", "field_y": "T", "field_z": "T", "heading": "rad"}

    def __init__(self, noise_ut=0.3, hard_iron_ut=0.2):
        self.noise = noise_ut * 1e-6
        self.hard_iron = [random.gauss(0, hard_iron_ut * 1e-6) for _ in range(3)]

    def measure(self, t, truth):
        roll, pitch, heading = truth.values()
        magnetic = heading - DECLINATION
        ahead, down = FIELD * math.cos(INCLINATION), FIELD * math.sin(INCLINATION)
        x, y = ahead * math.cos(magnetic), -ahead * math.sin(magnetic)  # along and across the heading, level
        x, z = x * math.cos(pitch) - down * math.sin(pitch), x * math.sin(pitch) + down * math.cos(pitch)
        y, z = y * math.cos(roll) + z * math.sin(roll), z * math.cos(roll) - y * math.sin(roll)
        field = [true + iron + random.gauss(0, self.noise) for true, iron in zip((x, y, z), self.hard_iron)]
        return [*field, math.remainder(magnetic, 2 * math.pi)]


partner.serve(Magnetometer)
