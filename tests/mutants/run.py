#!/usr/bin/env python3
"""What do the bench's suites catch? Seeds one defect after the other into the target and flies the suite against each.

  python3 tests/mutants/run.py [--only REGEX] [--a-family-each SEED] [--list] [--json FILE] [--jobs N]

The defects are in tests/mutants/*.toml, a file a family; seeded.py says what they are made of. In a copy of the project,
build/mutants, a defect is put into its file, hil-target is built, and build/default/hil-bench, which has to be there, flies the
suite against it, flights and then the campaigns of bench/acceptance: in lockstep, on a private bus, up to the first check that
fails. Then the file is put back. Before all that the suite flies against the target as it is, which must pass.

A mutant is caught when a check fails or a flight comes to no good end, and survives when the suite passes. A check that was not
measured, such as those of timing, which lockstep does not have, catches nothing.

--only takes those whose FAMILY.NAME the regular expression is found in; --a-family-each one of each family, the same ones for the
same seed; --list says what they are and flies nothing. A line a mutant, at the end a table by family, to FILE as JSON.
Exit code: 0 all caught, 1 one survived or does not build, 2 wrong usage, or the target does not pass as it is.
"""
import argparse
import json
import os
import random
import re
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/static"))
import copied_tree  # noqa: E402
import seeded  # noqa: E402

BENCH = ROOT / "build/default/hil-bench"
COPY = ROOT / "build/mutants"
TARGET = COPY / "build/default/hil-target"
LONGEST_FLIGHT_S = 300

CAUGHT, SURVIVED, NO_BUILD = "caught", "survived", "does not build"

# Short ones first: what they catch needs no long one.
SUITE = ("transfer_alignment_quick", "los_quick", "wind_quick", "inflight_quick", "transfer_alignment_h2", "all_four",
         "transfer_alignment", "los_closed_loop", "los_closed_loop_500hz", "wind_ekf", "wind_h_infinity", "inflight_gps",
         "inflight_ssbl", "inflight_ssbl_180")

# Many flights, a minute each: errors and honesty within bars of both ends.
ACCEPTANCE = ("transfer_alignment", "inflight_alignment", "wind")


def suite(report, family=None):
    """[(name, command)]: what a target is to pass; each writes its report as JSON to the file `report`. What is wrong with one
    estimator, its family, no campaign of another shows."""
    flights = [(name, [str(BENCH), "run", str(ROOT / f"bench/flights/{name}.toml"), "--lockstep", "--target", str(TARGET),
                       "--json", str(report)]) for name in SUITE]
    campaigns = [(f"acceptance of {name}", [str(BENCH), "campaign", str(ROOT / f"bench/acceptance/{name}.toml"), "--target",
                                            str(TARGET), "--json", str(report), "--out", f"{report}.sqlite"])
                 for name in ACCEPTANCE if family in (name, None) or family not in (*ACCEPTANCE, "los_rate")]
    return flights + campaigns


class Failure(Exception):
    """Nothing can be said about any mutant; one line that says why."""


class Progress:
    """On a terminal one line that moves; elsewhere nothing."""

    def __init__(self):
        self.shown = sys.stdout.isatty()
        self.before = ""

    def say(self, what):
        if self.shown:
            print(f"\r\x1b[K{self.before}{what}", end="", flush=True)

    def line(self, what):
        self.say("")
        print(("\r\x1b[K" if self.shown else "") + what, flush=True)


def run(command, longest_s=None, **more):
    """(exit code, output); None for the exit code: not done in time. Nothing that it started outlives it."""
    process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                               errors="replace", start_new_session=True, **more)
    try:
        output = process.communicate(timeout=longest_s)[0]
        return process.returncode, output
    except subprocess.TimeoutExpired:
        return None, ""
    finally:
        try:
            os.killpg(process.pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
        process.wait()


def build(jobs):
    """(done, output)"""
    if not (COPY / "build/default/CMakeCache.txt").exists():
        code, output = run(["cmake", "--preset", "default"], cwd=COPY)
        if code != 0:
            return False, output
    code, output = run(["cmake", "--build", "--preset", "default", "--target", "hil-target", "-j", str(jobs)], cwd=COPY)
    return code == 0, output


def error_of(output):
    """The line of a build's output that says what is wrong."""
    lines = [line for line in output.splitlines() if re.search(r"\berror\b", line)] or output.splitlines()[-1:] or ["no output"]
    return lines[0]


def judged(code, output, report):
    """What was wrong with a flight, as (check, what was measured); None: nothing."""
    if code is None:
        return "no end", f"not within {LONGEST_FLIGHT_S} s"
    try:
        page = json.loads(report.read_text())
    except (OSError, ValueError):
        return "no report", f"exit code {code}: {(output.strip().splitlines() or ['no output'])[-1]}"
    for check in page.get("checks", page.get("answers")):
        if check.get("outcome") == "fail":
            return check.get("name", check.get("metric")), check["measured"]
    if not page.get("ending", {"completed": True})["completed"]:
        return "ending", page["ending"]["detail"]
    if code not in (0, 3):  # pass, or none failed but some were not measured
        return "verdict", page.get("reason", page["outcome"] if "outcome" in page else "")
    return None


def fly_suite(progress, family=None):
    """(scenario, check, what was measured) of the first thing wrong; None: passed."""
    with tempfile.TemporaryDirectory() as folder:
        report = Path(folder, "report.json")
        for scenario, command in suite(report, family):
            progress.say(f"flies {scenario}")
            report.unlink(missing_ok=True)
            Path(f"{report}.sqlite").unlink(missing_ok=True)
            wrong = judged(*run(command, LONGEST_FLIGHT_S), report)
            if wrong:
                return scenario, *wrong
    return None


def outcome_of(mutant, jobs, progress):
    """What became of it, as its entry in the JSON file."""
    entry = {"family": mutant.family, "name": mutant.name, "file": mutant.file, "what": mutant.what}
    file = COPY / mutant.file
    text = file.read_text()
    file.write_text(mutant.applied(text))
    try:
        progress.say("builds")
        built, output = build(jobs)
        if not built:
            return {**entry, "outcome": NO_BUILD, "error": error_of(output)}
        wrong = fly_suite(progress, mutant.family)
    finally:
        file.write_text(text)
    if wrong is None:
        return {**entry, "outcome": SURVIVED}
    return {**entry, "outcome": CAUGHT, **dict(zip(("scenario", "check", "measured"), wrong))}


def line_of(entry):
    said = entry["outcome"]
    if said == CAUGHT:
        said = f"caught by {entry['scenario']}: {entry['check']}"
    elif said == NO_BUILD:
        said += f": {entry['error']}"
    return f"{entry['family']:<18} {entry['name']:<44} {said}"


def counts_of(entries):
    counts = {outcome: sum(entry["outcome"] == outcome for entry in entries) for outcome in (CAUGHT, SURVIVED, NO_BUILD)}
    return {"mutants": len(entries), **counts}


def table_of(entries):
    """By family, and the total: {family: counts}"""
    families = {}
    for entry in entries:
        families.setdefault(entry["family"], []).append(entry)
    return {**{family: counts_of(those) for family, those in families.items()}, "total": counts_of(entries)}


def print_table(table):
    print(f"\n{'family':<18} {'mutants':>8} {'caught':>8} {'survived':>9} {'does not build':>15}")
    for family, counts in table.items():
        print(f"{family:<18} {counts['mutants']:>8} {counts[CAUGHT]:>8} {counts[SURVIVED]:>9} {counts[NO_BUILD]:>15}")


def chosen(mutants, only, seed):
    """Those that --only leaves, and of them one of each family where there is a seed."""
    left = [mutant for mutant in mutants if only.search(mutant.full_name)]
    if seed is None:
        return left
    dice = random.Random(seed)
    families = {}
    for mutant in left:
        families.setdefault(mutant.family, []).append(mutant)
    return [dice.choice(those) for those in families.values()]


def regex(text):
    try:
        return re.compile(text)
    except re.error as error:
        raise argparse.ArgumentTypeError(f"'{text}' is no regular expression ({error})") from error


def options():
    parser = argparse.ArgumentParser(prog="run.py", description=__doc__.splitlines()[0])
    parser.add_argument("--only", metavar="REGEX", type=regex, default=regex(""), help="those whose FAMILY.NAME it is found in")
    parser.add_argument("--a-family-each", metavar="SEED", type=int, help="one of each family, the same ones for the same seed")
    parser.add_argument("--list", action="store_true", help="say what they are, and fly nothing")
    parser.add_argument("--json", metavar="FILE", type=Path, help="what became of each, and the table, as JSON")
    parser.add_argument("--jobs", metavar="N", type=int, default=os.cpu_count(), help="how many compilers at once")
    return parser.parse_args()


def prepare(jobs, progress):
    """The copy, with the target as it is built in it and flown."""
    if not BENCH.exists():
        raise Failure(f"{BENCH}: is not there, expected the project built (cmake --preset default; cmake --build --preset default)")
    copied_tree.copy_tree(COPY)
    progress.say("the target as it is: builds")
    built, output = build(jobs)
    if not built:
        raise Failure(f"the target as it is does not build in {COPY}: {error_of(output)}")
    progress.before = "the target as it is: "
    wrong = fly_suite(progress)
    progress.before = ""
    if wrong:
        scenario, check, measured = wrong
        raise Failure(f"the target as it is does not pass {scenario}: {check}: {measured}; expected it to")


def fly(mutants, jobs):
    progress = Progress()
    start = time.monotonic()
    prepare(jobs, progress)
    progress.line(f"the target as it is passes ({len(SUITE)} flights, {len(ACCEPTANCE)} campaigns)")
    entries = []
    for number, mutant in enumerate(mutants, 1):
        gone = int(time.monotonic() - start)
        progress.before = f"{number} of {len(mutants)} ({gone // 60}:{gone % 60:02d}) {mutant.full_name} "
        entries.append(outcome_of(mutant, jobs, progress))
        progress.line(line_of(entries[-1]))
    return entries


def main():
    asked = options()
    mutants = chosen(seeded.all_mutants(), asked.only, asked.a_family_each)
    if not mutants:
        raise Failure(f"--only: no mutant has '{asked.only.pattern}' in its name, expected one (see --list)")
    if asked.list:
        for mutant in mutants:
            print(f"{mutant.family:<18} {mutant.name:<44} {mutant.what}")
        return 0
    entries = fly(mutants, asked.jobs)
    table = table_of(entries)
    print_table(table)
    if asked.json:
        page = {"suite": list(SUITE), "families": {name: counts for name, counts in table.items() if name != "total"},
                "total": table["total"], "mutants": entries}
        asked.json.write_text(json.dumps(page, indent=1) + "\n")
    return 0 if table["total"][CAUGHT] == len(entries) else 1


if __name__ == "__main__":
    try:
        sys.exit(main())
    except (Failure, ValueError, OSError) as failure:
        print(f"run.py: {failure}", file=sys.stderr)
        sys.exit(2)
    except KeyboardInterrupt:
        print("run.py: interrupted", file=sys.stderr)
        sys.exit(130)
