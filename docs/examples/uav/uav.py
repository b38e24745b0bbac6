"""The navigation computer of a UAV on CAN FD (uav.dbc): attitude and height, with two IMUs. It is independent of hil-bench.

    hil-bench run docs/examples/uav/uav.toml --target 'python3 docs/examples/uav/uav.py'

--defect NAME: the computer has a defect, which the bench must find (DEFECTS).
"""
import math
import struct
import sys
from binascii import crc_hqx
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1] / "kit"))
from device import serve

IMU_A, IMU_B, FIELD, AIR, STATE = 0x110, 0x111, 0x120, 0x121, 0x200
DATA_IDS = {IMU_A: 0x1A01, IMU_B: 0x1A02, FIELD: 0x1A03, AIR: 0x1A04, STATE: 0x1B01}
LAYOUTS = {IMU_A: "<I6i", IMU_B: "<I6h"}  # time, rates, specific force
SCALES = {IMU_A: (math.radians(0.025 / 2**16), 0.00245 / 2**16), IMU_B: (math.radians(500 / 2**15), 12 * 9.80665 / 2**15)}  # rad/s, m/s^2
DT, GRAVITY, DECLINATION, ALIGNING, LATE = 0.01, 9.81, math.radians(3), 150, 10  # ALIGNING, LATE: samples
APART = math.radians(3), 1.5  # rad/s, m/s^2: the IMUs disagree. The more doubtful one is then excluded, if its doubt is greater by DOUBT,
DOUBT, AGREEING = math.radians(1), 100  # until both have agreed for so many samples.
DEFECTS = ("none", "never_excludes", "excludes_the_other", "inverse_quaternion", "late", "ignores_qnh", "counter_stuck")


def crc(identifier, data):
    """AUTOSAR E2E profile 5: the CRC-16 of all bytes after the CRC, and of the data id."""
    return crc_hqx(data[2:] + struct.pack("<H", DATA_IDS[identifier]), 0xFFFF)


def product(p, q):
    """The quaternion of the rotation q followed by the rotation p."""
    return (p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3], p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
            p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1], p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0])


def inverse(q):
    return (q[0], -q[1], -q[2], -q[3])


def turned(q, v):
    """A vector in body axes as one in north, east, down."""
    return product(product(q, (0.0, *v)), inverse(q))[1:]


def small(angles):
    return (1.0, *(one / 2 for one in angles))


def unit(q):
    return tuple(one / math.hypot(*q) for one in q)


def smoothed(old, new, share):
    return tuple(before + share * (now - before) for before, now in zip(old, new))


class Imu:
    """An IMU and the attitude by it alone: its rates, corrected slowly by gravity and by the earth's field."""

    def __init__(self):
        self.q, self.time_us, self.rates, self.force, self.out = (1.0, 0.0, 0.0, 0.0), None, None, None, False
        self.lately = self.usually = (0.0, 0.0, 0.0)

    def step(self, field, speed, samples):
        q = product(self.q, small([one * DT for one in self.rates]))
        # Without the acceleration of turns, the specific force points upwards. The heading follows the earth's field.
        x, y, z = self.force
        north, east, _ = turned(q, (x, y - speed * self.rates[2], z + speed * self.rates[1]))
        field_north, field_east, _ = turned(q, field)
        off = (-east / GRAVITY, north / GRAVITY, math.remainder(DECLINATION - math.atan2(field_east, field_north), 2 * math.pi))
        self.q = unit(product(small([max(0.05 * DT, 1 / samples) * one for one in off]), q))
        self.lately = smoothed(self.lately, off, 0.1)
        self.usually = smoothed(self.usually, self.lately, 1 if samples < ALIGNING else 0.002)
        self.doubt = math.dist(self.lately, self.usually)  # the attitude departs from gravity and field, more than usually


class Navigation:
    def __init__(self, defect):
        self.defect, self.samples, self.counter, self.agreeing, self.past = defect, 0, 0, 0, []
        self.a, self.b, self.field, self.speed, self.height, self.climb = Imu(), Imu(), None, None, math.nan, 0.0
        self.rates_apart = self.force_apart = (0.0, 0.0, 0.0)

    def receive(self, identifier, data):
        """Takes a frame. Yields the frames that answer it."""
        if identifier not in DATA_IDS or struct.unpack_from("<H", data)[0] != crc(identifier, data):
            return
        if identifier in LAYOUTS:
            imu = self.a if identifier == IMU_A else self.b
            imu.time_us, *values = struct.unpack_from(LAYOUTS[identifier], data, 4)
            imu.rates, imu.force = ([one * scale for one in part] for part, scale in zip((values[:3], values[3:]), SCALES[identifier]))
            if self.a.time_us == self.b.time_us:  # both have measured
                self.step()
                yield STATE, self.state(imu.time_us)
        elif identifier == FIELD:
            self.field = struct.unpack_from("<hhh", data, 4)
        elif identifier == AIR:
            low, high, speed, qnh = struct.unpack_from("<HBHH", data, 3)
            self.speed = speed * 0.01
            self.air((high << 16 | low) / 64, 101325 if self.defect == "ignores_qnh" else qnh * 10)

    def step(self):
        if self.field is None or self.speed is None:
            return
        self.samples += 1
        for imu in (self.a, self.b):
            imu.step(self.field, self.speed, self.samples)
        self.vote()
        self.climb -= (turned(self.attitude(), self.used("force"))[2] + GRAVITY) * DT
        self.height += self.climb * DT

    def vote(self):
        self.rates_apart = smoothed(self.rates_apart, [a - b for a, b in zip(self.a.rates, self.b.rates)], 0.1)
        self.force_apart = smoothed(self.force_apart, [a - b for a, b in zip(self.a.force, self.b.force)], 0.1)
        apart = math.hypot(*self.rates_apart) > APART[0] or math.hypot(*self.force_apart) > APART[1]
        self.agreeing = 0 if apart else self.agreeing + 1
        if apart and not (self.a.out or self.b.out) and self.defect != "never_excludes":
            more = self.a.doubt - self.b.doubt
            (self.a if (more > 0) != (self.defect == "excludes_the_other") else self.b).out = abs(more) > DOUBT
        for imu, other in ((self.a, self.b), (self.b, self.a)):
            if imu.out:  # it follows the other one, so that it can be used again
                imu.q, imu.lately, imu.usually, imu.out = other.q, other.lately, other.usually, self.agreeing < AGREEING

    def used(self, what):
        return [sum(one) / len(one) for one in zip(*(getattr(imu, what) for imu in (self.a, self.b) if not imu.out))]

    def attitude(self):
        return unit(self.used("q"))

    def air(self, pressure, sea_level):
        """Corrects height and climb rate by the standard atmosphere (ISO 2533)."""
        by_pressure = 288.15 / 0.0065 * (1 - (pressure / sea_level) ** 0.190263)
        off = 0.0 if math.isnan(self.height) else by_pressure - self.height
        self.height, self.climb = by_pressure - 0.9 * off, self.climb + 0.1 * off

    def state(self, time_us):
        q = inverse(self.attitude()) if self.defect == "inverse_quaternion" else self.attitude()
        self.past = self.past[-LATE:] + [(*q, *self.used("rates"), *self.used("force"), self.height, self.climb)]
        word = (self.samples >= ALIGNING) | self.a.out << 1 | self.b.out << 2
        frame = struct.pack("<HBBI12f8x", 0, self.counter, word, time_us, *self.past[0 if self.defect == "late" else -1])
        self.counter = (self.counter + (self.defect != "counter_stuck")) % 256
        return struct.pack("<H", crc(STATE, frame)) + frame[2:]


if __name__ == "__main__":
    serve(Navigation, DEFECTS, fd=True)
