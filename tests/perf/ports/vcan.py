#!/usr/bin/python3
"""Compares the SocketCAN port with can-utils and python-can, in one run on virtual interfaces.

  tests/vcan/run.sh /usr/bin/python3 tests/perf/ports/vcan.py build/measured/tests/perf/ports/vcan_node [ROUNDS]

Round trip: one program sends a frame, another program answers it. Every such pair has an interface of its own. All pairs are started at the beginning
and take turns in short blocks of round trips, so that other load of the machine affects all of them equally.
Throughput: a sender sends a burst to a receiver whose queue can contain the whole burst. The result is the shortest time of all rounds, minus the
shortest time for a burst of one frame, which is mainly the start-up time of the programs.
Prints figures and ratios without a verdict; fails if a program did not run.
"""
import pathlib
import subprocess
import sys
import time

BLOCK = 50  # round trips per block
BURST = 20000
PYTHON = [sys.executable, str(pathlib.Path(__file__).with_name("python_can_node.py"))]
RECEIVE_BYTES = str(64 << 20)


def listeners():
    text = "".join(pathlib.Path(f"/proc/net/can/rcvlist_{part}").read_text() for part in ("all", "fil", "inv", "sff", "eff"))
    return text.count(" raw")


def start(command, **options):
    """Starts a program that receives frames, and waits until the program listens on its interface."""
    before = listeners()
    process = subprocess.Popen(command, text=True, **options)
    while listeners() <= before:
        if process.poll() is not None:
            sys.exit(f"{command} ended with {process.returncode} before it listened")
        time.sleep(0.002)
    return process


class Pair:
    """Two programs on their own interface."""

    def __init__(self, interface, ping, echo):
        subprocess.run(f"ip link add dev {interface} type vcan && ip link set {interface} up", shell=True, check=True)
        self.echo = start([interface if word == "IF" else word for word in echo],
                          stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
        self.ping = start([interface if word == "IF" else word for word in ping],
                          stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.times_us = []

    def block(self):
        self.ping.stdin.write("\n")
        self.ping.stdin.flush()
        return [int(word) / 1000 for word in self.ping.stdout.readline().split()]

    def stop(self):
        self.ping.stdin.close()
        self.ping.wait()
        self.echo.kill()
        self.echo.wait()


def round_trips(node, rounds):
    def ours(role, kind, count):
        return [node, role, kind, "IF", str(count)]

    def python(role, count):
        return PYTHON + [role, "IF", str(count)]

    many = 10**9
    pairs = {
        "raw socket - raw socket": (ours("ping", "raw", BLOCK), ours("echo", "raw", many)),
        "raw socket - canfdtest": (ours("ping", "raw", BLOCK), ["canfdtest", "IF"]),
        "raw socket - port": (ours("ping", "raw", BLOCK), ours("echo", "port", many)),
        "raw socket - python-can": (ours("ping", "raw", BLOCK), python("echo", many)),
        "port - port": (ours("ping", "port", BLOCK), ours("echo", "port", many)),
        "python-can - python-can": (python("ping", BLOCK), python("echo", many)),
    }
    running = {name: Pair(f"perf{n}", *pair) for n, (name, pair) in enumerate(pairs.items())}
    for turn in range(rounds * 20 + 1):
        for pair in running.values():
            times = pair.block()
            if len(times) != BLOCK:
                sys.exit(f"{pair.ping.args}: {len(times)} round trips, expected {BLOCK}")
            if turn > 0:  # discards the first block as a warm-up
                pair.times_us += times
    p50, p99 = {}, {}
    print(f"{'round trip [us]':<36}{'p50':>9}{'p99':>9}{'max':>10}{'count':>8}")
    for name, pair in running.items():
        pair.stop()
        sample = sorted(pair.times_us)
        p50[name], p99[name] = sample[len(sample) // 2], sample[len(sample) * 99 // 100]
        print(f"  {name:<34}{p50[name]:>9.1f}{p99[name]:>9.1f}{sample[-1]:>10.1f}{len(sample):>8}")

    def compare(what, name, to):
        print(f"  {what:<48}p50 {p50[name] / p50[to]:.3f}  p99 {p99[name] / p99[to]:.3f}")

    compare("answered by the port, over canfdtest", "raw socket - port", "raw socket - canfdtest")
    compare("answered by the port, over python-can", "raw socket - port", "raw socket - python-can")
    compare("both ends the port, over raw sockets", "port - port", "raw socket - raw socket")
    compare("both ends the port, over python-can", "port - port", "python-can - python-can")


def chain(send, receive):
    """Runs a sender and a receiver. Returns the time [s] from the start of the sender to the end of the receiver, and what the receiver printed: the
    number of frames that it missed or received in the wrong order. None: it does not print this number."""
    receiving = start(receive, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE)
    begin = time.monotonic()
    subprocess.run(send, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, check=True, timeout=120)
    out, _ = receiving.communicate(timeout=120)
    took = time.monotonic() - begin
    if receiving.returncode != 0:
        sys.exit(f"{receive} ended with {receiving.returncode}")
    return took, int(out) if out.strip() else None


def throughput(node, rounds):
    interface = "vcan0"

    def ours(role):
        return lambda count: [node, role, "port", interface, str(count)]

    def python(role):
        return lambda count: PYTHON + [role, interface, str(count)]

    def cangen(count):
        return ["cangen", interface, "-g", "0", "-n", str(count), "-I", "77", "-L", "8", "-D", "i"]

    def candump(count):
        return ["candump", "-s", "2", "-r", RECEIVE_BYTES, "-n", str(count), interface]

    chains = {
        "cangen -> candump": (cangen, candump),
        "port -> port": (ours("send"), ours("receive")),
        "cangen -> port": (cangen, ours("receive")),
        "port -> candump": (ours("send"), candump),
        "python-can -> python-can": (python("send"), python("receive")),
    }
    whole = {name: [] for name in chains}
    alone = {name: [] for name in chains}
    dropped = {name: 0 for name in chains}
    for _ in range(rounds):
        for name, (send, receive) in chains.items():
            alone[name].append(chain(send(1), receive(1))[0])
            took, missed = chain(send(BURST), receive(BURST))
            whole[name].append(took)
            dropped[name] = None if missed is None else dropped[name] + missed
    best = {name: BURST / (min(whole[name]) - min(alone[name])) for name in chains}
    print(f"{f'throughput, {rounds} bursts of {BURST}':<36}{'frames/s':>9}{'dropped':>9}")
    for name, rate in best.items():
        print(f"  {name:<34}{rate:>9.0f}{'unknown' if dropped[name] is None else dropped[name]:>9}")
    print(f"  {'the port, over can-utils':<48}{best['port -> port'] / best['cangen -> candump']:.3f}")
    print(f"  {'the port, over python-can':<48}{best['port -> port'] / best['python-can -> python-can']:.3f}")


def main():
    rounds = int(sys.argv[2]) if len(sys.argv) > 2 else 10
    round_trips(sys.argv[1], rounds)
    throughput(sys.argv[1], rounds)


if __name__ == "__main__":
    main()
