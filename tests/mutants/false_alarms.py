#!/usr/bin/env python3
"""How often do the acceptance campaigns fail a good target? Flies them in process with many seeds and counts.

  python3 tests/mutants/false_alarms.py [--seeds N] [--from SEED] [--json FILE]

Of an acceptance suite, only the campaigns are flown: single flights are compared with a reference of the same seed, and the dialogues have no seed.
The target in process gives bit for bit the same samples as the program hil-target on a bus (campaign_programs.Target.*), in a tenth of the time.
Prints one line for each metric that failed, with its seed. The last line has the number of seeds that failed and the number of figures beyond a limit.
Exit code: 0 if at most 1 % of the seeds failed, 1 if more failed, 2 for wrong usage or a campaign that cannot be flown.
"""
import argparse
import json
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BENCH = ROOT / "build/default/hil-bench"
SUITES = sorted(file.parent for file in (ROOT / "bench/acceptance").glob("*/campaign.toml"))


def failed_metrics(suite, seed, folder):
    """Flies a suite's campaign with this seed. Returns ([text about each failed metric], number of metrics with a limit)."""
    copy = Path(folder, "acceptance", suite.name)
    shutil.rmtree(copy, ignore_errors=True)
    shutil.copytree(suite, copy, ignore=shutil.ignore_patterns("reference"))
    file, report = copy / "campaign.toml", copy / "report.json"
    file.write_text(re.sub(r"(?m)^seed = \d+", f"seed = {seed}", file.read_text(), count=1))
    finished = subprocess.run([str(BENCH), "campaign", str(file), "--json", str(report), "--out", str(copy / "results.sqlite")],
                              capture_output=True, text=True)
    if finished.returncode > 1:
        raise RuntimeError(f"{file}: {finished.stderr.strip()}")
    answers = [one for one in json.loads(report.read_text())["answers"] if "outcome" in one]
    return [f"{one['metric']}: {one['measured']}; expected {one['expected']}" for one in answers if one["outcome"] != "pass"], len(answers)


def main():
    parser = argparse.ArgumentParser(prog="false_alarms.py", description=__doc__.splitlines()[0])
    parser.add_argument("--seeds", metavar="N", type=int, default=200)
    parser.add_argument("--from", metavar="SEED", type=int, default=1, dest="first")
    parser.add_argument("--json", metavar="FILE", type=Path)
    asked = parser.parse_args()
    failed, bars = {}, 0
    with tempfile.TemporaryDirectory() as folder:
        shutil.copytree(ROOT / "bench/flights", Path(folder, "flights"))
        for seed in range(asked.first, asked.first + asked.seeds):
            if sys.stdout.isatty():
                print(f"\r\x1b[Kseed {seed}: {len(failed)} of {seed - asked.first} failed", end="", flush=True)
            for suite in SUITES:
                wrong, counted = failed_metrics(suite, seed, folder)
                bars += counted
                for line in wrong:
                    print(("\r\x1b[K" if sys.stdout.isatty() else "") + f"seed {seed}: {suite.name}: {line}", flush=True)
                    failed.setdefault(seed, []).append(f"{suite.name}: {line}")
    print(("\r\x1b[K" if sys.stdout.isatty() else "") + f"{len(failed)} of {asked.seeds} seeds failed; "
          f"{sum(len(lines) for lines in failed.values())} of {bars} figures were beyond a bar")
    if asked.json:
        asked.json.write_text(json.dumps({"seeds": asked.seeds, "from": asked.first, "bars": bars, "failed": failed}, indent=1) + "\n")
    return 0 if 100 * len(failed) <= asked.seeds else 1


if __name__ == "__main__":
    try:
        sys.exit(main())
    except (RuntimeError, OSError, ValueError) as error:
        print(f"false_alarms.py: {error}", file=sys.stderr)
        sys.exit(2)
