"""Starts hil-bench with a live view, and implements HTTP and WebSocket clients with plain sockets."""

import base64
import json
import os
import pathlib
import re
import socket
import struct
import subprocess
import tempfile
import threading
import time
import urllib.parse

ROOT = pathlib.Path(__file__).resolve().parents[3]
FLIGHTS = ROOT / "bench/flights"
PATIENCE_S = 60


class Bench:
    """Runs hil-bench with these arguments and --live 0, in `folder` or in a new folder. Kills it at the end of the with block."""

    def __init__(self, program, *arguments, live=("--live", "0"), hurried=True, folder=None):
        self.hurried = hurried
        self.errors = tempfile.NamedTemporaryFile("w+", suffix=".err")
        self.folder = tempfile.TemporaryDirectory()
        self.process = subprocess.Popen([program, *map(str, arguments), *live], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                        stderr=self.errors, text=True, cwd=folder or self.folder.name)

    def __enter__(self):
        self.url = self.await_line(r"live at (http://\S+)")
        parts = urllib.parse.urlsplit(self.url)
        self.port, self.query = parts.port, "?" + parts.query if parts.query else ""
        threading.Thread(target=self.hurry, daemon=True).start()
        return self

    def hurry(self):
        """Gives the thread of the live view the normal scheduling policy. In a run in real time this thread has
        SCHED_IDLE, with which it might never run on a busy host."""
        while self.hurried and self.process.poll() is None:
            for thread in os.listdir(f"/proc/{self.process.pid}/task"):
                try:
                    if os.sched_getscheduler(int(thread)) == os.SCHED_IDLE:
                        os.sched_setscheduler(int(thread), os.SCHED_OTHER, os.sched_param(0))
                except (PermissionError, ProcessLookupError):
                    pass
            time.sleep(0.05)

    def await_line(self, pattern):
        until = time.monotonic() + PATIENCE_S
        while time.monotonic() < until:
            self.errors.seek(0)
            if found := re.search(pattern, self.errors.read()):
                return found[1]
            if self.process.poll() is not None:
                break
            time.sleep(0.02)
        self.errors.seek(0)
        raise AssertionError(f"no '{pattern}' within {PATIENCE_S} s: {self.errors.read()}")

    def end(self):
        """Waits for the end of a bench that ends by itself. Returns (exit code, standard output)."""
        out, _ = self.process.communicate(timeout=PATIENCE_S)
        return self.process.returncode, out

    def interrupt(self):
        self.process.send_signal(2)
        return self.end()

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.process.kill()
        self.process.communicate()
        self.errors.close()
        self.folder.cleanup()


def connect(port):
    return socket.create_connection(("127.0.0.1", port), timeout=PATIENCE_S)


def exchange(port, request):
    """Sends these bytes. Returns (status, headers, body) of the response; status 0: no response."""
    with connect(port) as one:
        one.sendall(request)
        answer = b""
        try:
            while part := one.recv(65536):
                answer += part
        except ConnectionResetError:
            pass
    if not answer:
        return 0, {}, b""
    head, _, body = answer.partition(b"\r\n\r\n")
    lines = head.decode("latin-1").split("\r\n")
    headers = {name.lower(): value.strip() for name, _, value in (line.partition(":") for line in lines[1:])}
    return int(lines[0].split()[1]), headers, body


def get(port, target="/", method="GET", **headers):
    headers.setdefault("Host", f"127.0.0.1:{port}")
    lines = "".join(f"{name}: {value}\r\n" for name, value in headers.items() if value is not None)
    return exchange(port, f"{method} {target} HTTP/1.1\r\n{lines}\r\n".encode("latin-1"))


class WebSocket:
    """A WebSocket client. Raises ConnectionError with the HTTP status if the bench refuses the connection."""

    def __init__(self, port, target="/live", **headers):
        self.socket = connect(port)
        headers = {"Host": f"127.0.0.1:{port}", "Origin": f"http://127.0.0.1:{port}", **headers}
        key = base64.b64encode(os.urandom(16)).decode()
        lines = "".join(f"{name}: {value}\r\n" for name, value in headers.items())
        self.socket.sendall(f"GET {target} HTTP/1.1\r\n{lines}Upgrade: websocket\r\nConnection: Upgrade\r\n"
                            f"Sec-WebSocket-Key: {key}\r\nSec-WebSocket-Version: 13\r\n\r\n".encode())
        self.file = self.socket.makefile("rb")
        status = self.file.readline().split()
        if len(status) < 2 or status[1] != b"101":
            self.close()
            raise ConnectionError(int(status[1]) if len(status) > 1 else 0)
        while self.file.readline().strip():
            pass

    def message(self):
        """The next message as JSON; None: the bench has closed the connection."""
        while True:
            try:
                head = self.file.read(2)
            except ConnectionResetError:
                return None
            if len(head) < 2:
                return None
            last, kind, length = head[0] & 0x80, head[0] & 0x0F, head[1] & 0x7F
            if length >= 126:
                size = 2 if length == 126 else 8
                length = int.from_bytes(self.file.read(size), "big")
            data = self.file.read(length)
            if kind == 8:
                return None
            if kind in (0, 1):  # 1: text, the first part of a message; 0: a further part
                self.parts = (self.parts if kind == 0 else b"") + data
                if last:
                    return json.loads(self.parts)
            if kind == 9:  # ping
                self.send(data, kind=10)

    def send(self, data, kind=1):
        mask = os.urandom(4)
        self.socket.sendall(struct.pack("!BB", 0x80 | kind, 0x80 | len(data)) + mask +
                            bytes(byte ^ mask[i % 4] for i, byte in enumerate(data)))

    def until_over(self):
        """Receives messages until the end of the run. Returns the last one, which has all points of the series."""
        last = None
        while (message := self.message()) is not None:
            last = message
            if message["over"]:
                break
        return last

    def close(self):
        if hasattr(self, "file"):
            self.file.close()
        self.socket.close()
