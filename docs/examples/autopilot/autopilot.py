"""An autopilot with a DBC of its own, autopilot.dbc: it holds a heading by a rudder. It is independent of hil-bench.

    hil-bench run docs/examples/autopilot/autopilot.toml --target 'python3 docs/examples/autopilot/autopilot.py'

--defect NAME: the autopilot has a defect, which the bench must find (DEFECTS). 'no_fault' shows only where the rudder does not follow, as with actuator_stop_deg = 3.
"""
import math
import struct
import sys
from collections import deque
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1] / "kit"))
from device import serve

HEADING, RUDDER, COMMAND, STEERED = 0x100, 0x110, 0x200, 0x201
DEFECTS = ("none", "old_heading", "late", "wrong_sign", "stuck", "no_integral", "no_fault")
COURSE, STOP, PERIOD = 20.0, 30.0, 0.02  # deg, deg, s
GAIN, DAMPING, INTEGRAL, NEAR = 6.0, 0.8, 1.0, 8.0  # rudder per error, per turn rate [s], per integral of the error [1/s]; deg
FAULT, PATIENCE = 10.0, 50  # the rudder is this far from its command [deg] for so many periods: it does not follow


def crc(data):
    """CRC-8/SAE-J1850."""
    value = 0xFF
    for byte in data:
        value ^= byte
        for _ in range(8):
            value = (value << 1 ^ 0x1D) & 0xFF if value & 0x80 else value << 1
    return value ^ 0xFF


class Autopilot:
    def __init__(self, defect):
        self.defect, self.integral, self.command, self.periods = defect, 0.0, 0.0, 0
        self.measured, self.feedback, self.misses = deque(maxlen=4), 0.0, 0
        self.held = deque([], 3) if defect == "late" else None

    def receive(self, identifier, data):
        """Takes a frame. Yields the frames that answer it."""
        if identifier == RUDDER:
            self.feedback = struct.unpack("<h", data)[0] / 100
        if identifier != HEADING:
            return
        heading, rate, counter = struct.unpack("<HhB", data[:5])
        self.measured.append((heading / 100, rate / 100))
        self.periods += 1
        if not (self.defect == "stuck" and self.periods > 400):
            self.command = self.steer(*self.measured[0 if self.defect == "old_heading" else -1])
        off = abs(self.feedback - self.command) > FAULT and self.defect != "no_fault"
        self.misses = self.misses + 1 if off else 0
        yield STEERED, struct.pack("<HB", round(self.measured[-1][0] * 100) % 36000, counter)
        status = 1 | (2 if self.misses > PATIENCE else 0)
        frame = struct.pack("<hBB", round(self.command * 100), status, counter)
        frame += bytes([crc(frame)])
        if self.held is None:
            yield COMMAND, frame
        else:  # each command waits for 60 ms
            if len(self.held) == 3:
                yield COMMAND, self.held[0]
            self.held.append(frame)

    def steer(self, heading, rate):
        """A controller with integral action near the course: otherwise the turn would wind it up."""
        error = (COURSE - heading + 180) % 360 - 180
        if abs(error) < NEAR and self.defect != "no_integral":
            self.integral += INTEGRAL * PERIOD * error
        command = GAIN * error - DAMPING * rate + self.integral
        if self.defect == "wrong_sign":
            command = -command
        return max(-STOP, min(STOP, command))


if __name__ == "__main__":
    serve(Autopilot, DEFECTS)
