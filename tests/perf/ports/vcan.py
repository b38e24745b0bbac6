#!/usr/bin/python3
"""The SocketCAN port beside can-utils and python-can, on vcan0, in one run.

  tests/vcan/run.sh python3 tests/perf/ports/vcan.py build/default/tests/perf/ports/vcan_node [ROUNDS]

Round trip: somebody sends a frame, somebody answers it; all pairs take turns, so that whatever else the machine does meets all.
Throughput: a burst through sender and receiver, receive queues large enough for all of it; the time of a burst of one frame,
which is that of starting the programs, is taken off. Prints figures and ratios, judges nothing; fails where something did not run.
"""
import pathlib
import statistics
import subprocess
import sys
import time

INTERFACE = "vcan0"
TRIPS = 1000  # of one round
BURST = 20000
PYTHON = [sys.executable, str(pathlib.Path(__file__).with_name("python_can_node.py"))]
RECEIVE_BYTES = str(64 << 20)


def listeners():
    text = "".join(pathlib.Path(f"/proc/net/can/rcvlist_{part}").read_text() for part in ("all", "fil", "inv", "sff", "eff"))
    return text.count(" raw")


def start(command, **options):
    """Starts a program that listens, and waits until it does."""
    before = listeners()
    process = subprocess.Popen(command, stdin=subprocess.DEVNULL, **options)
    while listeners() <= before:
        if process.poll() is not None:
            sys.exit(f"{command} ended with {process.returncode} before it listened")
        time.sleep(0.002)
    return process


def stop(process):
    process.kill()
    process.wait()


def round_trips(ping, echo):
    """Times [us] of TRIPS round trips."""
    answering = start(echo, stdout=subprocess.DEVNULL)
    done = subprocess.run(ping, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, check=True, text=True, timeout=120)
    stop(answering)
    return [int(line) / 1000 for line in done.stdout.split()]


def chain_s(send, receive):
    """Time from the start of the sender to the end of the receiver, and how many frames the receiver missed or mixed up."""
    receiving = start(receive, stdout=subprocess.PIPE, text=True)
    begin = time.monotonic()
    subprocess.run(send, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, check=True, timeout=120)
    out, _ = receiving.communicate(timeout=120)
    took = time.monotonic() - begin
    if receiving.returncode != 0:
        sys.exit(f"{receive} ended with {receiving.returncode}")
    return took, int(out) if out.strip().isdigit() else 0


def main():
    node = sys.argv[1]
    rounds = int(sys.argv[2]) if len(sys.argv) > 2 else 10

    def ours(role, kind, count):
        return [node, role, kind, INTERFACE, str(count)]

    many = 10**9
    trips = str(TRIPS)
    pairs = {
        "port - port": (ours("ping", "port", trips), ours("echo", "port", many)),
        "raw socket - raw socket": (ours("ping", "raw", trips), ours("echo", "raw", many)),
        "python-can - python-can": (PYTHON + ["ping", INTERFACE, trips], PYTHON + ["echo", INTERFACE, str(many)]),
        "raw socket - port": (ours("ping", "raw", trips), ours("echo", "port", many)),
        "raw socket - canfdtest": (ours("ping", "raw", trips), ["canfdtest", INTERFACE]),
        "raw socket - python-can": (ours("ping", "raw", trips), PYTHON + ["echo", INTERFACE, str(many)]),
    }
    times = {name: [] for name in pairs}
    for _ in range(rounds):
        for name, pair in pairs.items():
            times[name] += round_trips(*pair)[50:]  # the first ones warm up
    print(f"round trip [us], {rounds} rounds of {TRIPS}, in turns      p50      p99      max    count")
    p50, p99 = {}, {}
    for name, sample in times.items():
        sample.sort()
        p50[name], p99[name] = sample[len(sample) // 2], sample[len(sample) * 99 // 100]
        print(f"  {name:<38}{p50[name]:>13.1f}{p99[name]:>9.1f}{sample[-1]:>9.1f}{len(sample):>9}")

    def ratio(name, to):
        return f"{p50[name] / p50[to]:.3f} (p99 {p99[name] / p99[to]:.3f})"

    print(f"  answered by the port, over canfdtest    {ratio('raw socket - port', 'raw socket - canfdtest')}")
    print(f"  answered by the port, over python-can   {ratio('raw socket - port', 'raw socket - python-can')}")
    print(f"  both ends the port, over raw sockets    {ratio('port - port', 'raw socket - raw socket')}")
    print(f"  both ends the port, over python-can     {ratio('port - port', 'python-can - python-can')}")

    def cangen(count):
        return ["cangen", INTERFACE, "-g", "0", "-n", str(count), "-I", "77", "-L", "8", "-D", "i"]

    def candump(count):
        return ["candump", "-s", "2", "-r", RECEIVE_BYTES, "-n", str(count), INTERFACE]

    chains = {
        "port -> port": (lambda n: ours("send", "port", n), lambda n: ours("receive", "port", n)),
        "cangen -> candump": (cangen, candump),
        "cangen -> port": (cangen, lambda n: ours("receive", "port", n)),
        "port -> candump": (lambda n: ours("send", "port", n), candump),
        "python-can -> python-can": (lambda n: PYTHON + ["send", INTERFACE, str(n)],
                                     lambda n: PYTHON + ["receive", INTERFACE, str(n)]),
    }
    rates = {name: [] for name in chains}
    wrong = {name: 0 for name in chains}
    for _ in range(max(rounds // 2, 1)):
        for name, (send, receive) in chains.items():
            alone, _ = chain_s(send(1), receive(1))
            whole, missed = chain_s(send(BURST), receive(BURST))
            wrong[name] += missed
            rates[name].append(BURST / max(whole - alone, 1e-3))
    print(f"throughput [frames/s], {len(rates['port -> port'])} bursts of {BURST}         median      max    drops")
    median = {name: statistics.median(sample) for name, sample in rates.items()}
    for name, sample in rates.items():
        print(f"  {name:<38}{median[name]:>13.0f}{max(sample):>9.0f}{wrong[name]:>9}")
    print(f"  the port, over can-utils                {median['port -> port'] / median['cangen -> candump']:.3f}")
    print(f"  the port, over python-can               {median['port -> port'] / median['python-can -> python-can']:.3f}")


if __name__ == "__main__":
    main()
