#!/usr/bin/env python3
"""Finds the limits of a suite's responses: flies pairs of flights with hil-target and with the filter of another maker, and prints where both respond alike.

  python3 tests/independent/limits.py ESTIMATOR [--requirement ID] [--margin SHARE] [--all] [--uncovered]

For each flight (of the requirement) that has no `moves` (--all: each flight), the flight beside it is the earlier one of the same scenario that shares most of its `set`.
A signal whose mean difference between the two is the same for both filters within 6 % follows from the contract and the model. Its limits are the mean of both, plus or minus a
margin (default 5 %) and twice their difference (docs/accept.md, "Faults"). Prints the three strongest such signals of each flight, each of another message, as lines for suite.toml; then how many signals moved, and how many alike. With --uncovered, only signals that have no limits in the suite are looked at,
in all flights, and each is printed for the one flight in which it moves most.
"""

import argparse
import concurrent.futures
import json
import pathlib
import re
import sys
import tempfile
import tomllib

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "mutants"))
import accepting  # noqa: E402

ALIKE = 0.06  # largest difference of the two responses, as a share of their mean
LEAST_STEPS = 5.0  # least mean response, in steps of the signal
LEAST_SHARE = 0.003  # the same for whole numbers, such as flags: the mean over the flight
MOST_SIGNALS = 3  # limits of one flight
NOT_ANSWERS = re.compile(r"e2e_|cause_|time_us$|^counter")
LONGEST_S = 7200


def answers(estimator):
    """The numeric signals of the answers of an estimator, {"Message.signal": step}, from the DBC."""
    dbc = (accepting.ROOT / "dbc/canhil.dbc").read_text()
    of_estimator = {int(m[1]) for m in re.finditer(r'BA_ "Estimators" BO_ (\d+) "([^"]*)"', dbc) if estimator in m[2].split()}
    of_answers = {int(m[1]) for m in re.finditer(r'BA_ "Answers" BO_ (\d+) "[^"]+"', dbc)}
    found = {}
    for message in re.finditer(r"^BO_ (\d+) (\w+): \d+ Target\n((?: SG_ .*\n)+)", dbc, re.M):
        if int(message[1]) not in of_estimator & of_answers:
            continue
        for signal in re.finditer(r"SG_ (\w+) : \S+ \(([^,]+),", message[3]):
            if not NOT_ANSWERS.search(signal[1]):
                found[f"{message[2]}.{signal[1]}"] = float(signal[2])
    return found


def beside(flight, earlier):
    """The earlier flight of the same scenario that shares most of `set` with this one, and sets nothing else."""
    own = settings(flight)
    of_scenario = [one for one in earlier if one["scenario"] == flight["scenario"] and settings(one).items() <= own.items() and settings(one) != own]
    return max(of_scenario, key=lambda one: len(settings(one)), default=None)


def settings(flight):
    """What a flight sets, without its checks, which change no answer."""
    return {key: value for key, value in flight.get("set", {}).items() if key not in ("check", "check+")}


def toml(value):
    """A value of a suite as TOML."""
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{json.dumps(key)} = {toml(one)}" for key, one in value.items()) + " }"
    return "[" + ", ".join(toml(one) for one in value) + "]" if isinstance(value, list) else json.dumps(value)


def write_suite(folder, estimator, flights):
    """Writes a suite of the flights, each as (flight of the project's suite, what to set besides, further keys), to FOLDER/ESTIMATOR/suite.toml."""
    scenarios = accepting.ROOT / "bench/acceptance" / estimator
    text = [f'title = "Probe"\nestimator = "{estimator}"\n\n[[requirement]]\nid = "X"\nfamily = "errors"\ntext = "Probe."']
    for flight, also, more in flights:
        table = {"name": flight["name"], "scenario": str((scenarios / flight["scenario"]).resolve()), "requirement": "X", "set": flight.get("set", {}) | also, **more}
        text.append("[[flight]]\n" + "\n".join(f"{key} = {toml(value)}" for key, value in table.items() if value != {}))
    (folder / estimator).mkdir()
    (folder / estimator / "suite.toml").write_text("\n\n".join(text) + "\n")


def items(folder, estimator, target):
    """Flies the suite in `folder` with a target; returns all items of the report."""
    report = folder / f"{target.rsplit('/')[-1]}.json"
    _, output = accepting.run([str(accepting.BENCH), "accept", "--suites", str(folder), "--target", target, "--estimator", estimator, "--json", str(report)], LONGEST_S)
    if not report.exists():
        sys.exit(f"no report of {target}: {output.strip()[-300:]}")
    return [item for suite in json.loads(report.read_text())["suites"] for requirement in suite["requirements"] for item in requirement["items"]]


def probes(pairs, signals):
    """Each flight of the pairs once, for write_suite(): a flight measures how each signal differs from the flight beside it."""
    flights = {}
    for flight, other in pairs:
        flights.setdefault(other["name"], (other, {}, {}))
        flights[flight["name"]] = (flight, {}, {"beside": other["name"], "moves": [{"signal": signal, "by": [-1e12, 1e12]} for signal in signals]})
    return flights.values()


def responses(folder, estimator, target):
    """Flies the probes with a target; returns {"flight 'NAME': SIGNAL": mean difference}."""
    found = {}
    for item in items(folder, estimator, target):
        if match := re.match(r"differs by (\S+)", item["measured"]):
            found[item["name"]] = float(match[1])
    return found


def of_both(folder, estimator, ask):
    """ask(folder, estimator, target) about hil-target and about the filter of another maker, at the same time."""
    targets = (str(accepting.BUILD / "hil-target"), f"{accepting.PYTHON} {HERE / estimator}.py")
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        return pool.map(lambda target: ask(folder, estimator, target), targets)


def limits(one, other, margin, alike=ALIKE):
    """The limits of a value that two filters have alike; None if they differ."""
    mean, apart = (one + other) / 2, abs(one - other)
    if apart > alike * abs(mean):
        return None
    half = margin * abs(mean) + 2 * apart
    return [float(f"{mean - half:.3g}"), float(f"{mean + half:.3g}")]


def least(step):
    """The least mean response of a signal."""
    return LEAST_STEPS * step if step < 1 else LEAST_SHARE


def both(flight, signal, own, others):
    """The mean differences of a signal between a flight and the one beside it: of the two filters."""
    return (answer.get(f"flight '{flight['name']}': {signal}", 0.0) for answer in (own, others))


def print_best(pairs, signals, own, others, margin):
    """For each signal, the flight in which it moves most of those in which it moves alike."""
    for signal, step in signals.items():
        best = (least(step) / step, "# no flight moves it alike")
        for flight, other in pairs:
            one, two = both(flight, signal, own, others)
            found = limits(one, two, margin)
            if found and min(abs(one), abs(two)) / step > best[0]:
                best = (min(abs(one), abs(two)) / step, f'{flight["name"]} | {other["name"]} | {{ signal = "{signal}", by = {found} }},')
        print(f"{signal}: {best[1]}")


def covered(suite):
    """The signals of which a flight of the suite has limits."""
    moves = [flight.get("moves", []) for flight in suite["flight"]]
    return {one["signal"] for each in moves for one in ([each] if isinstance(each, dict) else each) if "by" in one}


def main():
    parser = argparse.ArgumentParser(prog="limits.py", description=__doc__.splitlines()[0])
    parser.add_argument("estimator")
    parser.add_argument("--requirement", metavar="ID", help="only flights of this requirement")
    parser.add_argument("--all", action="store_true", help="also flights that have limits already")
    parser.add_argument("--uncovered", action="store_true", help="only signals that have no limits, in all flights")
    parser.add_argument("--margin", type=float, default=0.05, metavar="SHARE", help="of the mean of both responses")
    asked = parser.parse_args()
    suite = tomllib.loads((accepting.ROOT / "bench/acceptance" / asked.estimator / "suite.toml").read_text())
    pairs = []
    for number, flight in enumerate(suite["flight"]):
        of_requirement = asked.requirement in (None, flight["requirement"])
        if of_requirement and not flight.get("real_time") and not flight.get("faults") and (asked.all or asked.uncovered or "moves" not in flight):
            earlier = suite["flight"][:number]
            other = next((one for one in earlier if one["name"] == flight.get("beside")), None) or beside(flight, earlier)
            print(f"{flight['name']}: beside {other['name']}" if other else f"{flight['name']}: no flight to compare with", file=sys.stderr)
            if other:
                pairs.append((flight, other))
    signals = answers(asked.estimator)
    if asked.uncovered:
        signals = {name: step for name, step in signals.items() if name not in covered(suite)}
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        write_suite(folder, asked.estimator, probes(pairs, signals))
        own, others = of_both(folder, asked.estimator, responses)
    if asked.uncovered:
        print_best(pairs, signals, own, others, asked.margin)
        return
    moved = alike = 0
    for flight, other in pairs:
        strongest = {}  # by message: how strong, in steps; the signal; its limits
        for signal, step in signals.items():
            one, two = both(flight, signal, own, others)
            if max(abs(one), abs(two)) < least(step):
                continue
            moved += 1
            if found := limits(one, two, asked.margin):
                alike += 1
                message = signal.split(".")[0]
                strongest[message] = max(strongest.get(message, (0,)), (min(abs(one), abs(two)) / step, signal, found))
        print(f"\n# {flight['name']}")
        if strongest:
            print(f'beside = "{other["name"]}"', "moves = [", *(f'  {{ signal = "{signal}", by = {found} }},' for _, signal, found in sorted(strongest.values(), reverse=True)[:MOST_SIGNALS]), "]", sep="\n")
    print(f"\n# {moved} signals moved, {alike} of them alike")


if __name__ == "__main__":
    main()
