#!/usr/bin/env python3
"""Finds limits of errors, NIS and NEES for flights that have none: flies them with hil-target and with the filter of another maker, and prints what holds for both.

  python3 tests/independent/bands.py ESTIMATOR [--requirement ID] [--margin SHARE] [--all]

Of the flights of the suite whose scenario stands in the suite's folder, those count that have no `moves`, no `same_as` and no checks of their own (--all: no checks of their own). Printed as a line for suite.toml:
`honest`, if no trusted error of either filter is beyond 4.5 sigma; and each mean NIS and NEES that is at most five times its degrees of freedom and the same for both within 10 %, with the mean of both as the middle of the band,
plus or minus a margin (default 20 %) and twice their difference. They are added to the checks of the scenario.
"""

import argparse
import pathlib
import re
import sys
import tempfile
import tomllib

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent / "mutants"), str(HERE)]
import accepting  # noqa: E402
import limits  # noqa: E402

STATISTICS = {  # with their degrees of freedom
    "transfer_alignment": {"innovation.nis": 3, "attitude.nees": 3},
    "inflight_alignment": {"innovation.nis": 3, "attitude.heading.nees": 1},
    "los_rate": {"los.nis": 2},
    "wind": {"wind.nis": 9, "wind.nees": 3},
}
ALIKE = 0.10  # largest difference of the two means, as a share of their mean
LARGEST_RATIO = 5.0  # of a mean to its degrees of freedom: beyond that the flight is not one for which the filter was made
MOST_SIGMA = 4.5  # the check's limit is 5
WIDE = [0.0, 1e9]


def checks_of(estimator):
    """Checks that measure and pass nearly always."""
    return [{"kind": "honest", "over_sigma": 1e9}] + [{"kind": "consistency", "quantity": name, "mean_between": WIDE} for name in STATISTICS[estimator]]


def measured(folder, estimator, target):
    """Flies the suite in `folder` with a target; returns {(flight, "honest" or a quantity): value}."""
    found = {}
    for item in limits.items(folder, estimator, target):
        flight, _, check = item["name"].partition("': ")
        if value := re.match(r"(?:mean )?([0-9.e+-]+) ", item["measured"]):
            found[flight.removeprefix("flight '"), check.split()[-1]] = float(value[1])
    return found


def band(one, other, freedom, margin):
    """The band of a mean that two filters have alike; None if they differ, or if it is too large."""
    return None if one + other > 2 * LARGEST_RATIO * freedom else limits.limits(one, other, margin, ALIKE)


def checks_for(name, estimator, own, others, margin):
    """The checks that both filters pass in a flight."""
    checks = []
    if max(own.get((name, "honest"), 1e9), others.get((name, "honest"), 1e9)) <= MOST_SIGMA:
        checks.append({"kind": "honest"})
    for quantity, freedom in STATISTICS[estimator].items():
        pair = own.get((name, quantity)), others.get((name, quantity))
        if None not in pair and (between := band(*pair, freedom, margin)):
            checks.append({"kind": "consistency", "quantity": quantity, "mean_between": between})
    return checks


def main():
    parser = argparse.ArgumentParser(prog="bands.py", description=__doc__.splitlines()[0])
    parser.add_argument("estimator", choices=sorted(STATISTICS))
    parser.add_argument("--requirement", metavar="ID", help="only flights of this requirement")
    parser.add_argument("--margin", type=float, default=0.2, metavar="SHARE", help="of the mean of both filters")
    parser.add_argument("--all", action="store_true", help="also flights that are compared with another")
    asked = parser.parse_args()
    passed_over = {"faults", "real_time"}
    suite = tomllib.loads((accepting.ROOT / "bench/acceptance" / asked.estimator / "suite.toml").read_text())
    flights = [one for one in suite["flight"] if "/" not in one["scenario"] and asked.requirement in (None, one["requirement"])
               and not (passed_over if asked.all else passed_over | {"moves", "same_as"}) & one.keys() and not {"check", "check+"} & one.get("set", {}).keys()]
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        limits.write_suite(folder, asked.estimator, [(one, {"check": checks_of(asked.estimator)}, {}) for one in flights])
        own, others = limits.of_both(folder, asked.estimator, measured)
    for one in flights:
        name = one["name"]
        seen = ", ".join(f"{check} {own.get((name, check), 'none')} and {others.get((name, check), 'none')}" for check in ("honest", *STATISTICS[asked.estimator]))
        print(f"\n# {name}: {seen}")
        if checks := checks_for(name, asked.estimator, own, others, asked.margin):
            print('"check+" = [', *(f"  {limits.toml(check)}," for check in checks), "]", sep="\n")


if __name__ == "__main__":
    main()
