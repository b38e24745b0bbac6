"""An attitude ECU with a DBC of its own, own_ecu.dbc. It is independent of hil-bench.

    hil-bench run docs/examples/own_ecu/own_ecu.toml --target 'python3 docs/examples/own_ecu/own_ecu.py'
"""
import math
import socket
import sys
import time
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1] / "kit"))
from canhil_target import open_bus  # SocketCAN or the bench's embedded bus

IMU, ATTITUDE, STATUS = (0x174, 0x178, 0x17C), 0x200, 0x201
DT, LEVELLING_S, STATUS_S = 0.01, 60.0, 0.1
RATE, FORCE = (math.radians(0.005), -163.84 * math.pi / 180), (0.000127465, -4.1768)  # scale and offset: rad/s, g


def crc(data):
    """CRC-8/SAE-J1850."""
    value = 0xFF
    for byte in data:
        value ^= byte
        for _ in range(8):
            value = (value << 1 ^ 0x1D if value & 0x80 else value << 1) & 0xFF
    return value ^ 0xFF


class Ecu:
    """Integrates the rates and corrects roll and pitch slowly by the specific force. Axes: forward, left, up."""

    def __init__(self):
        self.parts, self.counter, self.angles = {}, 0, None

    def sample(self, rates, force):
        roll_by_force = math.atan2(force[1], force[2])
        pitch_by_force = math.atan2(-force[0], math.hypot(force[1], force[2]))
        roll, pitch = self.angles or (roll_by_force, pitch_by_force)
        (p, q, r), share = rates, DT / LEVELLING_S
        turn = q * math.sin(roll) + r * math.cos(roll)
        self.angles = (roll + (p + turn * math.tan(pitch)) * DT + share * (roll_by_force - roll),
                       pitch + (q * math.cos(roll) - r * math.sin(roll)) * DT + share * (pitch_by_force - pitch))

    def receive(self, identifier, data):
        """Takes a frame of the IMU. Returns the answer after the last of three frames, otherwise None."""
        if identifier not in IMU or len(data) != 8 or crc(data[:7]) != data[7]:
            return None
        self.parts[identifier] = data
        if identifier != IMU[2] or len({self.parts.get(one, b"")[6:7] for one in IMU}) != 1:
            return None  # the sample is not complete: three frames with the same counter are needed
        words = [[int.from_bytes(self.parts[one][at:at + 2], "little") for one in IMU] for at in (0, 2)]
        yaw, roll, pitch = (word * RATE[0] + RATE[1] for word in words[0])
        left, forward, up = (word * FORCE[0] + FORCE[1] for word in words[1])
        self.sample((roll, pitch, yaw), (forward, left, up))
        return self.answer(data[6] & 0xF)

    def answer(self, of):
        roll, pitch = (round(math.degrees(angle) / 0.01) & 0xFFFF for angle in self.angles)
        frame = roll.to_bytes(2, "big") + pitch.to_bytes(2, "big") + bytes([of, 0, self.counter])
        self.counter = (self.counter + 1) % 16
        return frame + bytes([crc(frame)])


def serve(ecu, bus):
    bus.socket.settimeout(STATUS_S / 2)
    status_due = time.monotonic()
    while True:
        if time.monotonic() >= status_due:
            status_due += STATUS_S
            bus.send(STATUS, bytes([1 if ecu.angles else 0, 65]))
        try:
            received = bus.receive()
        except socket.timeout:
            continue
        if received is None:
            return
        answer = ecu.receive(*received[:2])
        if answer is not None:
            bus.send(ATTITUDE, answer)


if __name__ == "__main__":
    if "--answers" in sys.argv:  # the id of the answers; that of the status follows
        ATTITUDE = int(sys.argv[sys.argv.index("--answers") + 1], 0)
        STATUS = ATTITUDE + 1
    serve(Ecu(), open_bus(sys.argv[sys.argv.index("--bus") + 1]))
