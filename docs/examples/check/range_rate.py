"""A check of one's own for hil-bench: the measured closing speed agrees with the slope of the true range.

    [[check]]
    kind = "program"
    command = "python3 range_rate.py --limit 5"

The bench adds two arguments: the JSON report and the CSV table of the run. The program prints a JSON array of judgements.
"""
import argparse
import csv
import json


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--limit", type=float, required=True, help="largest difference [m/s]")
    parser.add_argument("report")
    parser.add_argument("table")
    arguments = parser.parse_args()
    with open(arguments.report) as file:
        title = json.load(file)["title"]
    with open(arguments.table) as file:
        rows = [row for row in csv.DictReader(file) if row["estimator"] == "plant"]
    ranges = [(float(row["t_s"]), float(row["truth"])) for row in rows if row["quantity"] == "plant.range"]
    speeds = {float(row["t_s"]): float(row["truth"]) for row in rows if row["quantity"] == "plant.closing_speed"}
    worst, worst_at = 0.0, 0.0
    # Within the last metres the range is no straight line over a step.
    for (t, r), (t_next, r_next) in zip(ranges, ranges[1:]):
        if r_next < 100:
            break
        slope = (r - r_next) / (t_next - t)
        off = abs(slope - (speeds[t] + speeds[t_next]) / 2)
        if off > worst:
            worst, worst_at = off, t
    print(json.dumps([{
        "id": "closing speed",
        "outcome": "pass" if worst < arguments.limit else "fail",
        "measured": f"{worst:.3g} m/s of {len(ranges)} in '{title}'",
        "expected": f"< {arguments.limit:g} m/s",
        "quantity": "plant.closing_speed", "value": worst, "upper": arguments.limit, "upper_inclusive": False, "unit": "m/s",
        "worst_at_s": worst_at}]))


main()
