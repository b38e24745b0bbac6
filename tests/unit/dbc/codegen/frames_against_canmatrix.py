"""Checks that canhil and canmatrix decode the same values from random frames, and encode the same bytes.

usage: frames_against_canmatrix.py DECODE_FRAMES FRAMES FILE.dbc...
FRAMES is the total number of frames for the messages of all files. One half are random bytes, which are decoded. The other half are encoded by canmatrix
from random raw values within the limits of the signals; they are decoded, and the decoded values are encoded again.
Prints every disagreement once per signal or message, with the number of frames and an example; exit status 1 if there is one.
"""
import collections
import decimal
import io
import json
import logging
import math
import random
import struct
import subprocess
import sys

logging.disable(logging.CRITICAL)
import canmatrix.formats  # noqa: E402

LARGEST_EXACT = 1 << 48  # up to about this raw value, doubles with scale and offset are exact

counts = collections.Counter()
disagreements = {}


def disagree(where, kind, example):
    counts["disagreements"] += 1
    number, first = disagreements.get((where, kind), (0, example))
    disagreements[where, kind] = (number + 1, first)


def raw_limits(signal):
    """The raw values that the signal's bits, minimum and maximum allow; canmatrix adds limits that the DBC does not define."""
    lowest, highest = (-(1 << signal.size - 1), (1 << signal.size - 1) - 1) if signal.is_signed else (0, (1 << signal.size) - 1)
    low, high = sorted((bound - signal.offset) / signal.factor for bound in (signal.min, signal.max))
    if not (signal.min == signal.max == 0):
        lowest = max(lowest, int(low.to_integral_value(decimal.ROUND_CEILING)))
        highest = min(highest, int(high.to_integral_value(decimal.ROUND_FLOOR)))
    return max(lowest, -LARGEST_EXACT), min(highest, LARGEST_EXACT)


def random_raw(generator, signal):
    """A random raw value within the limits; None: no value is allowed."""
    if signal.is_float:
        low, high = (float(b) for b in (signal.min, signal.max))
        value = (generator.uniform(max(low, -1e30), min(high, 1e30)) - float(signal.offset)) / float(signal.factor)
        return struct.unpack("f", struct.pack("f", value))[0] if signal.size == 32 else value
    lowest, highest = raw_limits(signal)
    return generator.randint(lowest, highest) if lowest <= highest else None


def encoded_by_canmatrix(generator, message):
    """Bytes of a frame with random values; None: canmatrix cannot determine which signals are in the frame."""
    multiplexors = {s.name: random_raw(generator, s) for s in message.signals if s.is_multiplexer}
    for name in multiplexors:  # mostly values that select a signal
        asked = [v for s in message.signals if s.muxer_for_signal in (name, None)
                 for v in ([s.mux_val] if s.mux_val is not None else []) + [r[0] for r in s.mux_val_grp]]
        if asked and generator.random() < 0.8:
            multiplexors[name] = generator.choice(asked)
    if None in multiplexors.values():
        return None
    present = message.decode(bytes(message.signals_to_bytes(multiplexors)))
    raw = {n: multiplexors[n] if n in multiplexors else random_raw(generator, d.signal) for n, d in present.items()}
    if None in raw.values():
        return None
    data = bytes(message.signals_to_bytes(raw))
    again = message.decode(data)
    if any(n not in again or again[n].raw_value != v for n, v in raw.items()):
        return None  # overlapping signals: the bytes cannot hold all of them
    return data


def compare_values(where, line, ours, theirs):
    for name in ours.keys() - theirs.keys():
        disagree(f"{where}.{name}", "only canhil decodes it", line)
    for name, decoded in theirs.items():
        if name not in ours:
            disagree(f"{where}.{name}", "only canmatrix decodes it", line)
            continue
        signal = decoded.signal
        ours_value, theirs_value = float(ours[name]), float(decoded.phys_value)
        # canmatrix computes in decimals and rounds at the end, so the results may differ by the rounding of
        # each operation.
        close = math.isclose(ours_value, theirs_value, rel_tol=1e-12, abs_tol=abs(float(signal.factor)) * 1e-9)
        if not close and not (math.isnan(ours_value) and math.isnan(theirs_value)):
            disagree(f"{where}.{name}", "value", f"{line}: canhil {ours_value}, canmatrix {theirs_value}")
        counts["values"] += 1


def frames_of(generator, message, number):
    """(data, whether canmatrix encoded it) of `number` random frames."""
    for i in range(number):
        data = None
        if i % 2:
            try:
                data = encoded_by_canmatrix(generator, message)
            except Exception as error:  # noqa: BLE001: any exception is a disagreement
                disagree(message.name, f"canmatrix cannot encode: {error}", "")
        yield (data, True) if data is not None else (bytes(generator.randrange(256) for _ in range(message.size)), False)


def compare_file(decoder, file, matrix, per_message):
    generator = random.Random(file.rsplit("/", 1)[-1])
    if not matrix.frames:
        return
    frames = [(message, *frame) for message in matrix.frames for frame in frames_of(generator, message, per_message)]
    lines = []
    for message, data, _ in frames:
        flag = 0x80000000 if message.arbitration_id.extended else 0
        lines.append(f"{message.arbitration_id.id | flag:X}#{data.hex()}")
    run = subprocess.run([decoder, "--encode", file], input="\n".join(lines) + "\n", text=True, capture_output=True)
    if run.returncode != 0:
        disagree(file, "canhil refuses the file", run.stderr.strip())
        return
    answers = run.stdout.splitlines()
    if len(answers) != len(frames):
        disagree(file, f"{len(answers)} of {len(frames)} frames answered", "")
    for (message, data, encoded), line, answer in zip(frames, lines, answers):
        where = f"{file}: {message.name}"
        ours = json.loads(answer)
        if not isinstance(ours, dict):
            disagree(where, f"canhil does not decode it: {ours}", line)
            continue
        try:
            theirs = message.decode(data)
        except Exception as error:  # noqa: BLE001: any exception is a disagreement
            disagree(where, f"canmatrix cannot decode: {type(error).__name__} {error}", line)
            continue
        counts["frames decoded"] += 1
        compare_values(where, line, ours["values"], theirs)
        if encoded:
            counts["frames encoded"] += 1
            if ours["bytes"] != data.hex():
                disagree(where, "bytes", f"{line}: canhil {ours['bytes']}")


def matrix_of(file):
    """The file as canmatrix reads it, with the signal names of SG_ and not the long names from attributes."""
    with open(file, "rb") as text:
        without = text.read().replace(b"LongSymbol", b"LongSymbo1")
    return next(iter(canmatrix.formats.load(io.BytesIO(without), "dbc").values()))


def main(decoder, frames, *files):
    matrices = {}
    for file in files:
        try:
            matrix = matrix_of(file)
        except Exception as error:  # noqa: BLE001: any exception means that canmatrix cannot read the file
            print(f"{file}: canmatrix cannot read it: {type(error).__name__} {error}")
            counts["files that canmatrix cannot read"] += 1
            continue
        matrix.frames = [f for f in matrix.frames if f.name != "VECTOR__INDEPENDENT_SIG_MSG"]
        matrices[file] = matrix
    messages = sum(len(m.frames) for m in matrices.values())
    for file, matrix in matrices.items():
        compare_file(decoder, file, matrix, math.ceil(int(frames) / max(messages, 1)))
    for (where, kind), (number, example) in disagreements.items():
        print(f"{where}: {kind}; {number} frames, such as {example}")
    print(f"{len(matrices)} files, {messages} messages, " + ", ".join(f"{n} {what}" for what, n in sorted(counts.items())))
    return 1 if counts["disagreements"] or counts["values"] == 0 or counts["frames encoded"] == 0 else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
