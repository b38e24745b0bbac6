"""The command line and the loop of the example devices. A device has receive(identifier, data), which yields the frames that answer a frame."""
import argparse
import select

from canhil_target import open_bus  # SocketCAN or the bench's embedded bus


def serve(make, defects, fd=False):
    """Makes a device with the defect that the command line names, and lets it answer until a bus ends. It listens on all buses and answers on the first."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--bus", action="append", required=True)
    parser.add_argument("--defect", choices=defects, default="none")
    options = parser.parse_args()
    device, buses = make(options.defect), [open_bus(name, fd=fd) for name in options.bus]
    while True:
        ready = select.select([bus.socket for bus in buses], [], [])[0]
        for bus in buses:
            if bus.socket not in ready:
                continue
            if (received := bus.receive()) is None:
                return
            for answer in device.receive(*received[:2]):
                buses[0].send(*answer)
