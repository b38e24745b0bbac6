"""Compares canhil's reading of a DBC file with canmatrix's.

usage: compare_with_canmatrix.py DBCGEN FILE.dbc
Prints every difference; exit status 1 if there is one.
"""
import json
import logging
import subprocess
import sys

logging.disable(logging.CRITICAL)
import canmatrix.formats  # noqa: E402

differences = []


def expect(where, ours, theirs):
    if ours != theirs:
        differences.append(f"{where}: canhil {ours!r}, canmatrix {theirs!r}")


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


def main(dbcgen, file):
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
    for difference in differences:
        print(difference)
    signals = sum(len(m["signals"]) for m in ours["messages"])
    print(f"{len(ours['messages'])} messages, {signals} signals, {len(differences)} differences")
    return 1 if differences or signals == 0 else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
