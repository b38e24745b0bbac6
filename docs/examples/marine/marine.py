"""A ship's navigator on NMEA 2000 (marine.dbc): heading and position. It is independent of hil-bench.

    hil-bench run docs/examples/marine/marine.toml --target 'python3 docs/examples/marine/marine.py'

--defect NAME: the navigator has a defect, which the bench must find (DEFECTS).
"""
import math
import struct
import sys
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1] / "kit"))
from canhil_target import EXTENDED
from device import serve

RATE, COURSE, GNSS, HEADING, POSITION = (EXTENDED | one for one in (0x09F11323, 0x09F80222, 0x0DF80522, 0x09F11224, 0x0DF80524))
DT, EARTH, OUTAGE = 0.1, 6_378_137.0, 20  # OUTAGE: samples without a position until the position counts as estimated
GNSS_LATENCY = 1  # samples
DEFECTS = ("none", "turns_left", "latitude_in_radians", "lost_frame", "never_estimated", "wrong_sid")


class FastPacket:
    """Puts the frames of a fast packet together, and splits a message into frames."""

    def __init__(self):
        self.data, self.size, self.next, self.sequence = b"", 0, 0, 0

    def take(self, frame):
        """Returns the message that a frame completes, otherwise None."""
        sequence, number = frame[0] >> 5, frame[0] & 31
        if number == 0:
            self.data, self.size, self.next, self.sequence = frame[2:], frame[1], 1, sequence
            return None
        if number != self.next or sequence != self.sequence:
            self.next = -1
            return None
        self.data, self.next = self.data + frame[1:], number + 1
        return self.data[:self.size] if len(self.data) >= self.size else None

    def split(self, message):
        self.sequence = (self.sequence + 1) % 8
        parts = [bytes([len(message)]) + message[:6]] + [message[at:at + 7] for at in range(6, len(message), 7)]
        return [bytes([self.sequence << 5 | i]) + part.ljust(7, b"\xff") for i, part in enumerate(parts)]


class Navigator:
    def __init__(self, defect):
        self.defect, self.samples, self.gnss_at, self.speed = defect, 0, -10**9, 0.0
        self.heading = self.position = None
        self.past, self.gnss, self.out = [], FastPacket(), FastPacket()

    def receive(self, identifier, data):
        """Takes a frame. Yields the frames that answer it."""
        if identifier == RATE:
            sid, rate = struct.unpack("<Bi", data)
            self.step(rate / 32e6)
            yield from self.answers(sid)
        elif identifier == COURSE:
            course, speed = struct.unpack("<HH", data[2:6])
            self.course(course * 1e-4, speed * 0.01)
        elif identifier == GNSS:
            message = self.gnss.take(data)
            if message is not None:
                self.fix(*(math.radians(one * 1e-16) for one in struct.unpack("<qq", message[7:23])))

    def step(self, rate):
        self.samples += 1
        if self.heading is None:
            return
        self.heading += DT * (-rate if self.defect == "turns_left" else rate)
        if self.position is not None:
            latitude, longitude = self.position
            way = self.speed * DT / EARTH
            self.position = (latitude + way * math.cos(self.heading), longitude + way * math.sin(self.heading) / math.cos(latitude))
        self.past = self.past[-GNSS_LATENCY:] + [(self.heading, self.position)]

    def course(self, course, speed):
        """The ship does not drift, so its heading is the course."""
        self.speed = speed
        if self.heading is None:
            self.heading = course
        elif self.past:
            self.heading += 0.1 * math.remainder(course - self.past[0][0], 2 * math.pi)

    def fix(self, latitude, longitude):
        self.gnss_at = self.samples
        then = self.past[0][1] if self.past else None
        if self.position is None or then is None:
            self.position = latitude, longitude
        else:
            self.position = tuple(now + 0.3 * (seen - old) for now, seen, old in zip(self.position, (latitude, longitude), then))

    def answers(self, sid):
        heading = 0xFFFF if self.heading is None else round((self.heading % (2 * math.pi)) * 1e4) % 62832
        yield HEADING, struct.pack("<BHhhB", (sid + 3) % 253 if self.defect == "wrong_sid" else sid, heading, 0x7FFF, 0x7FFF, 0xFC)
        if self.samples % 10 or self.position is None:
            return
        unit = 1.0 if self.defect == "latitude_in_radians" else 180 / math.pi
        estimated = self.samples - self.gnss_at > OUTAGE and self.defect != "never_estimated"
        latitude, longitude = (round(one * unit * 1e16) for one in self.position)
        message = bytes([sid]) + bytes(6) + struct.pack("<qq", latitude, longitude) + bytes(8) + bytes([(6 if estimated else 1) << 4]) + bytes(11)
        for number, frame in enumerate(self.out.split(message)):
            if not (self.defect == "lost_frame" and number == 3 and self.samples % 100 == 0):
                yield POSITION, frame


if __name__ == "__main__":
    serve(Navigator, DEFECTS)
