"""Prints the instructions of a run of 20 s in process by stage: stages.py BUILD_FOLDER

Callgrind counts instructions by source line; inlined code counts at its own source line. Each file of the project belongs to one stage. Instructions
of libraries (Eigen, random numbers, memory, libm) count for the stage of the function that they were inlined into or called by.
"""

import collections
import functools
import pathlib
import re
import subprocess
import sys
import tempfile

SENSOR, PACK, WIRE, UNPACK, ESTIMATOR, MONITOR = "sensor and truth", "pack", "wire and E2E", "unpack", "estimator", "monitor, checks"
LOOP = "device and run loop"
STAGES = (SENSOR, PACK, WIRE, UNPACK, ESTIMATOR, LOOP, MONITOR)
GOALS = (("pack + wire + E2E + unpack", (PACK, WIRE, UNPACK), 10), (SENSOR, (SENSOR,), 25))
# The first entry whose text occurs in the path of a source file gives its stage. None: the function that
# contains the line decides between pack and unpack.
FILES = (
    ("bench/world/", SENSOR), ("bench/nodes/", SENSOR),
    ("messages/canhil.hpp", None), ("dbc/wire/bits", None), ("dbc/wire/quantise", None), ("dbc/wire/message.hpp", None),
    ("dbc/wire/transmit", PACK), ("dbc/wire/routes", UNPACK),
    ("dbc/wire/", WIRE), ("dbc/ports/", WIRE), ("bench/drive/in_process_port", WIRE), ("bench/drive/link", WIRE),
    ("target/estimators/", ESTIMATOR), ("target/", LOOP),
    ("bench/observe/monitor", MONITOR), ("bench/checks/", MONITOR), ("bench/campaign/", MONITOR),
    ("bench/", LOOP), ("tests/perf/", LOOP),
)
UNPACKS = {"unpack", "load_le", "load_be", "unsigned_bits", "signed_bits", "physical", "real", "from_frame", "unpacked"}


def here(file):
    """The same file in this tree and build: an object from a compiler cache may name the files of another
    tree."""
    if "/build/" not in file:
        return pathlib.Path(file)
    below = file.split("/build/")[1].split("/", 1)[1]  # path below the build folder
    return pathlib.Path(sys.argv[1]) / below


@functools.cache
def definitions(file):
    """[(line, function)] of the functions that a header of the codec defines."""
    found = []
    for number, text in enumerate(here(file).read_text().splitlines(), 1):
        match = re.search(r"\b(\w+)\(", text)
        if match and "constexpr" in text and text.rstrip().endswith("{"):
            found.append((number, match[1]))
    return found


def stage_of(file, line):
    """The stage of a line of the project; None: the file is not part of the project."""
    for part, stage in FILES:
        if part in file:
            if stage:
                return stage
            around = [name for number, name in definitions(file) if number <= line]
            return UNPACK if around and around[-1] in UNPACKS else PACK
    return None


def read(path):
    """Self cost by (function, stage or None); calls {callee: {(caller, stage or None): inclusive cost}}; home file by function."""
    names, homes, costs = {}, {}, collections.Counter()
    calls = collections.defaultdict(collections.Counter)

    def named(kind, text):
        number, name = re.match(r"\((\d+)\)(?: (.*))?", text).groups()
        if name is not None:
            names[kind, number] = name
        return names[kind, number]

    function = home = file = callee = None
    called, line = False, 0
    for text in path.read_text().splitlines():
        key, _, rest = text.partition("=")
        if key == "fl":
            home = file = named("file", rest)
        elif key in ("fi", "fe"):
            file = named("file", rest)
        elif key == "fn":
            function, file = named("fn", rest), home
            homes[function] = home
        elif key in ("cfi", "cfl"):
            named("file", rest)
        elif key == "cfn":
            callee = named("fn", rest)
        elif key == "calls":
            called = True
        elif function and re.match(r"[0-9+*-]\S* \d", text):
            place, cost = text.split()[:2]
            line = line if place == "*" else line + int(place) if place[0] in "+-" else int(place)
            where = (function, stage_of(file, line))
            (calls[callee] if called else costs)[where] += int(cost)
            called = False
    return costs, calls, homes


def shares_of(costs, calls, homes):
    """Self cost by stage."""

    @functools.cache
    def split_of(function):
        """{stage: share} of a library function's cost: all to the stage of its file, otherwise to the stages of its callers,
        by the cost of each caller's calls."""
        stage = stage_of(homes.get(function, ""), 0)
        if stage:
            return {stage: 1.0}
        found = collections.Counter()
        open_functions.add(function)
        for (caller, stage), cost in calls[function].items():
            if caller not in open_functions:  # library functions may be recursive
                for name, part in ({stage: 1.0} if stage else split_of(caller)).items():
                    found[name] += cost * part
        open_functions.discard(function)
        total = sum(found.values())
        return {name: cost / total for name, cost in found.items()} if total else {"unknown": 1.0}

    open_functions = set()
    shares = collections.Counter()
    for (function, stage), cost in costs.items():
        for name, part in ({stage: 1.0} if stage else split_of(function)).items():
            shares[name] += cost * part
    return shares


def count(program, variant):
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "callgrind.out"
        run = subprocess.run(["valgrind", "--tool=callgrind", "--toggle-collect=*one_run*", f"--callgrind-out-file={out}",
                              program, variant], capture_output=True, text=True)
        if run.returncode:
            sys.exit(f"stages.py: {program} under valgrind ended with {run.returncode}: {run.stderr.strip()[-300:]}")
        return shares_of(*read(out))


def main():
    program = pathlib.Path(sys.argv[1]) / "tests/perf/run/run_instructions"
    for variant, filter_name in (("kf_p1", "Kalman filter"), ("h2_case2_p1", "robust H2 filter, case 2")):
        shares = count(program, variant)
        total = sum(shares.values())
        if not total:
            sys.exit("stages.py: callgrind counted nothing, expected instructions inside one_run()")
        print(f"the paper's flight, {filter_name}: {total / 3e6:.2f} million instructions a run")
        for stage in (*STAGES, "unknown"):
            if shares[stage]:
                print(f"  {stage:28} {100 * shares[stage] / total:5.1f} %")
        for name, stages, goal in GOALS:
            share = 100 * sum(shares[stage] for stage in stages) / total
            print(f"  {name:28} {share:5.1f} %  (goal: below {goal} %: {'met' if share < goal else 'not met'})")


if __name__ == "__main__":
    main()
