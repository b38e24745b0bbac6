#!/usr/bin/env python3
"""Which defects does `hil-bench accept` detect? Seeds one defect after the other into the target and flies the acceptance suites against each.

  python3 tests/mutants/run.py [--only REGEX] [--draw N] [--seed SEED] [--good] [--list] [--json FILE] [--jobs N] [--target-passes]

The defects are in tests/mutants/*.toml, one file per family; seeded.py describes their format. The sources of the project are not changed.
build/default must be built; it defines how the target is compiled and linked. overlaid.py compiles the changed file from a copy and links it with
the existing objects. A suite ends at the first requirement that is not met. If the changed file belongs to one estimator, only its suite is flown, after
the suite `several`; otherwise all suites, that of the defect's family first.
Before all mutants, the unchanged target must pass all suites.

A mutant is caught if a requirement is not met. It survives if all requirements are met or not measured.

--only          mutants whose FAMILY.NAME contains a match of the regular expression
--draw          N mutants of as many families as possible; the same --seed selects the same mutants (`today`, the default: the current date)
--good          asks only whether the target is good: no comparison with hil-target's code. A defect that leaves a good filter survives
--target-passes skips the flights of the unchanged target, for callers that have flown them
--list          lists the mutants and flies nothing
--jobs          the number of parallel flights (1: timing can be measured too)

Prints one line per mutant and a table by family; --json writes them to FILE. Mutants that equivalent.toml lists as equivalent are not flown.
Exit code: 0 all mutants were caught, 1 a mutant survived or does not build, 2 wrong usage, or the unchanged target does not pass.
"""
import argparse
import concurrent.futures
import json
import random
import re
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/mutants"))
import overlaid  # noqa: E402
import seeded  # noqa: E402
from accepting import BENCH, BUILD, CAMPAIGNS, SINGLE_FLIGHTS, TIMES, accept  # noqa: E402

SAME = ("--same-as", "hil-target")

CAUGHT, SURVIVED, NO_BUILD = "caught", "survived", "does not build"

SUITES = ("several", "transfer_alignment", "inflight_alignment", "los_rate", "wind")  # the suite `several` takes only a second


class Failure(Exception):
    """Raised if no mutant can be judged; its text is the reason, in one line."""


class Progress:
    """Shows the progress in one line of the terminal. Shows no progress if standard output is not a terminal."""

    def __init__(self):
        self.shown = sys.stdout.isatty()

    def say(self, what):
        if self.shown:
            print(f"\r\x1b[K{what}", end="", flush=True)

    def line(self, what):
        self.say("")
        print(("\r\x1b[K" if self.shown else "") + what, flush=True)


def suites_of(mutant):
    """The suites that can see a mutant: that of the estimator to which its file belongs, or all, that of its family first."""
    own = [suite for suite in SUITES if suite in mutant.file]
    return (SUITES[0], *own) if own else sorted(SUITES, key=lambda name: (name != SUITES[0], name != mutant.family))


def fly_suites(target, suites, stages, question=SAME):
    """Asks accept about the suites, stage by stage. Returns the first (requirement, observation) that the target violates, or None."""
    for families in stages:
        for estimator in suites:
            wrong = accept(target, estimator, families, question)[1]
            if wrong:
                return wrong
    return None


def outcome_of(mutant, stages, question=SAME):
    """Builds and flies a mutant. Returns its result as the entry for the JSON file."""
    entry = {"family": mutant.family, "name": mutant.name, "file": mutant.file, "what": mutant.what}
    try:
        target = overlaid.build(BUILD, mutant.full_name, mutant.file, mutant.applied((ROOT / mutant.file).read_text()))
    except overlaid.DoesNotBuild as error:
        return {**entry, "outcome": NO_BUILD, "error": str(error)}
    try:
        wrong = fly_suites(target, suites_of(mutant), stages, question)
    finally:
        overlaid.remove(target)
    if wrong is None:
        return {**entry, "outcome": SURVIVED}
    return {**entry, "outcome": CAUGHT, "requirement": wrong[0], "seen": wrong[1]}


def line_of(entry):
    said = entry["outcome"]
    if said == CAUGHT:
        said = f"caught by {entry['requirement']}: {entry['seen']}"
    elif said == NO_BUILD:
        said += f": {entry['error']}"
    return f"{entry['family']:<18} {entry['name']:<44} {said}"


def counts_of(entries):
    counts = {outcome: sum(entry["outcome"] == outcome for entry in entries) for outcome in (CAUGHT, SURVIVED, NO_BUILD)}
    return {"mutants": len(entries), **counts}


def table_of(entries):
    """{family: counts of its mutants}, with the key "total" for all families together"""
    families = {}
    for entry in entries:
        families.setdefault(entry["family"], []).append(entry)
    return {**{family: counts_of(those) for family, those in families.items()}, "total": counts_of(entries)}


def print_table(table):
    print(f"\n{'family':<18} {'mutants':>8} {'caught':>8} {'survived':>9} {'does not build':>15}")
    for family, counts in table.items():
        print(f"{family:<18} {counts['mutants']:>8} {counts[CAUGHT]:>8} {counts[SURVIVED]:>9} {counts[NO_BUILD]:>15}")


def chosen(mutants, only, count=None, seed=0):
    """The mutants that --only selects. With a count, so many of these are drawn: one of each family, then any. Mutants that only timing
    can reveal are not drawn, because other tests that run at the same time disturb timing."""
    left = [mutant for mutant in mutants if only.search(mutant.full_name)]
    if count is None:
        return left
    left = [mutant for mutant in left if not mutant.real_time]
    dice = random.Random(seed)
    families = {}
    for mutant in left:
        families.setdefault(mutant.family, []).append(mutant)
    ones = [dice.choice(those) for those in families.values()]
    if count < len(ones):
        return dice.sample(ones, count)
    rest = [mutant for mutant in left if mutant not in ones]
    return ones + dice.sample(rest, min(count - len(ones), len(rest)))


def seed_of(text):
    return int(time.strftime("%Y%m%d")) if text == "today" else int(text)


def regex(text):
    try:
        return re.compile(text)
    except re.error as error:
        raise argparse.ArgumentTypeError(f"'{text}' is no regular expression ({error})") from error


def options():
    parser = argparse.ArgumentParser(prog="run.py", description=__doc__.splitlines()[0])
    parser.add_argument("--only", metavar="REGEX", type=regex, default=regex(""), help="those whose FAMILY.NAME it is found in")
    parser.add_argument("--draw", metavar="N", type=int, help="so many, of as many families as possible")
    parser.add_argument("--seed", metavar="SEED", type=seed_of, default=seed_of("today"), help="of --draw: the same seed, the same mutants; today")
    parser.add_argument("--good", action="store_true", help="without a comparison with hil-target's code")
    parser.add_argument("--target-passes", action="store_true", help="leave out the flights against the target as it is")
    parser.add_argument("--list", action="store_true", help="say what they are, and fly nothing")
    parser.add_argument("--json", metavar="FILE", type=Path, help="what became of each, and the table, as JSON")
    parser.add_argument("--jobs", metavar="N", type=int, default=1, help="how many are flown at once")
    return parser.parse_args()


def prepare(progress, question):
    """Checks that the unchanged target passes."""
    if not BENCH.exists():
        raise Failure(f"{BENCH}: is not there, expected the project built (cmake --preset default; cmake --build --preset default)")
    progress.say("the target as it is")
    wrong = fly_suites(BUILD / "hil-target", SUITES, (SINGLE_FLIGHTS, CAMPAIGNS, TIMES), question)
    if wrong:
        raise Failure(f"the target as it is does not meet {wrong[0]}: {wrong[1]}; expected it to")
    progress.line(f"the target as it is meets every requirement that was measured ({len(SUITES)} suites)")


def fly(mutants, jobs, target_passes, question):
    """Tests `jobs` mutants at a time with the families that run in virtual time. Those of timing that survive are then tested for timing one
    after the other, because in real time they would disturb each other."""
    progress = Progress()
    start = time.monotonic()
    if not target_passes:
        prepare(progress, question)
    entries = [{} for _ in mutants]  # in their order; told as they end
    in_real_time = []  # the places of mutants that only timing can reveal
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        flown = {pool.submit(outcome_of, mutant, (SINGLE_FLIGHTS, CAMPAIGNS), question): place for place, mutant in enumerate(mutants)}
        for count, ended in enumerate(concurrent.futures.as_completed(flown), 1):
            place, entry = flown[ended], ended.result()
            if entry["outcome"] == SURVIVED and mutants[place].real_time:
                in_real_time.append(place)
            else:
                progress.line(line_of(entry))
            entries[place] = entry
            gone = int(time.monotonic() - start)
            progress.say(f"{count} of {len(mutants)} ({gone // 60}:{gone % 60:02d})")
    for place in sorted(in_real_time):
        progress.say(f"{mutants[place].full_name} in real time")
        entries[place] = outcome_of(mutants[place], (TIMES,), question)
        progress.line(line_of(entries[place]))
    progress.say("")
    return entries


def main():
    asked = options()
    equivalent = seeded.equivalents()
    mutants = chosen([one for one in seeded.all_mutants() if one.full_name not in equivalent], asked.only, asked.draw, asked.seed)
    if not mutants:
        raise Failure(f"--only: no mutant has '{asked.only.pattern}' in its name, expected one (see --list)")
    if asked.list:
        for mutant in mutants:
            print(f"{mutant.family:<18} {mutant.name:<44} {mutant.what}")
        return 0
    for name, proof in equivalent.items():
        if asked.only.search(name) and asked.draw is None:
            print(f"{name}: not flown, equivalent: {proof}", flush=True)
    entries = fly(mutants, asked.jobs, asked.target_passes, () if asked.good else SAME)
    table = table_of(entries)
    print_table(table)
    if asked.json:
        page = {"suites": list(SUITES), "families": {name: counts for name, counts in table.items() if name != "total"},
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
