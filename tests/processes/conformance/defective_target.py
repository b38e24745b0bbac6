"""The kit's example target, changed so that it breaks the protocol in one way (DEFECT), or unchanged if DEFECT is `none`.

defective_target.py KIT_FOLDER DEFECT --bus BUS
"""

import itertools
import os
import signal
import sys

sys.path.insert(0, sys.argv[1])
import canhil_target  # noqa: E402
import los_rate  # noqa: E402


class Sound(canhil_target.Target):
    """The target without a defect; each defect is a subclass."""


class SlowBeat(Sound):
    """Sends too few heartbeats while no bench is active: one a second."""
    beats = itertools.count()

    def send_heartbeat(self):
        if sys._getframe(1).f_code.co_name != "look_at_clock" or next(self.beats) % 10 == 0:
            super().send_heartbeat()


class AnyContract(Sound):
    """Obeys commands without checking the hash of the DBC in them."""

    def on_command(self, command):
        super().on_command({**command, "dbc_hash": canhil_target.HASH24.get(command["estimator"], canhil_target.HASH24["none"])})


class AnyEstimator(Sound):
    """Does not reject an estimator that it does not have."""

    def reset(self, estimator, algorithm):
        super().reset(self.estimator.estimator, algorithm)


class UnknownCommand(Sound):
    """Treats an unknown command as the command `none`."""

    def on_command(self, command):
        known = ("reset", "start", "stop", "add", "none")
        super().on_command(command if command["command"] in known else {**command, "command": "none"})


class NoStateNeeded(Sound):
    """Starts without an initial state."""

    def start(self):
        if self.state == "idle" and self.selected != "none":
            self.state = "ready"
        super().start()


class HalfState(Sound):
    """Treats an initial state as complete when its last message has arrived, even if others are missing."""

    def completed(self, group, place, counter, values):
        if group == "TargetInit" and place == len(canhil_target.GROUPS[group]) - 1:
            return values
        return super().completed(group, place, counter, values)


class DeafToRepetition(Sound):
    """Drops a command whose counter equals the previous command's."""

    def receive(self, identifier, data):
        group = canhil_target.MESSAGES.get(identifier, ("",))[0]
        if group == "TargetCommand" and self.received.get(identifier) == data[1] & 0x0F:
            return ""
        return super().receive(identifier, data)


class EarlyAnswers(Sound):
    """Answers samples in the state ready, before the start command."""

    def enter(self, state):
        super().enter(state)
        if state == "ready":
            self.estimator.start(self.algorithm, self.parameters, self.initial)

    def dispatch(self, group, place, counter, data, signals):
        said, self.state = self.state, "running" if self.state == "ready" and group == "Seeker" else self.state
        answered = super().dispatch(group, place, counter, data, signals)
        if group == "Seeker":
            self.state = said
        return answered


class NoStop(Sound):
    """Reports that it has stopped, but continues."""
    flying = False

    def start(self):
        super().start()
        self.flying = self.state == "running"

    def dispatch(self, group, place, counter, data, signals):
        said, self.state = self.state, "running" if self.flying and group == "Seeker" else self.state
        answered = super().dispatch(group, place, counter, data, signals)
        if group == "Seeker":
            self.state = said
        return answered

    def forget(self):
        super().forget()
        self.flying = False


class Once(Sound):
    """Cannot be started a second time after a stop."""
    stops = False

    def start(self):
        self.received_syncs = 0
        super().start()

    def on_command(self, command):
        if command["command"] == "stop" and self.state == "running":
            self.stops = self.received_syncs > 40
        if command["command"] == "start" and self.stops:
            self.stops = False
            return self.refuse("command")
        return super().on_command(command)

    received_syncs = 0

    def on_sync(self, sync):
        super().on_sync(sync)
        self.received_syncs = self.received_syncs + 1 if self.state == "running" else 0


class NewStateInFlight(Sound):
    """Ignores an initial state that arrives in the state running, and does not report this error."""

    def dispatch(self, group, place, counter, data, signals):
        if group == "TargetInit" and self.state == "running":
            return False
        return super().dispatch(group, place, counter, data, signals)


class Unforgetting(Sound):
    """A reset does not clear the counts of losses."""

    def forget(self):
        kept = getattr(self, "losses", None)
        super().forget()
        self.losses = kept or self.losses


class NoCounters(Sound):
    """Sends TargetCounters only every half second, not with each heartbeat."""

    def send_group(self, group, values):
        if group != "TargetCounters" or self.now_us % 500_000 == 0:
            super().send_group(group, values)


class EarlyStepDone(Sound):
    """Sends the answers of a step after the StepDone of this step, not before it."""

    def __init__(self, estimator, send):
        self.late = []
        super().__init__(estimator, send)

    def send_group(self, group, values):
        if group == "LosRate":
            self.late.append(values)
            return
        super().send_group(group, values)
        if group == "StepDone":
            late, self.late = self.late, []
            for one in late:
                super().send_group("LosRate", one)


class WrongAnswerCrc(Sound):
    """Computes the CRC of one message of the answer with the data id 0."""

    def __init__(self, estimator, send):
        sigma = canhil_target.GROUPS["LosRate"][1][1]

        def spoiled(identifier, data):
            send(identifier, bytes((canhil_target.crc(data, 0),)) + data[1:] if identifier == sigma else data)
        super().__init__(estimator, spoiled)


class StandingCounter(Sound):
    """The counter of one message never changes."""

    def send_group(self, group, values):
        if group == "TargetCounters":
            self.next[canhil_target.GROUPS[group][0][1]] = 3
        super().send_group(group, values)


class Disorder(Sound):
    """Sends the message that carries the time of the cause first, not last."""

    def __init__(self, estimator, send):
        ids = [message[1] for message in canhil_target.GROUPS["LosRate"]]
        held = []

        def disordered(identifier, data):
            if identifier not in ids:
                return send(identifier, data)
            held.append((identifier, data))
            if len(held) == len(ids):
                for one in (held[1], held[0], held[2]):
                    send(*one)
                held.clear()
            return None
        super().__init__(estimator, disordered)


class OwnCause(Sound):
    """Sends the next sample's counter as cause_counter."""

    def send_group(self, group, values):
        if group == "LosRate":
            values = {**values, "cause_counter": (values["cause_counter"] + 1) % 15}
        super().send_group(group, values)


class Chance(Sound):
    """The answers to the same frames differ from flight to flight."""
    flights = itertools.count()

    def start(self):
        super().start()
        self.flight = next(self.flights)

    def send_group(self, group, values):
        if group == "LosRate":
            values = {**values, "los_rate_pitch_radps": values["los_rate_pitch_radps"] + 1e-4 * (self.flight % 7)}
        super().send_group(group, values)


class NoWrap(Sound):
    """Uses a time of validity as it is in the frame, without unwrapping it."""

    def unwrapped_us(self, group, value):
        return round(value)


class AnyCrc(Sound):
    """Does not check the CRC of frames."""

    def receive(self, identifier, data):
        if identifier in canhil_target.MESSAGES and len(data) == 8:
            data = bytes((canhil_target.crc(data, canhil_target.MESSAGES[identifier][2][2]),)) + data[1:]
        return super().receive(identifier, data)


class AnySize(Sound):
    """Accepts a frame that is one byte too short."""

    def receive(self, identifier, data):
        if identifier in canhil_target.MESSAGES and len(data) == 7 and data[0] == canhil_target.crc(
                data, canhil_target.MESSAGES[identifier][2][2]):
            data = data + b"\x01"
            data = bytes((canhil_target.crc(data, canhil_target.MESSAGES[identifier][2][2]),)) + data[1:]
        return super().receive(identifier, data)


class Repetitions(Sound):
    """Drops a repeated frame without counting it."""

    def receive(self, identifier, data):
        if canhil_target.MESSAGES.get(identifier, ("",))[0] == "Seeker" and self.received.get(identifier) == data[1] & 0x0F:
            return ""
        return super().receive(identifier, data)


class NoLosses(Sound):
    """Does not count lost frames."""

    def send_group(self, group, values):
        super().send_group(group, {**values, "frames_lost": 0} if group == "TargetCounters" else values)


class HalfSamples(Sound):
    """Treats a sample as complete when its last message has arrived, even if others are missing."""

    def completed(self, group, place, counter, values):
        if group == "Seeker":
            self.whole = {**getattr(self, "whole", {}), **values}
        if group == "Seeker" and place == len(canhil_target.GROUPS[group]) - 1:
            self.pending.pop(group, None)
            return self.whole
        return super().completed(group, place, counter, values)


class EightBits(Sound):
    """Reports its counts modulo 256."""

    def send_group(self, group, values):
        super().send_group(group, {name: n % 256 for name, n in values.items()} if group == "TargetCounters" else values)


class Parrot(Sound):
    """Acknowledges a rejected parameter with the requested value instead of the value in force."""

    def send_group(self, group, values):
        if group == "ParamAck" and values["status"] == "out_of_range":
            values = {**values, "value": self.asked}
        super().send_group(group, values)

    def on_parameter(self, request):
        self.asked = request["value"]
        super().on_parameter(request)


class AnyParameter(Sound):
    """Accepts an unknown parameter."""

    def send_group(self, group, values):
        if group == "ParamAck" and not isinstance(values["parameter"], str):
            values = {**values, "status": "accepted"}
        super().send_group(group, values)


class KeptParameters(Sound):
    """A reset does not restore the default parameters."""

    def forget(self):
        kept = getattr(self, "parameters", None)
        super().forget()
        self.parameters = kept or self.parameters


class CrashInFlight(Sound):
    """Crashes shortly before the end of a flight of 6 s: so late that its silence is not noticed any more."""

    def on_sync(self, sync):
        if self.state == "running" and sync["time_us"] >= 5_900_000:
            os.kill(os.getpid(), signal.SIGSEGV)
        super().on_sync(sync)


class CrashWhenEnded(Sound):
    """Crashes when it is asked to end."""

    def __init__(self, *arguments):
        signal.signal(signal.SIGTERM, lambda *_: os.kill(os.getpid(), signal.SIGSEGV))
        super().__init__(*arguments)


if __name__ == "__main__":
    defect = {**{one.__name__: one for one in Sound.__subclasses__()}, "none": Sound}[sys.argv[2]]
    sys.exit(canhil_target.serve(los_rate.LosRate(4.0), sys.argv[4], defect))
