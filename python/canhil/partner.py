"""A plant, a sensor or a node of your own in Python, which takes part in a run of hil-bench (docs/programs.md).

This file needs nothing but Python 3.8, so it may be copied alone beside a program. Write a class and serve it:

    import partner                                   # or: from canhil import partner

    class Tank:                                      # a plant: [plant] kind = "program" (docs/plant-program.md)
        inputs = {"valve": "1"}                      # name: SI unit, and for inputs start=NUMBER, for switches steps
        outputs = {"level": "m"}                     # for angles that wrap around: "rad turns"

        def __init__(self, area=1.0):                # the table `parameters` of the scenario
            self.area, self.level = area, 0.0

        def step(self, t, dt, inputs):               # from the time t on for dt seconds, with constant inputs
            self.level += dt * 0.01 * inputs["valve"] / self.area

        def values(self):                            # one for each output, in their order
            return [self.level]

    class Compass:                                   # a sensor: a table of a sensor with the key `command`
        inputs = {"attitude.heading": "rad"}         # true values
        outputs = {"heading": "rad"}                 # values of the sensor; "valid.NAME": "1" for a validity flag

        def measure(self, t, truth):                 # one for each output, in their order
            return [truth["attitude.heading"]]

    class Gateway:                                   # a node of the bus: [[node]]
        period = 0.01                                # it is asked every 10 ms
        truth = ["attitude.heading"]                 # true values that it gets
        hears = ["BRK_Speed"]                        # messages that it gets; "*": every frame, as text

        def step(self, bench):                       # see Bench
            for heard in bench.heard:
                bench.send("GW_Speed", {"GW_Speed": heard.values["BRK_Speed"]})

    partner.serve(Tank)

`random` is seeded for each run, from the seed and the number of the run and the name of the sensor or node; run.seed, run.index and
run.name have them. What the program prints goes to the standard error of the bench. An exception ends the run; the bench reports
its text. Numbers of numpy may be used as values.
"""

from __future__ import annotations

import os
import random
import sys
import traceback
from typing import Any, Callable, Dict, Generator, List, Mapping, NamedTuple, Optional, Sequence, TextIO, Tuple

VERSION = "1"


class RunFacts:
    """The run that the program is in. It is set before the plant, sensor or node is made."""

    seed = 0
    index = 0
    name = ""
    virtual_time = True
    ends_s = 0.0


run = RunFacts()


class Lines:
    """The lines to and from the bench."""

    def __init__(self, source: TextIO, sink: TextIO) -> None:
        self.source, self.sink = source, sink

    def read(self) -> str:
        """The next line; 'end' if there is none."""
        line = self.source.readline()
        return line.rstrip("\r\n") if line.endswith("\n") else "end"

    def write(self, *lines: str) -> None:
        self.sink.write("".join(line + "\n" for line in lines))
        self.sink.flush()


def standard_lines() -> Lines:
    """The standard output of the process becomes its standard error, so that nothing else can write to the bench."""
    lines = Lines(
        os.fdopen(os.dup(0), "r", encoding="utf-8", newline="\n"),
        os.fdopen(os.dup(1), "w", encoding="utf-8", newline="\n"),
    )
    sys.stdout.flush()
    os.dup2(2, 1)
    return lines


def opening(lines: Lines) -> Tuple[str, Dict[str, Any]]:
    """Reads the lines up to 'start', and returns what the program is and its parameters. Unknown lines are skipped."""
    first = lines.read()
    role = first[len("canhil-"):-len(" " + VERSION)]
    if first not in [f"canhil-{known} {VERSION}" for known in ("plant", "sensor", "node")]:
        raise RuntimeError(f"expected 'canhil-plant {VERSION}', version {VERSION} of the protocol")
    parameters: Dict[str, Any] = {}
    while (line := lines.read()) != "start":
        if line == "end":
            raise EOFError("the bench ended before the run began")
        word, _, rest = line.partition(" ")
        name, _, value = rest.partition(" ")
        if word == "number":
            parameters[name] = float(value)
        elif word == "text":
            parameters[name] = value
        elif word == "seed":
            run.seed = int(rest)
        elif word == "run":
            run.index = int(rest)
        elif word == "name":
            run.name = rest
        elif word == "clock":
            run.virtual_time = rest == "virtual"
        elif word == "ends":
            run.ends_s = int(rest) / 1e6
    return role, parameters


def state(values: Sequence[Any]) -> str:
    return " ".join(["state", *(repr(float(value)) for value in values)])


def serve_values(one: Any, lines: Lines, is_sensor: bool) -> None:
    """A plant or a sensor."""
    measure: Optional[Callable[..., Sequence[Any]]] = one.measure if is_sensor else None
    for name, unit in one.inputs.items():
        lines.write(f"input {name} {unit}")
    for name, unit in one.outputs.items():
        lines.write(f"output {name} {unit}")
    lines.write(state([0.0] * len(one.outputs) if measure else one.values()))
    while (words := lines.read().split())[:1] == ["step"]:
        begin, end = int(words[1]), int(words[2])
        inputs = dict(zip(one.inputs, map(float, words[3:])))
        if measure:
            lines.write(state(measure(end / 1e6, inputs)))
        else:
            one.step(begin / 1e6, (end - begin) / 1e6, inputs)
            lines.write(state(one.values()))


class Heard(NamedTuple):
    """A message on the bus, with the values of its signals in the units of the DBC."""

    t: float
    message: str
    values: Dict[str, float]


class Bench:
    """The run at one step of a node: what the node gets, and what it does."""

    def __init__(self, t: float, truth: Dict[str, float], heard: List[Heard], frames: List[Tuple[float, str]]) -> None:
        self.t = t
        """The time of the run [s]."""
        self.truth = truth
        """The true values, in SI; NaN: the run has none now."""
        self.heard = heard
        """The messages since the last step."""
        self.frames = frames
        """With hears = ["*"]: every frame since the last step, as its time and its text, such as '123#0011'."""
        self.lines: List[str] = []

    def send(self, message: str, values: Optional[Mapping[str, float]] = None) -> None:
        """Sends a message of the DBC. Signals without a value keep the last; the bench adds counter and checksum."""
        pairs = [f"{name}={float(value)!r}" for name, value in (values or {}).items()]
        self.lines.append(" ".join(["send", message, *pairs]))

    def frame(self, text: str) -> None:
        """Sends any frame, as candump writes it: '123#0011', '12345678##1AABB'."""
        self.lines.append(f"frame {text}")

    def begin(self, fault: str) -> None:
        """Begins a [[fault]] of the scenario with when = "command"."""
        self.lines.append(f"begin {fault}")

    def end(self, fault: str) -> None:
        """Ends it."""
        self.lines.append(f"end {fault}")

    def set(self, value: str, to: float) -> None:
        """Replaces a value of a sensor's samples from now on: 'gps.height', in SI, or a flag: 'gps.valid.FLAG'."""
        self.lines.append(f"set {value} {float(to)!r}")

    def release(self, value: str) -> None:
        """The sensor measures the value again."""
        self.lines.append(f"release {value}")

    def stop(self, why: str) -> None:
        """Ends the run, which is then not measured."""
        self.lines.append(f"stop {why}")


def values_of(words: Sequence[str]) -> Dict[str, float]:
    return {name: float(value) for name, _, value in (word.partition("=") for word in words)}


def next_step(lines: Lines, truth: Sequence[str]) -> Optional[Bench]:
    """The next step; None: the run is over. RuntimeError: the bench refuses what was done."""
    heard: List[Heard] = []
    frames: List[Tuple[float, str]] = []
    while True:
        line = lines.read()
        words = line.split()
        if words[:1] == ["heard"]:
            heard.append(Heard(int(words[1]) / 1e6, words[2], values_of(words[3:])))
        elif words[:1] == ["frame"]:
            frames.append((int(words[1]) / 1e6, words[2]))
        elif words[:1] == ["step"]:
            return Bench(int(words[2]) / 1e6, dict(zip(truth, map(float, words[3:]))), heard, frames)
        elif words[:1] == ["error"]:
            raise RuntimeError(line.partition(" ")[2])
        else:
            return None


def steps(lines: Lines, period: float, truth: Sequence[str], hears: Sequence[str]) -> Generator[Bench, None, None]:
    """Declares a node, and gives its steps; each is answered when the next is asked for, and the last by close()."""
    declare(lines, period, truth, hears)
    while (bench := next_step(lines, truth)) is not None:
        try:
            yield bench
        finally:
            lines.write(*bench.lines, "done")


def declare(lines: Lines, period: float, truth: Sequence[str], hears: Sequence[str]) -> None:
    declared = [f"period {period!r}", *(f"input {name}" for name in truth), *(f"hear {name}" for name in hears)]
    lines.write(*declared, "ready")


def converse(make: Callable[..., Any], lines: Lines) -> None:
    role, parameters = opening(lines)
    random.seed(f"{run.seed} {run.index}" + (f" {run.name}" if run.name else ""))
    one = make(**parameters)
    if role != "node":
        return serve_values(one, lines, role == "sensor")
    truth = getattr(one, "truth", [])
    declare(lines, getattr(one, "period", 0.01), truth, getattr(one, "hears", []))
    while (bench := next_step(lines, truth)) is not None:
        one.step(bench)  # what it did before an exception is not sent
        lines.write(*bench.lines, "done")
    return None


def serve(make: Callable[..., Any]) -> None:
    """Lets the bench ask the plant, sensor or node that make(**parameters) returns, until the bench ends the run."""
    lines = standard_lines()
    try:
        converse(make, lines)
    except EOFError:
        sys.exit(0)
    except BrokenPipeError:  # the bench has ended
        os._exit(1)
    except Exception as error:  # of the program: the bench reports it
        traceback.print_exc()
        lines.write(" ".join(f"error {type(error).__name__}: {error}".split()))
        sys.exit(1)
