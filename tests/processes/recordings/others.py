"""Reads and writes logs with python-can and decodes values with canmatrix. Tests compare these results with those of canhil.

others.py frames LOG            one line per frame: time in microseconds, id, flags, data (for a remote frame, the size that it requests)
others.py copy FROM TO          converts the log with python-can
others.py values LOG DBC        one line per frame: id, then each signal and its value
"""
import sys

import can
import canmatrix.formats


def frames(path):
    keep_time = {"relative_timestamp": False} if path.endswith(".asc") else {}
    with can.LogReader(path, **keep_time) as log:
        yield from log


def flags(message):
    names = (("x", message.is_extended_id), ("e", message.is_error_frame), ("r", message.is_remote_frame),
             ("f", message.is_fd), ("b", message.bitrate_switch), ("s", message.error_state_indicator))
    return "".join(letter for letter, there in names if there) or "-"


def main(what, source, *rest):
    if what == "frames":
        for message in frames(source):
            data = message.dlc if message.is_remote_frame else message.data.hex() or "-"
            print(round(message.timestamp * 1e6), f"{message.arbitration_id:X}", flags(message), data)
    elif what == "copy":
        with can.Logger(rest[0]) as logger:
            for message in frames(source):
                if rest[0].endswith(".trc"):
                    message.channel = 1  # python-can writes only numbers
                logger(message)
    else:
        database = canmatrix.formats.loadp_flat(rest[0])
        by_id = {frame.arbitration_id.id: frame for frame in database.frames if not frame.arbitration_id.extended}
        for message in frames(source):
            frame = by_id[message.arbitration_id]
            values = frame.decode(bytes(message.data))
            print(frame.name, " ".join(f"{name}={float(values[name].phys_value)!r}" for name in sorted(values)))


main(*sys.argv[1:])
