"""Prints the first frames of a recorded run as text, one line per frame, for docs/own-target.md: annotate.py KIT_FOLDER LOG FRAMES.

The text omits what differs from run to run: the stamps, TargetTiming, and all frames before the bench's first command."""

import re
import sys

sys.path.insert(0, sys.argv[1])
from canhil_target import MESSAGES, decode  # noqa: E402
from canhil_messages import FROM_TARGET  # noqa: E402

NOTES = {
    ("TargetCommand", "reset"): "the bench selects estimator and algorithm, and repeats this until a heartbeat confirms it",
    ("TargetHeartbeat", "idle"): "the reset is confirmed; it cleared all state, including the counters",
    "ParamSet": "the parameters, one by one",
    "ParamAck": "the reply carries the value in force",
    "TargetInitLatitude": "the initial state: one sample group",
    ("TargetHeartbeat", "ready"): "the group was complete: the target is ready",
    ("TargetCommand", "start"): "start; the target resets its transmit counters",
    ("TargetHeartbeat", "running"): "from now on the target answers samples",
    "SeekerAntenna": "a sample: four messages with one counter; the last one carries the time",
    "LosRateEstimate": "the answer to the first sample, with its counter and time",
    "Sync": "the time base; in lockstep, Sync ends a step ...",
    "StepDone": "... and the target confirms it",
    "TargetCounters": "counts of lost frames; in a run they follow each periodic heartbeat",
}


def shown(value):
    return value if isinstance(value, str) else f"{value:.6g}" if isinstance(value, float) else str(value)


def main():
    annotated = set()
    left = int(sys.argv[3])
    begun = False
    for line in open(sys.argv[2], encoding="ascii"):
        identifier, data = re.search(r" ([0-9A-F]{3})#([0-9A-F]*)", line).groups()
        group, _, (name, _, _, _, signals) = MESSAGES[int(identifier, 16)]
        begun = begun or name == "TargetCommand"
        if not begun or name == "TargetTiming":
            continue
        values = decode(bytes.fromhex(data), signals)
        key = next((k for k in ((name, values.get("command")), (name, values.get("state")), name) if k in NOTES), None)
        if key not in annotated and key is not None:
            print(f"                                            -- {NOTES[key]}")
        annotated.add(key)
        if "dbc_hash" in values:
            values["dbc_hash"] = f"{values['dbc_hash']:06x}"
        said = ", ".join(f"{signal} {shown(value)}" for signal, value in values.items()
                         if value or name != "TargetHeartbeat")  # leaves out a heartbeat's signals that are 0
        side = "target" if group in FROM_TARGET else "bench "
        print(f"{side}  {identifier}#{data}  {name}: {said}")
        left -= 1
        if left == 0:
            return


main()
