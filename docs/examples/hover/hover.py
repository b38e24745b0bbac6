"""The flight controller of a small rotorcraft with a DBC of its own, hover.dbc. It is independent of hil-bench.

    hil-bench run docs/examples/hover/hover.toml --target 'python3 docs/examples/hover/hover.py'

--defect NAME: the controller has a defect, which the bench must find (DEFECTS).
"""
import math
import struct
import sys
from collections import deque
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1] / "kit"))
from device import serve

ATTITUDE, POSITION, VELOCITY, COMMAND, STATUS = 0x100, 0x110, 0x111, 0x200, 0x201
DEFECTS = ("none", "old_attitude", "no_integral", "ignores_heading", "weak_motors", "never_holding", "turns_away")
PERIOD, G = 0.01, 9.80665
TARGET, COURSE = (5.0, -2.0, -3.0), math.radians(90)  # north, east, down [m]; heading [rad]
SPEED, TILT = 1.5, math.radians(25)  # largest speed and tilt
POSITION_GAIN, VELOCITY_GAIN, INTEGRAL_GAIN, ATTITUDE_GAIN, HEADING_GAIN = 0.8, 2.0, 0.5, 6.0, 2.0


def clamp(value, most):
    return max(-most, min(most, value))


class FlightController:
    def __init__(self, defect):
        self.defect, self.position, self.velocity, self.integral = defect, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0), [0.0, 0.0, 0.0]
        self.attitudes = deque(maxlen=20)

    def receive(self, identifier, data):
        """Takes a frame. Yields the frames that answer it."""
        if identifier == POSITION:
            self.position = tuple(value / 100 for value in struct.unpack("<3h", data))
        elif identifier == VELOCITY:
            self.velocity = tuple(value / 100 for value in struct.unpack("<3h", data))
        elif identifier == ATTITUDE:
            roll, pitch, heading, counter = struct.unpack("<hhHB", data)
            self.attitudes.append(tuple(math.radians(angle / 100) for angle in (roll, pitch, heading)))
            thrust, rates = self.control(*self.attitudes[0 if self.defect == "old_attitude" else -1])
            yield COMMAND, struct.pack("<H3h", round(thrust * 1000), *(round(math.degrees(rate) / 0.02) for rate in rates))
            near = math.dist(self.position, TARGET) < 0.5 and self.defect != "never_holding"
            yield STATUS, bytes([counter, near])

    def control(self, roll, pitch, heading):
        """Position to velocity to acceleration to tilt to body rates. Returns the thrust and the rates."""
        acceleration = []
        for axis in range(3):
            error = TARGET[axis] - self.position[axis]
            wanted = clamp(POSITION_GAIN * error, SPEED)
            if abs(error) < 2 and self.defect != "no_integral":  # the wind
                self.integral[axis] = clamp(self.integral[axis] + INTEGRAL_GAIN * PERIOD * error, 3.0)
            acceleration.append(VELOCITY_GAIN * (wanted - self.velocity[axis]) + self.integral[axis])
        north, east, down = acceleration[0], acceleration[1], acceleration[2] - G  # the thrust carries the weight
        turn = 0.0 if self.defect == "ignores_heading" else heading
        ahead, right = math.cos(turn) * north + math.sin(turn) * east, math.cos(turn) * east - math.sin(turn) * north
        thrust = min(math.sqrt(ahead**2 + right**2 + down**2), 9.5 if self.defect == "weak_motors" else 20.0)
        tilts = clamp(math.asin(clamp(right / max(thrust, 1.0), 1.0)), TILT), clamp(math.atan2(-ahead, -down), TILT)
        yaw = (COURSE - heading + math.pi) % (2 * math.pi) - math.pi
        if self.defect == "turns_away":
            yaw = -yaw
        return thrust, (ATTITUDE_GAIN * (tilts[0] - roll), ATTITUDE_GAIN * (tilts[1] - pitch), HEADING_GAIN * clamp(yaw, 0.8))


if __name__ == "__main__":
    serve(FlightController, DEFECTS)
