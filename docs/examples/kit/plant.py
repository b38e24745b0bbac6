"""A plant of your own in Python, which hil-bench starts as a program ([plant] kind = "program", docs/plant-program.md). It needs Python 3.8 only.

Write a class and serve it:

    import plant

    class Tank:
        inputs = {"valve": "1"}                      # name: SI unit, and for inputs start=NUMBER, for switches steps
        outputs = {"level": "m"}                     # for angles that wrap around: "rad turns"

        def __init__(self, area=1.0):                # the table [plant.parameters] of the scenario
            self.area, self.level = area, 0.0

        def step(self, t, dt, inputs):               # from the time t on for dt seconds, with constant inputs
            self.level += dt * 0.01 * inputs["valve"] / self.area

        def values(self):                            # one for each output, in their order
            return [self.level]

    plant.serve(Tank)

`random` is seeded for each run, from the seed and the number of the run; run.seed and run.index have both. What the program prints goes to the standard error of the
bench. An exception ends the run; the bench reports its text. Numbers of numpy may be used as values.
"""
import os
import random
import sys
import traceback

VERSION = "1"


class Run:
    """The run that the plant is in. It is set before the plant is made."""

    seed = 0
    index = 0


run = Run()


class Lines:
    """The lines to and from the bench. The standard output of the process becomes its standard error, so that nothing else can write to the bench."""

    def __init__(self):
        self.source = os.fdopen(os.dup(0), "r", encoding="utf-8", newline="\n")
        self.sink = os.fdopen(os.dup(1), "w", encoding="utf-8", newline="\n")
        sys.stdout.flush()
        os.dup2(2, 1)

    def read(self):
        """The next line; 'end' if there is none."""
        line = self.source.readline()
        return line.rstrip("\r\n") if line.endswith("\n") else "end"

    def write(self, line):
        self.sink.write(line + "\n")
        self.sink.flush()


def opening(lines):
    """Reads the lines up to 'start', and returns the parameters. Lines that this version does not know are skipped."""
    if lines.read() != "canhil-plant " + VERSION:
        raise RuntimeError(f"expected 'canhil-plant {VERSION}', version {VERSION} of the protocol")
    parameters = {}
    while (line := lines.read()) != "start":
        if line == "end":
            sys.exit(0)
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
    return parameters


def state(plant):
    return " ".join(["state", *(repr(float(value)) for value in plant.values())])


def converse(make, lines):
    parameters = opening(lines)
    random.seed(f"{run.seed} {run.index}")
    plant = make(**parameters)
    for name, unit in plant.inputs.items():
        lines.write(f"input {name} {unit}")
    for name, unit in plant.outputs.items():
        lines.write(f"output {name} {unit}")
    lines.write(state(plant))
    while (words := lines.read().split())[:1] == ["step"]:
        begin, end = int(words[1]), int(words[2])
        inputs = dict(zip(plant.inputs, map(float, words[3:])))
        plant.step(begin / 1e6, (end - begin) / 1e6, inputs)
        lines.write(state(plant))


def serve(make):
    """Lets the bench drive the plant that make(**parameters) returns, until the bench ends the run."""
    lines = Lines()
    try:
        converse(make, lines)
    except BrokenPipeError:  # the bench has ended
        os._exit(1)
    except Exception as error:  # of the plant: the bench reports it
        traceback.print_exc()
        lines.write(" ".join(f"error {type(error).__name__}: {error}".split()))
        sys.exit(1)
