"""Compares canhil's reading of a DBC file, and its decoding of random frames, with canmatrix's.

usage: compare_with_canmatrix.py DBCGEN DECODE_FRAMES FILE.dbc
Prints every difference; exit status 1 if there is one.
"""
import json
import logging
import math
import random
import subprocess
import sys

logging.disable(logging.CRITICAL)
import canmatrix.formats  # noqa: E402

differences = []


def expect(where, ours, theirs):
    if ours != theirs:
        differences.append(f"{where}: canhil {ours!r}, canmatrix {theirs!r}")


def unlimited_as_canmatrix(minimum, maximum, signal):
    """canmatrix writes the raw range's limits where the DBC says [0|0]; no limits are no limits."""
    return (None, None) if minimum == maximum == 0 else (minimum, maximum)


def compare_signal(where, ours, theirs):
    expect(where + " length", ours["length"], theirs.size)
    start = theirs.get_startbit(bit_numbering=1, start_little=None) if theirs.is_little_endian \
        else theirs.get_startbit(bit_numbering=1)
    expect(where + " start", ours["start_bit"], start)
    expect(where + " Motorola", ours["big_endian"], not theirs.is_little_endian)
    expect(where + " float", ours["float"], theirs.is_float)
    if not ours["float"]:
        expect(where + " signed", ours["signed"], theirs.is_signed)
    expect(where + " scale", ours["scale"], float(theirs.factor))
    expect(where + " offset", ours["offset"], float(theirs.offset))
    if ours["minimum"] != 0 or ours["maximum"] != 0:
        expect(where + " minimum", ours["minimum"], float(theirs.min))
        expect(where + " maximum", ours["maximum"], float(theirs.max))
    expect(where + " unit", ours["unit"], theirs.unit)
    expect(where + " receivers", sorted(ours["receivers"]), sorted(r for r in theirs.receivers if r != "Vector__XXX"))
    expect(where + " values", ours["values"], {str(k): v for k, v in theirs.values.items()})
    expect(where + " comment", ours["comment"].splitlines(), (theirs.comment or "").splitlines())
    expect(where + " multiplexor", ours["multiplexor"], bool(theirs.is_multiplexer))
    ranges = [list(r) for r in theirs.mux_val_grp]
    if not ranges and theirs.mux_val is not None:
        ranges = [[theirs.mux_val, theirs.mux_val]]
    expect(where + " multiplexed when", ours["mux_ranges"], ranges)


def compare_message(ours, theirs):
    where = ours["name"]
    expect(where + " name", ours["name"], theirs.name)
    expect(where + " size", ours["size"], theirs.size)
    expect(where + " FD", ours["fd"], theirs.is_fd)
    expect(where + " comment", ours["comment"].splitlines(), (theirs.comment or "").splitlines())
    expect(where + " cycle time", ours["cycle_time_us"], int(theirs.cycle_time) * 1000)
    senders = ([ours["sender"]] if ours["sender"] else []) + ours["further_senders"]
    expect(where + " senders", sorted(senders), sorted(t for t in theirs.transmitters if t != "Vector__XXX"))
    expect(where + " signals", [s["name"] for s in ours["signals"]], [s.name for s in theirs.signals])
    for signal, other in zip(ours["signals"], theirs.signals):
        compare_signal(f"{where}.{signal['name']}", signal, other)


def raw_of(signal, data):
    """The signal's raw bits by the DBC's definition of bit order, with canmatrix's idea of where the signal is."""
    value = 0
    if signal.is_little_endian:
        word = int.from_bytes(data, "little")
        return (word >> signal.start_bit) & ((1 << signal.size) - 1)
    word = int.from_bytes(data, "big")
    return (word >> (8 * len(data) - signal.start_bit - signal.size)) & ((1 << signal.size) - 1)


def compare_frames(decoder, file, matrix):
    generator = random.Random(20)
    frames = []
    for message in matrix.frames:
        for _ in range(200):
            frames.append((message, bytes(generator.randrange(256) for _ in range(message.size))))
    lines = []
    for message, data in frames:
        flag = 0x80000000 if message.arbitration_id.extended else 0
        lines.append(f"{message.arbitration_id.id | flag:X}#{data.hex()}")
    output = subprocess.run([decoder, file], input="\n".join(lines) + "\n", text=True, capture_output=True, check=True)
    answers = output.stdout.splitlines()
    expect("number of frames decoded", len(answers), len(frames))
    values = 0
    for (message, data), line, answer in zip(frames, lines, answers):
        ours = json.loads(answer)
        try:
            theirs = message.decode(data)
        except Exception as error:  # noqa: BLE001: a page without signals; counted below
            theirs = None
            if not any(s.is_multiplexer for s in message.signals):
                differences.append(f"{line}: canmatrix cannot decode: {error}")
        if theirs is None:
            continue
        if not any(s.muxer_for_signal for s in message.signals):
            expect(f"{line} {message.name} signals", sorted(ours), sorted(theirs))
        for name, decoded in theirs.items():
            if name not in ours:
                differences.append(f"{line} {message.name}.{name}: not decoded by canhil")
                continue
            signal = decoded.signal
            ours_value, theirs_value = float(ours[name]), float(decoded.phys_value)
            # canmatrix computes in decimals and rounds at the end; one rounding of each operation separates us.
            close = math.isclose(ours_value, theirs_value, rel_tol=1e-12, abs_tol=abs(float(signal.factor)) * 1e-9)
            if not close and not (math.isnan(ours_value) and math.isnan(theirs_value)):
                differences.append(f"{line} {message.name}.{name}: canhil {ours_value}, canmatrix {theirs_value}")
            values += 1
    return len(frames), values


def main(dbcgen, decoder, file):
    ours = json.loads(subprocess.run([dbcgen, "--json", file], text=True, capture_output=True, check=True).stdout)
    matrix = next(iter(canmatrix.formats.loadp(file).values()))
    matrix.frames = [f for f in matrix.frames if f.name != "VECTOR__INDEPENDENT_SIG_MSG"]
    expect("nodes", [n["name"] for n in ours.get("nodes", [])], [e.name for e in matrix.ecus if e.name != "Vector__XXX"])
    expect("messages", len(ours["messages"]), len(matrix.frames))
    for message in ours["messages"]:
        identifier = canmatrix.ArbitrationId(message["id"], extended=message["extended"])
        frame = matrix.frame_by_id(identifier)
        if frame is None:
            differences.append(f"{message['name']}: canmatrix has no such message")
            continue
        compare_message(message, frame)
    frames, values = compare_frames(decoder, file, matrix)
    for difference in differences:
        print(difference)
    print(f"{len(ours['messages'])} messages, {frames} frames, {values} values, {len(differences)} differences")
    return 1 if differences or values == 0 else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
