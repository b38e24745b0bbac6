"""An odometer with a DBC of its own, odometer.dbc, that diagnostics (UDS) configure. It is independent of hil-bench.

    hil-bench run docs/examples/odometer/odometer.toml --target 'python3 docs/examples/odometer/odometer.py'

--defect NAME: the odometer has a defect, which the bench must find (DEFECTS).
"""
import math
import struct
import sys
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1] / "kit"))
from device import serve

PULSES, MOTION, REQUEST, RESPONSE = 0x130, 0x210, 0x7A0, 0x7A8
DEFECTS = ("none", "own_measures", "no_code", "lost_frame", "keeps_code", "knows_all")
TROUBLE, CONFIRMED, SUPPORTED = bytes.fromhex("501300"), 0x08, 0x09  # C1013-00; bits of the status of a trouble code
SERIAL = b"ODO-2026-000417"


class IsoTp:
    """Messages of diagnostics in frames of 8 bytes (ISO 15765-2)."""

    def __init__(self):
        self.message, self.size, self.rest = b"", 0, []

    def take(self, frame):
        """Takes a frame. Returns the message that it completes, otherwise None, and the frames to send at once."""
        kind, low = frame[0] >> 4, frame[0] & 15
        if kind == 0:
            return frame[1:1 + low], []
        if kind == 1:
            self.message, self.size = frame[2:], low << 8 | frame[1]
            return None, [bytes([0x30, 2, 0])]  # flow control: two frames, as fast as possible
        if kind == 2:
            self.message += frame[1:]
            if len(self.message) >= self.size:
                return self.message[:self.size], []
            return None, [bytes([0x30, 2, 0])] if low % 2 == 0 else []
        rest, self.rest = self.rest, []  # flow control of the tester: everything that is left
        return None, rest

    def split(self, message):
        """Returns the frames to send at once. Flow control calls for the others."""
        if len(message) < 8:
            return [bytes([len(message)]) + message]
        parts = [message[at:at + 7] for at in range(6, len(message), 7)]
        self.rest = [bytes([0x20 | (i + 1) & 15]) + part for i, part in enumerate(parts)]
        return [struct.pack(">H", 0x1000 | len(message)) + message[:6]]


class Odometer:
    def __init__(self, defect):
        self.defect, self.measures, self.doubted, self.doubts, self.code = defect, None, False, 0, False
        self.transport = IsoTp()

    def receive(self, identifier, data):
        """Takes a frame. Yields the frames that answer it."""
        if identifier == REQUEST:
            request, frames = self.transport.take(data)
            if request is not None:
                frames = self.transport.split(self.diagnose(request))
            for frame in frames:
                if not (self.defect == "lost_frame" and frame[0] == 0x22):
                    yield RESPONSE, frame.ljust(8, b"\xcc")
        elif identifier == PULSES and self.measures is not None:
            yield MOTION, self.motion(data)

    def diagnose(self, request):
        """Answers a request of UDS (ISO 14229-1)."""
        service = request[0]
        if service == 0x10:
            return bytes([0x50, request[1]]) + bytes.fromhex("003201F4")
        if service == 0x2E and request[1:3] == b"\x01\x01" and len(request) == 11:
            self.measures = struct.unpack(">4H", request[3:])
            if self.defect == "own_measures":
                self.measures = 2100, *self.measures[1:]
            return b"\x6e\x01\x01"
        if service == 0x22 and request[1:] == b"\xf1\x8c":
            return b"\x62\xf1\x8c" + SERIAL
        if service == 0x22:
            return b"\x62" + request[1:] + b"\x00" if self.defect == "knows_all" else b"\x7f\x22\x31"
        if service == 0x19 and request[1] == 2:
            return bytes([0x59, 2, SUPPORTED]) + (TROUBLE + bytes([CONFIRMED]) if self.code else b"")
        if service == 0x14:
            self.code = self.code and self.defect == "keeps_code"
            return b"\x54"
        return bytes([0x7F, service, 0x11])

    def motion(self, data):
        word = int.from_bytes(data, "little")
        circumference, track, wheelbase, pulses = (one / 1000 for one in self.measures)
        front_left, front_right, left, right = (0.25 * (word >> 14 * i & 0x3FFF) * circumference / (1000 * pulses) for i in range(4))
        # Both axles turn at the same rate, so left and right differ by the same speed.
        off = abs((front_left - front_right) - (left - right)) > 1.0
        self.doubts = self.doubts + 1 if off != self.doubted else 0
        if self.doubts > 10:
            self.doubted, self.doubts = off, 0
            self.code = self.code or (off and self.defect != "no_code")
        if self.doubted:  # by the front axle, which turns about the middle of the rear axle
            rate = (front_left - front_right) / track
            speed = math.sqrt(max(0.0, ((front_left + front_right) / 2) ** 2 - (wheelbase * rate) ** 2))
        else:
            speed, rate = (left + right) / 2, (left - right) / track
        status = 2 if self.doubted else 1
        return struct.pack("<HhBB", round(speed * 100), round(math.degrees(rate) * 100), data[7], status)


if __name__ == "__main__":
    serve(Odometer, DEFECTS)
