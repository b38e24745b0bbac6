"""The navigation computer of an AUV with a DBC of its own, auv.dbc. It is independent of hil-bench.

    hil-bench run docs/examples/auv/auv.toml --target 'python3 docs/examples/auv/auv.py'

--defect NAME: the computer has a defect, which the bench must find (DEFECTS).
"""
import math
import struct
import sys
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1] / "kit"))
from device import serve

RATES, FORCE, DVL, DEPTH, COMPASS, RELATIVE, SHIP, GPS = 0x80, 0x81, 0x90, 0xA0, 0xA1, 0xB0, 0xB1, 0xC0
ATTITUDE, VELOCITY, POSITION, HEIGHT = 0x200, 0x201, 0x202, 0x203
DT, EVERY, DECLINATION, EARTH, NONE = 0.02, 5, math.radians(5), 6_378_137.0, -2**31
SSBL_LATENCY, WITHOUT_DVL = 5, 20  # samples
DEFECTS = ("none", "dvl_backwards", "inverse_quaternion", "no_declination", "depth_upwards", "says_dvl")


def product(p, q):
    """The quaternion of the rotation q followed by the rotation p."""
    return (p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3], p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
            p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1], p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0])


def turned(q, v):
    """A vector in body axes as one in north, east, down."""
    return product(product(q, (0.0, *v)), (q[0], -q[1], -q[2], -q[3]))[1:]


def small(angles):
    return (1.0, *(one / 2 for one in angles))


class Navigation:
    def __init__(self, defect):
        self.defect, self.samples, self.rates, self.dvl_at = defect, 0, None, -10**9
        self.q, self.velocity, self.position, self.depth, self.compass = None, (0.0, 0.0, 0.0), None, 0.0, None
        self.relative, self.past = None, []

    def receive(self, identifier, data):
        """Takes a frame. Yields the frames that answer it."""
        if identifier == RATES:
            *rates, count = struct.unpack("<hhhH", data)
            self.rates = [one * 2**-14 for one in rates], count
        elif identifier == FORCE:
            *force, count = struct.unpack("<hhhH", data)
            if self.rates is not None and self.rates[1] == count:
                self.step(self.rates[0], [one * 2**-11 for one in force])
                yield from self.answers(count & 0xFF)
        elif identifier == DVL:
            x, y, z, lock = struct.unpack("<hhhB", data)
            if lock and self.q is not None:
                self.velocity, self.dvl_at = turned(self.q, (x * (-1e-3 if self.defect == "dvl_backwards" else 1e-3), y * 1e-3, z * 1e-3)), self.samples
        elif identifier == DEPTH:
            self.depth = struct.unpack("<i", data)[0] * 1e-3
        elif identifier == COMPASS:
            magnetic = math.radians(struct.unpack("<H", data)[0] / 100)
            self.compass = magnetic + (0.0 if self.defect == "no_declination" else DECLINATION)
        elif identifier == RELATIVE:
            self.relative = struct.unpack("<ii", data)
        elif identifier == SHIP and self.relative is not None and self.relative[0] != NONE:
            latitude, longitude = (math.radians(one * 1e-7) for one in struct.unpack("<ii", data))
            north, east = (one * 0.01 for one in self.relative)
            self.fix(latitude + north / EARTH, longitude + east / EARTH / math.cos(latitude), SSBL_LATENCY)
        elif identifier == GPS:
            latitude, longitude = struct.unpack("<ii", data)
            if latitude != NONE:
                self.fix(math.radians(latitude * 1e-7), math.radians(longitude * 1e-7), 0)

    def step(self, rates, force):
        self.samples += 1
        if self.q is None:
            if self.compass is not None:
                self.q = (math.cos(self.compass / 2), 0.0, 0.0, math.sin(self.compass / 2))
            return
        q = product(self.q, small([one * DT for one in rates]))
        # Levelled by the specific force, which points upwards in the mean; the heading follows the compass.
        north, east, down = turned(q, force)
        heading = math.atan2(2 * (q[0] * q[3] + q[1] * q[2]), 1 - 2 * (q[2] ** 2 + q[3] ** 2))
        gain = 1.0 if self.samples < 100 else 0.05
        q = product(small((-gain * DT * east / 9.81, gain * DT * north / 9.81, 2 * gain * DT * math.remainder(self.compass - heading, 2 * math.pi))), q)
        size = math.sqrt(sum(one * one for one in q))
        self.q = tuple(one / size for one in q)
        if self.position is not None:
            latitude, longitude = self.position
            self.position = (latitude + self.velocity[0] * DT / EARTH, longitude + self.velocity[1] * DT / EARTH / math.cos(latitude))
            self.past = self.past[-SSBL_LATENCY:] + [self.position]

    def fix(self, latitude, longitude, samples):
        if self.position is None or len(self.past) <= samples:
            self.position = latitude, longitude
            return
        then = self.past[-1 - samples]
        self.position = (self.position[0] + 0.2 * (latitude - then[0]), self.position[1] + 0.2 * (longitude - then[1]))

    def answers(self, count):
        w, x, y, z = self.q or (1.0, 0.0, 0.0, 0.0)
        if self.defect == "inverse_quaternion":
            x, y, z = -x, -y, -z
        word = sum((max(-8192, min(8191, round(one * 8192))) & 0x3FFF) << 14 * i for i, one in enumerate((w, x, y, z)))
        yield ATTITUDE, (word | count << 56).to_bytes(8, "little")
        if self.samples % EVERY or self.position is None:
            return
        with_dvl = self.samples - self.dvl_at < WITHOUT_DVL or self.defect == "says_dvl"
        yield VELOCITY, struct.pack("<hhhB", *(round(one * 1000) for one in self.velocity), 1 if with_dvl else 2)
        yield POSITION, struct.pack("<ii", *(round(math.degrees(one) * 1e7) for one in self.position))
        yield HEIGHT, struct.pack("<i", round(self.depth * (1000 if self.defect == "depth_upwards" else -1000)))


if __name__ == "__main__":
    serve(Navigation, DEFECTS)
