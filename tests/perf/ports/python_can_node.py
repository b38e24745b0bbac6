#!/usr/bin/python3
"""The same roles as in vcan_node.cpp, here with python-can, used as its documentation shows: python_can_node.py ROLE INTERFACE COUNT."""
import socket
import sys
import time

import can

PING, ECHO = 0x77, 0x78


def message(identifier, number):
    return can.Message(arbitration_id=identifier, data=number.to_bytes(8, "little"), is_extended_id=False)


def next_number(bus, identifier):
    while True:
        received = bus.recv()
        if received.arbitration_id == identifier:
            return int.from_bytes(received.data, "little")


def main():
    role, interface, count = sys.argv[1], sys.argv[2], int(sys.argv[3])
    bus = can.Bus(interface="socketcan", channel=interface)
    bus.socket.setsockopt(socket.SOL_SOCKET, 33, 64 << 20)  # SO_RCVBUFFORCE, as in vcan_node
    if role == "ping":
        for _ in sys.stdin:
            times_ns = []
            for n in range(count):
                start = time.monotonic_ns()
                bus.send(message(PING, n))
                next_number(bus, ECHO)
                times_ns.append(time.monotonic_ns() - start)
            print(*times_ns, flush=True)
    elif role == "echo":
        for _ in range(count):
            bus.send(message(ECHO, next_number(bus, PING)))
    elif role == "send":
        for n in range(count):
            bus.send(message(PING, n))
    elif role == "receive":
        print(sum(next_number(bus, PING) != n for n in range(count)))
    bus.shutdown()


if __name__ == "__main__":
    main()
