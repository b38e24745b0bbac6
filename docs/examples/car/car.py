"""An INS of a car with a DBC of its own, car.dbc. It is independent of hil-bench.

    hil-bench run docs/examples/car/car.toml --target 'python3 docs/examples/car/car.py'

--defect NAME: the INS has a defect, which the bench must find (DEFECTS).
"""
import math
import struct
import sys
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1] / "kit"))
from device import serve

IMU_RATES, IMU_ACCEL, GNSS_POSITION, GNSS_VELOCITY, WHEELS, STEERING = 0x100, 0x101, 0x120, 0x121, 0x130, 0x140
ATTITUDE, VELOCITY, POSITION, STATUS = 0x200, 0x201, 0x202, 0x203
DT, EVERY, GRAVITY, WHEELBASE, STEERING_RATIO, EARTH = 0.01, 5, 9.81, 2.7, 15.0, 6_378_137.0
GNSS_LATENCY = 8  # samples of the IMU
DEFECTS = ("none", "yaw_sign", "wheels_in_kmph", "late", "no_flag", "course_as_signed")


def crc(data):
    """CRC-8/SAE-J1850."""
    value = 0xFF
    for byte in data:
        value ^= byte
        for _ in range(8):
            value = (value << 1 ^ 0x1D if value & 0x80 else value << 1) & 0xFF
    return value ^ 0xFF


def turn(angle):
    """An angle in 0..360 deg as a raw value of 0.01 deg."""
    return round(math.degrees(angle) * 100) % 36000


class Ins:
    """Dead reckoning with the yaw rate and the wheels, corrected by GNSS. Axes: forward, right, down."""

    def __init__(self, defect):
        self.defect, self.samples, self.rates, self.speed, self.steering = defect, 0, None, None, 0.0
        self.roll = self.pitch = self.yaw_rate = 0.0
        self.heading = self.position = None
        self.past, self.gnss_at, self.implausible, self.doubts = [], -10**9, False, 0

    def receive(self, identifier, data):
        """Takes a frame. Yields the frames that answer it."""
        if identifier in (IMU_RATES, IMU_ACCEL) and crc(data[:7]) != data[7]:
            return
        if identifier == IMU_RATES:
            x, y, z, counter = struct.unpack("<hhhB", data[:7])
            self.rates = tuple(math.radians(one / 128) for one in (x, -y, -z)), counter
        elif identifier == IMU_ACCEL:
            x, y, z, counter = struct.unpack("<hhhB", data[:7])
            if self.rates is not None and self.rates[1] == counter:
                self.step(self.rates[0], tuple(one / 512 for one in (x, -y, -z)))
                yield from self.answers(counter)
        elif identifier == WHEELS:
            scale = 64 * (1 if self.defect == "wheels_in_kmph" else 3.6)
            self.speed = sum(struct.unpack("<HHHH", data)[2:]) / 2 / scale
        elif identifier == STEERING:
            self.steering = -math.radians(struct.unpack("<h", data)[0] / 10) / STEERING_RATIO
        elif identifier == GNSS_POSITION:
            self.fix(*(math.radians(one * 1e-7) for one in struct.unpack("<ii", data)))
        elif identifier == GNSS_VELOCITY:
            speed, course, fix_type = struct.unpack("<HHB", data[:5])
            if fix_type == 3 and speed > 200:
                self.course(math.radians(course / 100))

    def step(self, rates, force):
        self.samples += 1
        speed = self.speed or 0.0
        by_steering = speed * math.tan(self.steering) / WHEELBASE
        off = abs(rates[2] - by_steering) > math.radians(4)
        self.doubts = self.doubts + 1 if off != self.implausible else 0
        if self.doubts > 20:  # the difference has been outside, or inside again, for 0.2 s
            self.implausible, self.doubts = off, 0
        self.yaw_rate = by_steering if self.implausible else rates[2]
        share = DT / 10.0
        level = math.asin(max(-1.0, min(1.0, (speed * self.yaw_rate - force[1]) / GRAVITY)))
        self.roll += rates[0] * DT + share * (level - self.roll)
        self.pitch += rates[1] * DT + share * (math.asin(max(-1.0, min(1.0, force[0] / GRAVITY))) - self.pitch)
        if self.heading is None:
            return
        self.heading += (-1 if self.defect == "yaw_sign" else 1) * self.yaw_rate * DT
        if self.position is not None:
            latitude, longitude = self.position
            self.position = (latitude + speed * math.cos(self.heading) * DT / EARTH,
                             longitude + speed * math.sin(self.heading) * DT / EARTH / math.cos(latitude))
        self.past = self.past[-GNSS_LATENCY:] + [(self.heading, self.position)]

    def course(self, course):
        """The car does not slip, so its heading is the course."""
        if self.heading is None:
            self.heading = course
        if self.past:
            self.heading += 0.15 * math.remainder(course - self.past[0][0], 2 * math.pi)

    def fix(self, latitude, longitude):
        self.gnss_at = self.samples
        if self.position is None or not self.past or self.past[0][1] is None:
            self.position = latitude, longitude
            return
        then = self.past[0][1]
        self.position = (self.position[0] + 0.1 * (latitude - then[0]), self.position[1] + 0.1 * (longitude - then[1]))

    def answers(self, counter):
        heading = self.heading or 0.0
        if self.defect == "late":
            heading = self.past[0][0] if self.past else 0.0
        roll, pitch = (round(math.degrees(one) * 100) for one in (self.roll, -self.pitch))
        frame = struct.pack("<hhHB", roll, pitch, turn(heading), counter)
        yield ATTITUDE, frame + bytes([crc(frame)])
        if self.samples % EVERY or self.heading is None:
            return
        north, east = (round(100 * (self.speed or 0.0) * of(self.heading)) for of in (math.cos, math.sin))
        course = turn(self.heading) if self.defect != "course_as_signed" else turn(self.heading) // 2
        bend = round(self.yaw_rate / max(self.speed or 0.0, 1.0) * 1e5)
        yield VELOCITY, struct.pack("<hhHh", north, east, course, bend)
        if self.position is not None:
            yield POSITION, struct.pack("<ii", *(round(math.degrees(one) * 1e7) for one in self.position))
        used = self.samples - self.gnss_at < 100
        word = used | (self.implausible and self.defect != "no_flag") << 1
        yield STATUS, struct.pack("<HB", word, self.samples > 200)


if __name__ == "__main__":
    serve(Ins, DEFECTS)
