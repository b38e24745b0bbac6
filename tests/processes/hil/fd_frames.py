"""Compares the CAN FD frames of a run, as canmatrix decodes them, with the classic frames of the same run.

usage: fd_frames.py WIRE.log CLASSIC.log CANHIL_FD.dbc CANHIL.dbc DECODE_FRAMES
WIRE.log: the frames on the bus. CLASSIC.log: the log of hil-bench run --log, decoded by canhil's own codec.
For every classic message, the two files must contain the same sequence of values. Prints the number of compared frames.
"""

import collections
import json
import math
import re
import subprocess
import sys

sys.dont_write_bytecode = True
import canmatrix.formats  # noqa: E402


def frames_of(path):
    """(id, flags, data) of every line "(time) bus ID#DATA" (classic; flags: None) or "(time) bus ID##FDATA" (CAN FD; flags: F)."""
    for line in open(path, encoding="ascii"):
        identifier, _, rest = line.split()[2].partition("#")
        fd = rest.startswith("#")
        yield int(identifier, 16), int(rest[1], 16) if fd else None, bytes.fromhex(rest[2:] if fd else rest)


def on_the_wire(path, dbc):
    """values[classic message][signal]: the list of its values. Some messages are in containers, others have an FD frame of their own."""
    matrix = next(iter(canmatrix.formats.loadp(dbc).values()))
    values = collections.defaultdict(lambda: collections.defaultdict(list))
    for identifier, flags, data in frames_of(path):
        assert flags is not None and flags & 1, f"{identifier:x}: expected a CAN FD frame with BRS"
        frame = matrix.frame_by_id(canmatrix.ArbitrationId(identifier))
        assert frame.is_fd and frame.size == len(data), f"{frame.name}: {len(data)} bytes, expected {frame.size}"
        decoded = frame.decode(data)
        groups = {group.name: group.signals for group in frame.signalGroups} or {frame.name: frame.signals}
        for message, signals in groups.items():
            for signal in signals:
                values[message][re.sub(r"_\d+$", "", signal.name)].append(float(decoded[signal.name].phys_value))
    return values


def classic_view(path, dbc, decoder):
    matrix = next(iter(canmatrix.formats.loadp(dbc).values()))
    lines = [(identifier, data) for identifier, _, data in frames_of(path)]
    text = "".join(f"{identifier:X}#{data.hex()}\n" for identifier, data in lines)
    output = subprocess.run([decoder, dbc], input=text, text=True, capture_output=True, check=True).stdout
    values = collections.defaultdict(lambda: collections.defaultdict(list))
    for (identifier, _), answer in zip(lines, output.splitlines(), strict=True):
        message = matrix.frame_by_id(canmatrix.ArbitrationId(identifier)).name
        for name, value in json.loads(answer).items():
            values[message][name].append(float(value))
    return values


def main(wire, classic, fd_dbc, classic_dbc, decoder):
    theirs, ours = on_the_wire(wire, fd_dbc), classic_view(classic, classic_dbc, decoder)
    compared = 0
    for message, signals in ours.items():
        for name, values in signals.items():
            there = theirs[message][name]
            # The log of the bus also has frames that were sent before the log of the bench begins or after it ends.
            begin = next((i for i in range(len(there) - len(values) + 1)
                          if all(math.isclose(a, b, rel_tol=1e-12, abs_tol=1e-12)
                                 for a, b in zip(there[i:], values))), None)
            if begin is None or len(there) - len(values) > 100:
                print(f"{message}.{name}: {len(there)} values on the wire, {len(values)} in the log, not the same")
                return 1
            compared += len(values)
    print(compared)
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
