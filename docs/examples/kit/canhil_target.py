"""A target for the canhil bench; only the estimator is missing. It contains the state machine, the protection of frames, sample groups,
parameters, the heartbeat, counts of lost frames, and the buses local:NAME and SocketCAN. It needs only Python's standard library.
docs/own-target.md describes the protocol.

    class MyFilter: ...                      # see Estimator
    sys.exit(canhil_target.serve(MyFilter(), bus))
"""

import math
import os
import signal
import socket
import stat
import struct
import sys
import time
from typing import NamedTuple

from canhil_messages import ANSWERS, CYCLE_MS, FROM_TARGET, GROUPS, HASH24, VALUE_TABLES

COUNTERS = 15  # E2E profile 11 counts from 0 to 14
HEARTBEAT_US = round(CYCLE_MS["TargetHeartbeat"] * 1000)
LEAD_LIMIT_US = 100_000  # a sample whose time is further ahead of the time base is rejected
SILENCE_LIMIT_US = 500_000  # the target reports a longer silence of the sensor
BENCH_SILENT_S, BENCH_GONE_S = 2e-6 * HEARTBEAT_US, 2.0


class Parameter(NamedTuple):
    """A parameter. Its values are in the unit that its name contains."""
    initial: float
    minimum: float
    maximum: float
    whole: bool = False
    while_running: bool = False


class Estimator:
    """The user derives a class from this one. The values of a group are a dictionary {name of the signal: value}. If a signal has a value table in
    the DBC, its value is a name from this table."""
    estimator = "none"  # a name from the value table Estimator
    algorithms = ()  # names from the value table Algorithm
    answers = {}  # {input group: the group of the answer, or None}
    parameters = {}  # {name: Parameter}

    def start(self, algorithm, parameters, initial):
        """Starts the estimator from the beginning. parameters: {name: value}; the kit may change the values during the run. initial: the values of
        group TargetInit."""

    def sample(self, group, values, t_us):
        """Processes one complete sample that is newer than the sample before. t_us: its time of validity in the bench's time base, unwrapped.
        Returns the values of the answer; a missing value is sent as 0, and the kit adds cause_time_us and cause_counter. Raises
        ArithmeticError if the filter cannot continue."""
        raise NotImplementedError


# ---- frames ----

def crc(data, data_id):
    """AUTOSAR E2E profile 11: CRC-8 SAE J1850 (polynomial 0x1D, start value 0) over the data id, low byte first, and data[1:]."""
    value = 0
    for byte in (data_id & 0xFF, data_id >> 8, *data[1:]):
        value ^= byte
        for _ in range(8):
            value = (value << 1) ^ 0x11D if value & 0x80 else value << 1
    return value


def decode(data, signals):
    word = int.from_bytes(data.ljust(8, b"\0"), "little")
    values = {}
    for name, start, length, kind, scale, offset, _, _, table in signals:
        raw = (word >> start) & ((1 << length) - 1)
        if kind == "float":
            raw = struct.unpack("<f", struct.pack("<I", raw))[0]
        elif kind == "signed" and raw >> (length - 1):
            raw -= 1 << length
        values[name] = VALUE_TABLES[table].get(raw, raw) if table else raw if scale == 1 and offset == 0 else raw * scale + offset
    return values


def encode(size, signals, values):
    """Packs the values of signals into a frame. Rounds half to even and clamps to the signal's range. NaN becomes the lowest value; a missing
    value is 0."""
    word = 0
    for name, start, length, kind, scale, offset, lowest, highest, table in signals:
        value = values.get(name, 0)
        if isinstance(value, str):
            value = next(number for number, known in VALUE_TABLES[table].items() if known == value)
        raw = (value - offset) / scale
        raw = min(raw, highest) if raw > lowest else lowest
        bits = struct.unpack("<I", struct.pack("<f", raw))[0] if kind == "float" else round(raw)
        word |= (bits & ((1 << length) - 1)) << start
    return bytearray(word.to_bytes(8, "little")[:size])


MESSAGES = {message[1]: (group, place, message) for group, messages in GROUPS.items() for place, message in enumerate(messages)}
HEARTBEAT_ID = GROUPS["TargetHeartbeat"][0][1]


class Target:
    """The target without clock and bus: receive() processes a frame; for each frame that the target sends, it calls `send(id, data)`."""

    def __init__(self, estimator, send):
        self.estimator, self.send = estimator, send
        self.forget()

    def forget(self):
        """Restores the state that the target has after program start."""
        self.state, self.selected, self.algorithm = "idle", "none", 0
        self.errors = dict.fromkeys(("dbc_mismatch", "not_initialised", "input_lost", "input_silent", "numeric", "command"), False)
        self.losses = dict.fromkeys(("frames_lost", "bad_crc", "bad_group", "late"), 0)
        self.untouched = self.lockstep = False
        self.parameters = {name: one.initial for name, one in self.estimator.parameters.items()}
        self.initial = {}
        self.received, self.next = {}, {}  # {id: counter}: last received, and for the next transmission
        self.pending = {}  # incomplete groups: {group: (counter, {index of the message: values})}
        self.now_us = self.heartbeat_due_us = self.heard_us = 0
        self.answered_us = {}

    # -- status messages --

    def send_group(self, group, values):
        """Sends all messages of a group in the order of their ids. The last message contains the time."""
        for _, identifier, data_id, size, signals in GROUPS[group]:
            data = encode(size, signals, values)
            counter = self.next.get(identifier, 0)
            self.next[identifier] = (counter + 1) % COUNTERS
            data[1] |= counter
            data[0] = crc(data, data_id)
            self.send(identifier, bytes(data))

    def send_heartbeat(self):
        self.send_group("TargetHeartbeat", {"state": self.state, "estimator": self.selected, "algorithm": self.algorithm,
                                            "dbc_hash": HASH24[self.selected], **{"error_" + name: error for name, error in self.errors.items()}})

    def enter(self, state):
        self.state = state
        self.send_heartbeat()

    def refuse(self, error):
        self.errors[error] = True
        self.send_heartbeat()

    # -- frames to groups --

    def receive(self, identifier, data):
        """Processes a frame. Returns 'sample' if the frame completed a sample that was answered, 'bench' if only a bench sends such frames,
        otherwise ''."""
        if identifier not in MESSAGES or MESSAGES[identifier][0] in FROM_TARGET:
            return ""
        group, place, (_, _, data_id, size, signals) = MESSAGES[identifier]
        counter = data[1] & 0x0F if len(data) > 1 else COUNTERS
        if len(data) != size or counter >= COUNTERS or data[0] != crc(data, data_id):
            self.losses["bad_crc"] += 1
            self.errors["input_lost"] = True
            return ""
        before = self.received.get(identifier)
        self.received[identifier] = counter
        if before == counter and group != "TargetCommand":  # commands are always obeyed: a restarted bench can send the same counter again
            self.losses["late"] += 1
            return ""
        lost = 0 if before in (None, counter) else (counter - before - 1) % COUNTERS
        if lost:
            self.losses["frames_lost"] += lost
            self.errors["input_lost"] = True
        if self.dispatch(group, place, counter, data, signals):
            return "sample"
        return "bench" if group in ("Sync", "TargetCommand") else ""

    def dispatch(self, group, place, counter, data, signals):
        running, sample = self.state == "running", group in self.estimator.answers
        if group == "TargetInit" and running:
            self.errors["command"] = True
            return False
        if sample and not running:
            return False
        if sample:
            self.untouched = False
        values = self.completed(group, place, counter, decode(data, signals))
        if values is None:
            return False
        if sample:
            return self.on_sample(group, counter, values)
        handle = {"Sync": self.on_sync, "TargetCommand": self.on_command, "ParamSet": self.on_parameter, "TargetInit": self.on_initial}
        if group in handle:
            handle[group](values)
        return False

    def completed(self, group, place, counter, values):
        """Returns the values of the group if it is now complete, otherwise None. If the message has another counter than the incomplete group so
        far, this group is discarded."""
        before, parts = self.pending.pop(group, (counter, {}))
        if before != counter:
            self.losses["bad_group"] += 1
            self.errors["input_lost"] = True
            parts = {}
        parts[place] = values
        if len(parts) == len(GROUPS[group]):
            return {name: value for part in parts.values() for name, value in part.items()}
        self.pending[group] = (counter, parts)
        return None

    # -- commands --

    def on_command(self, command):
        if command["dbc_hash"] != HASH24.get(command["estimator"], HASH24["none"]):
            self.refuse("dbc_mismatch")
        elif command["command"] == "reset":
            self.reset(command["estimator"], command["algorithm"])
        elif command["command"] == "start":
            self.start()
        elif command["command"] == "stop":
            self.enter("idle" if self.state == "running" else self.state)
        elif command["command"] == "none":
            self.send_heartbeat()
        else:  # unknown commands, and add: this target can run only one estimator
            self.refuse("command")

    def reset(self, estimator, algorithm):
        self.forget()
        self.algorithm = algorithm
        if estimator == self.estimator.estimator and algorithm in self.estimator.algorithms:
            self.selected = estimator
        else:
            self.errors["command"] = True
        self.enter("idle")

    def start(self):
        if self.state == "ready" or (self.state == "running" and self.untouched):  # untouched: a repeated start command changes nothing
            self.next, self.pending, self.answered_us = {}, {}, {}
            self.untouched, self.heard_us = True, self.now_us
            self.estimator.start(self.algorithm, self.parameters, self.initial)
            self.enter("running")
        else:
            self.refuse("not_initialised" if self.state == "idle" else "command")

    def on_parameter(self, request):
        name, value = request["parameter"], request["value"]
        parameter = self.estimator.parameters.get(name) if self.selected != "none" else None
        status = "accepted"
        if parameter is None:
            status = "unknown"
        elif self.state == "running" and not parameter.while_running:
            status = "wrong_state"
        elif not parameter.minimum <= value <= parameter.maximum or (parameter.whole and value != round(value)):  # also for NaN
            status = "out_of_range"
        else:
            self.parameters[name] = value
        in_force = value if parameter is None else self.parameters[name]
        self.send_group("ParamAck", {"parameter": name, "value": in_force, "status": status})

    def on_initial(self, values):
        self.initial = values
        if self.selected == "none" or self.state == "fault":
            self.refuse("command")
        else:
            self.enter("ready")

    # -- time and samples --

    def on_sync(self, sync):
        self.now_us, self.lockstep, self.untouched = sync["time_us"], bool(sync["lockstep"]), False
        if self.state == "running" and self.now_us - self.heard_us > SILENCE_LIMIT_US:
            self.errors["input_silent"] = True
        if self.now_us >= self.heartbeat_due_us:
            self.heartbeat_due_us = (self.now_us // HEARTBEAT_US + 1) * HEARTBEAT_US
            self.send_heartbeat()
            self.send_group("TargetCounters", self.losses)  # a count beyond the signal's range is sent as the largest value
        if self.lockstep:
            self.send_group("StepDone", {"step": sync["step"]})

    def unwrapped_us(self, group, value):
        """Unwraps a time that was sent modulo 2^length steps: returns the possible time that is nearest to the present time."""
        _, _, length, _, scale, *_ = next(s for m in GROUPS[group] for s in m[4] if s[0] == "time_of_validity_us")
        period = round(2**length * scale)
        return self.now_us + (round(value) - self.now_us + period // 2) % period - period // 2

    def on_sample(self, group, counter, values):
        t_us = self.unwrapped_us(group, values["time_of_validity_us"]) if "time_of_validity_us" in values else self.now_us
        if t_us > self.now_us + LEAD_LIMIT_US:
            self.losses["bad_group"] += 1
            self.errors["input_lost"] = True
            return False
        if t_us <= self.answered_us.get(group, -math.inf):
            self.losses["late"] += 1
            return False
        self.answered_us[group] = self.heard_us = t_us
        try:
            answer = self.estimator.sample(group, values, t_us)
        except ArithmeticError:
            self.errors["numeric"] = True
            self.enter("fault")
            return False
        if self.estimator.answers[group] is None:
            return False
        cause = {"cause_time_us": t_us % 2**32, "cause_counter": counter}  # the time wraps every 71.6 minutes
        self.send_group(self.estimator.answers[group], {**answer, **cause})
        return True


# ---- buses ----

EXTENDED, NO_DATA = 1 << 31, 3 << 29  # bits of an id in SocketCAN: 29 bits; an error frame or a remote frame


class LocalBus:
    """The embedded bus local:NAME. docs/own-target.md describes the format of its datagrams."""
    stamp_clock = time.CLOCK_MONOTONIC
    FD, BIT_RATE_SWITCH, ERROR_PASSIVE = 2, 4, 32  # flags of a datagram, beside 1 for 29 bits

    def __init__(self, name, fd):
        self.format = self.FD if fd else 0
        name = name.split("?")[0]  # settings after '?' are for the host of the bus
        runtime = os.environ.get("XDG_RUNTIME_DIR", "")
        try:
            entry = os.lstat(runtime)
            private = stat.S_ISDIR(entry.st_mode) and entry.st_uid == os.geteuid() and not entry.st_mode & 0o077
        except OSError:
            private = False
        folder = f"{runtime}/canhil" if private else f"/tmp/canhil-uid-{os.geteuid()}"
        self.socket = socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        self.socket.connect(f"{folder}/{name}.{'fd' if fd else 'classic'}")
        # The fields: the magic "CHH1"; whether own frames are echoed; whether only some ids are wanted; a bit for each wanted id; node name.
        self.socket.send(struct.pack("<IBB256s66s", 0x31484843, 0, 0, b"", b"kit"))

    def receive(self):
        """Returns (id, data, stamp [ns]), or None if the bus has ended. An id of 29 bits has the bit EXTENDED too. The id is None if the frame is not a
        data frame of this bus's format."""
        try:
            datagram = self.socket.recv(80)
        except ConnectionResetError:
            return None
        if len(datagram) < 16:
            return None
        identifier, size, flags, _, t_ns = struct.unpack_from("<IBBHq", datagram)
        known = flags & ~(self.BIT_RATE_SWITCH | self.ERROR_PASSIVE) in (self.format, self.format | 1)
        return (identifier | (EXTENDED if flags & 1 else 0) if known else None), datagram[16:16 + size], t_ns

    def send(self, identifier, data):
        flags = (identifier >= EXTENDED) | (self.format and self.FD | self.BIT_RATE_SWITCH)
        self.socket.send(struct.pack("<IBBHq", identifier & ~EXTENDED, len(data), flags, 0, 0) + data)


class SocketCan:
    """can0, vcan0."""
    stamp_clock = time.CLOCK_REALTIME
    SO_TIMESTAMPNS, BIT_RATE_SWITCH = 35, 1

    def __init__(self, name, fd):
        self.layout = "=IBB2x64s" if fd else "=IBB2x8s"  # canfd_frame, can_frame: id, size, flags, data
        self.flags = self.BIT_RATE_SWITCH if fd else 0
        self.socket = socket.socket(socket.PF_CAN, socket.SOCK_RAW, socket.CAN_RAW)
        self.socket.setsockopt(socket.SOL_CAN_RAW, socket.CAN_RAW_FD_FRAMES, fd)
        self.socket.setsockopt(socket.SOL_SOCKET, self.SO_TIMESTAMPNS, 1)
        self.socket.bind((name,))

    def receive(self):
        frame, ancillary, _, _ = self.socket.recvmsg(72, 64)
        if len(frame) < 16:
            return None
        identifier, size = struct.unpack_from("=IB", frame)
        stamp = time.clock_gettime_ns(self.stamp_clock)
        for _, kind, data in ancillary:
            if kind == self.SO_TIMESTAMPNS:
                seconds, nanoseconds = struct.unpack("qq", data)
                stamp = seconds * 1_000_000_000 + nanoseconds
        known = not identifier & NO_DATA and len(frame) == struct.calcsize(self.layout)
        return (identifier if known else None), frame[8:8 + size], stamp

    def send(self, identifier, data):
        self.socket.send(struct.pack(self.layout, identifier, len(data), self.flags, data))


def open_bus(name, fd=False):
    """Joins a bus. fd: its frames are those of CAN FD, otherwise those of classic CAN."""
    return LocalBus(name[len("local:"):], fd) if name.startswith("local:") else SocketCan(name, fd)


# ---- the process ----

class Process:
    """Runs a target on a bus and sends the messages about the host (TargetTiming)."""

    def __init__(self, estimator, bus, make_target=Target):
        self.bus = bus
        self.target = make_target(estimator, self.send)
        self.begun = self.report = time.monotonic()
        self.bench = self.begun - BENCH_SILENT_S
        self.established = self.bench_heard = False
        self.timing = []

    def send(self, identifier, data):
        """If the bus accepts no frame for 20 ms, the frame is lost; the bench detects this by the counters."""
        try:
            self.bus.send(identifier, data)
        except (TimeoutError, OSError):
            pass

    def take(self, received):
        """Processes a received frame. Returns False if another target is on this bus."""
        identifier, data, stamp_ns = received
        if not self.established:  # before its first frame, the target listens to the bus for 1.25 heartbeat periods
            return identifier != HEARTBEAT_ID
        if identifier is None:
            return True
        begun_ns = time.clock_gettime_ns(self.bus.stamp_clock)
        what = self.target.receive(identifier, data)
        if what == "sample":
            ended_ns = time.clock_gettime_ns(self.bus.stamp_clock)
            self.timing.append((begun_ns - stamp_ns, ended_ns - begun_ns))
        self.bench_heard = self.bench_heard or what == "bench"
        return True

    def look_at_clock(self):
        """In a run the target sends no heartbeat by its own clock, so that a replay produces the same frames. When the bench is gone, the target
        sends heartbeats by its own clock again."""
        now = time.monotonic()
        self.established = self.established or now - self.begun >= 1.25e-6 * HEARTBEAT_US
        if not self.established or now - self.report < 1e-6 * HEARTBEAT_US:
            return
        self.report = now
        if self.bench_heard:
            self.bench, self.bench_heard = now, False
        if now - self.bench >= (BENCH_GONE_S if self.target.state == "running" else BENCH_SILENT_S):
            self.target.send_heartbeat()
        elif not self.target.lockstep:
            waits, works = zip(*self.timing) if self.timing else ((0,), (0,))
            self.target.send_group("TargetTiming", {"queue_max_us": max(waits) / 1e3, "queue_mean_us": sum(waits) / len(waits) / 1e3,
                                                    "compute_max_us": max(works) / 1e3, "compute_mean_us": sum(works) / len(works) / 1e3})
        self.timing = []


def serve(estimator, bus_name, make_target=Target):
    """Runs the target until a signal or the end of the bus. Returns the exit code: 0, or 2 after one line on standard error."""
    try:
        bus = open_bus(bus_name)
    except OSError as error:
        print(f"{sys.argv[0]}: {bus_name}: {error.strerror}", file=sys.stderr)
        return 2
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda *_: sys.exit(0))
    bus.socket.settimeout(0.02)
    process = Process(estimator, bus, make_target)
    while True:
        try:
            received = bus.receive()
        except TimeoutError:
            process.look_at_clock()
            continue
        except OSError as error:
            print(f"{sys.argv[0]}: {bus_name}: {error.strerror}", file=sys.stderr)
            return 2
        if received is None:
            return 0
        if not process.take(received):
            print(f"{sys.argv[0]}: {bus_name}: a target answers here already, expected to be the only one", file=sys.stderr)
            return 2
        process.look_at_clock()
