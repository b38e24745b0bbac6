#!/usr/bin/env python3
"""Does `hil-bench accept` pass correct filters of another maker, and fail them with a defect?

  python3 tests/independent/run.py [FILTER...] [--quick] [--jobs N]

The filters of this folder were written from docs/, the DBC and the corrected equations of the papers. Each must meet every requirement of its suite except those of
timing (Python is slow); with each defect of defects.DEFECTS, a requirement must fail.

FILTER      the filters to ask about; default: all
--quick     flies the quick scenario of each filter, and no suite; for a CI
--jobs      the number of questions that are asked at the same time

Exit code: 0 as it must be, 1 a filter fails or a defect passes, 2 wrong usage.
"""

import argparse
import concurrent.futures
import pathlib
import sys
import time

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent / "mutants"), str(HERE)]
import accepting  # noqa: E402
import defects  # noqa: E402

FILTERS = {"transfer_alignment": "transfer_alignment_quick", "inflight_alignment": "inflight_quick", "los_rate": "los_quick", "wind": "wind_quick"}
LONGEST_S = 7200  # a suite in Python
FAMILIES = (*accepting.CAMPAIGNS, *accepting.SINGLE_FLIGHTS)


def program_of(name, defect=None):
    return f"{accepting.PYTHON} {HERE / name}.py" + (f" --defect {defect}" if defect else "")


def asked_accept(name, defect):
    """Asks accept about a filter. Returns (whether the answer is the right one, a line about it)."""
    start = time.monotonic()
    code, wrong = accepting.accept(program_of(name, defect), name, FAMILIES, longest_s=LONGEST_S)
    right = code == (1 if defect else 0)
    seen = f"fails {wrong[0]}: {wrong[1]}" if wrong else "meets every requirement" if code == 0 else "not everything was measured"
    return right, f"{'ok ' if right else 'BAD'} {name:<20} {defect or 'correct':<14} {time.monotonic() - start:4.0f} s  {seen}"


def flown(name, _):
    """Flies the quick scenario of a filter in virtual time, which leaves checks of timing not measured: exit code 3."""
    scenario = accepting.ROOT / f"bench/flights/{FILTERS[name]}.toml"
    code, output = accepting.run([str(accepting.BENCH), "run", str(scenario), "--lockstep", "--target", program_of(name)], accepting.LONGEST_S)
    failed = [line.strip() for line in output.splitlines() if line.startswith("  FAIL")]
    return code == 3 and not failed, f"{name}: exit code {code}, expected 3 {'; '.join(failed)}"


def main():
    parser = argparse.ArgumentParser(prog="run.py", description=__doc__.splitlines()[0])
    parser.add_argument("filters", metavar="FILTER", nargs="*", help=f"of {', '.join(FILTERS)}; default: all")
    parser.add_argument("--quick", action="store_true", help="fly the quick scenario of each, and no suite")
    parser.add_argument("--jobs", metavar="N", type=int, default=1, help="how many are asked at once")
    asked = parser.parse_args()
    if unknown := set(asked.filters) - set(FILTERS):
        parser.error(f"no filter {sorted(unknown)[0]}, expected some of {', '.join(FILTERS)}")
    ask, wrong = (flown, ()) if asked.quick else (asked_accept, defects.DEFECTS)
    questions = [(name, defect) for name in asked.filters or FILTERS for defect in (None, *wrong)]
    with concurrent.futures.ThreadPoolExecutor(asked.jobs) as pool:
        right = []
        for ended in concurrent.futures.as_completed([pool.submit(ask, *question) for question in questions]):
            one, line = ended.result()
            print(line, flush=True)
            right.append(one)
    print(f"{sum(right)} of {len(right)} as it must be")
    return 0 if all(right) else 1


if __name__ == "__main__":
    sys.exit(main())
