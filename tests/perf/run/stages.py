"""Prints the instructions of a run of 20 s in process by stage: stages.py BUILD_FOLDER

Callgrind counts instructions by source line; it attributes inlined code to the source line of that code. Each file of the project belongs to one stage.
Instructions of libraries (Eigen, random numbers, memory, libm) are attributed to the stage of the function that calls or inlines the library's code.
Exit code 1 if the stage of so many instructions is unknown that a goal cannot be judged.
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
UNKNOWN, NOT_MEASURED = "unknown", "not measured"
STAGES = (SENSOR, PACK, WIRE, UNPACK, ESTIMATOR, LOOP, MONITOR)
GOALS = (("pack + wire + E2E + unpack", (PACK, WIRE, UNPACK), 10), (SENSOR, (SENSOR,), 25))
# A source file belongs to the stage of the first entry whose text occurs in the path of the file. If this entry has no stage (None), each line of the
# file belongs to pack or to unpack; the function that contains the line decides which of the two.
FILES = (
    ("bench/world/", SENSOR), ("bench/sensors/", SENSOR), ("bench/plant/", SENSOR),
    ("bench/nodes/", PACK), ("bench/bindings/", PACK),
    ("messages/canhil.hpp", None), ("dbc/wire/bits", None), ("dbc/wire/quantise", None), ("dbc/wire/message.hpp", None),
    ("dbc/wire/transmit", PACK), ("dbc/wire/routes", UNPACK),
    ("dbc/wire/", WIRE), ("dbc/ports/", WIRE), ("bench/drive/in_process_port", WIRE), ("bench/drive/link", WIRE),
    ("target/estimators/", ESTIMATOR), ("target/", LOOP),
    *((f"bench/{folder}/", MONITOR) for folder in ("protocol", "observe", "estimators", "quantities", "checks", "campaign")),
    ("bench/", LOOP), ("tests/perf/", LOOP),
)
UNPACKS = {"unpack", "load_le", "load_be", "unsigned_bits", "signed_bits", "physical", "real", "from_frame", "unpacked"}


def here(file):
    """The path of the same file in this source tree and build folder. (An object file from the compiler cache may
    contain the paths of another source tree.)"""
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
    """The stage to which a line of a source file belongs; None if the file is not part of the project."""
    for part, stage in FILES:
        if part in file:
            if stage:
                return stage
            around = [name for number, name in definitions(file) if number <= line]
            return UNPACK if around and around[-1] in UNPACKS else PACK
    return None


def read(path):
    """Reads callgrind's output. Returns three dictionaries: {(function, stage or None): own cost}, {called function: {(calling function, stage or
    None): cost including callees}}, and {function: the file that defines it}."""
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
    """{stage: own cost of the code that belongs to the stage}"""

    @functools.cache
    def split_of(function):
        """{stage: share} of a function's cost. If the function's file belongs to a stage, this stage has all of the cost. For a function of a
        library, the cost is divided among the stages of its callers, in proportion to the cost of their calls."""
        stage = stage_of(homes.get(function, ""), 0)
        if stage:
            return {stage: 1.0}
        found = collections.Counter()
        open_functions.add(function)
        for (caller, stage), cost in calls[function].items():
            if caller not in open_functions:  # without this test, recursive library functions would cause endless recursion here
                for name, part in ({stage: 1.0} if stage else split_of(caller)).items():
                    found[name] += cost * part
        open_functions.discard(function)
        total = sum(found.values())
        return {name: cost / total for name, cost in found.items()} if total else {UNKNOWN: 1.0}

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


def judged(shares):
    """For each goal: met, not met or not measured. The instructions of unknown stage may belong to any stage."""
    total, outcomes = sum(shares.values()), []
    for _, stages, goal in GOALS:
        share = 100 * sum(shares.get(stage, 0) for stage in stages) / total
        most = share + 100 * shares.get(UNKNOWN, 0) / total
        outcomes.append("not met" if share >= goal else "met" if most < goal else NOT_MEASURED)
    return outcomes


def main():
    undecided = False
    program = pathlib.Path(sys.argv[1]) / "tests/perf/run/run_instructions"
    for variant, filter_name in (("kf_p1", "Kalman filter"), ("h2_case2_p1", "robust H2 filter, case 2")):
        shares = count(program, variant)
        total = sum(shares.values())
        if not total:
            sys.exit("stages.py: callgrind counted nothing, expected instructions inside one_run()")
        print(f"the paper's flight, {filter_name}: {total / 3e6:.2f} million instructions a run")
        for stage in (*STAGES, UNKNOWN):
            if shares[stage]:
                print(f"  {stage:28} {100 * shares[stage] / total:5.1f} %")
        outcomes = judged(shares)
        for (name, stages, goal), outcome in zip(GOALS, outcomes):
            print(f"  {name:28} {100 * sum(shares[stage] for stage in stages) / total:5.1f} %  (goal: below {goal} %: {outcome})")
        undecided = undecided or NOT_MEASURED in outcomes
    if undecided:
        sys.exit("stages.py: too many instructions belong to no stage, expected a build with line numbers of this source tree (cmake --preset perf)")


if __name__ == "__main__":
    main()
