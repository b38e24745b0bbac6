"""The command line and the loop of the example devices. A device has receive(identifier, data), which yields the frames that answer a frame."""
import argparse

from canhil_target import open_bus  # SocketCAN or the bench's embedded bus


def serve(make, defects, fd=False):
    """Makes a device with the defect that the command line names, and lets it answer until the bus ends."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--bus", required=True)
    parser.add_argument("--defect", choices=defects, default="none")
    options = parser.parse_args()
    device, bus = make(options.defect), open_bus(options.bus, fd=fd)
    while (received := bus.receive()) is not None:
        for answer in device.receive(*received[:2]):
            bus.send(*answer)
