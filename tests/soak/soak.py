"""Flies random scenarios with random faults, one after the other, against one target that runs all the time.

    python3 tests/soak/soak.py PROGRAMS [--minutes 60] [--seed 1] [--target COMMAND]

PROGRAMS is the folder of hil-bench and hil-target. Each run is a new bench process on one permanent embedded bus (hil-bench bus). Lockstep and real
time alternate. The outcomes of the checks are ignored, because faults make checks fail. Exit code 0 means that

* every run came to its end;
* memory and number of descriptors do not grow with the number of runs: of the target, of the bus, and (the peak of each run) of the bench;
* the files that the programs leave do not grow in number or size. For this, the programs get folders for temporary files that nobody else uses.
"""

import argparse
import json
import os
import random
import re
import shlex
import shutil
import signal
import statistics
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SCENARIOS = ["transfer_alignment_quick", "inflight_quick", "los_quick", "wind_quick"]
LONGEST_S = {"lockstep": 12, "real time": 3}  # duration of the longest flight
# A busy host can suspend the target for 0.4 s; in real time, the bench then reports a silent target. A busy host can also suspend the bench for
# 0.25 s; then the bus disconnects the bench. Such a flight is repeated unchanged. A target with a real defect is silent in every repetition.
MOST_FLIGHTS = {"lockstep": 1, "real time": 4}
# Faults that act on a stretch of time rather than on single samples (docs/faults.md).
STRETCHES = ["silent", "slow", "clock_step", "clock_drift", "restart", "stranger", "flood"]
PATIENCE_S = 60  # a run that takes longer is killed


class Contract:
    """Messages and signals of the emulated nodes, from the DBC; kinds of faults, from the bench."""

    def __init__(self, bench, folder):
        self.messages = {}  # {node: {message: [(signal, smallest value, largest value)]}}
        fields = None
        for line in (ROOT / "dbc/canhil.dbc").read_text().splitlines():
            if found := re.match(r"BO_ \d+ (\w+): \d+ (\w+)", line):
                fields = []
                if found[2] not in ("Bench", "Target"):  # these two nodes are not emulated
                    fields = self.messages.setdefault(found[2].lower(), {}).setdefault(found[1], [])
            elif found := re.match(r" SG_ (\w+) :.*\[([^|]+)\|([^\]]+)\]", line):
                if not found[1].startswith("e2e_"):
                    fields.append((found[1], float(found[2]), float(found[3])))
        self.kinds = []
        probe = folder / "probe.toml"
        for kind in self.all_kinds(bench, probe):
            if self.flies(bench, probe, self.fault(random.Random(0), kind, "slave_imu")):
                self.kinds.append(kind)

    def all_kinds(self, bench, probe):
        """All kinds of faults, from the bench's error message for an unknown kind, which lists them."""
        probe.write_text(scenario("transfer_alignment_quick", 1, 1, [{"kind": "?"}]))
        answer = subprocess.run([bench, "run", probe, "--bus", "in-process"], capture_output=True, text=True).stderr
        found = re.search(r"expected one of:? (.*)", answer)
        assert found, f"hil-bench names no kinds of faults: {answer}"
        return re.findall(r"\w+", found[1])

    @staticmethod
    def flies(bench, probe, fault):
        """Whether the bench accepts this fault in a run in process."""
        probe.write_text(scenario("transfer_alignment_quick", 1, 1, [timed(fault, 0.2, 0.5, 2)]))
        answer = subprocess.run([bench, "run", probe, "--bus", "in-process"], capture_output=True, text=True)
        return answer.returncode != 2

    def fault(self, draw, kind, node):
        messages = self.messages[node.replace("_", "")]
        name = draw.choice(sorted(messages))
        signal_name, least, most = draw.choice(messages[name])
        of_signal = {"messages": [name], "signal": signal_name}
        size = (most - least) * 10 ** draw.uniform(-5, -1)
        keys = {
            "changed": of_signal | {"value": draw.choice([least, most, draw.uniform(least, most)])},
            "bias": of_signal | {"by": size},
            "drift": of_signal | {"by": -size},
            "spike": of_signal | {"by": size},
            "stuck": of_signal,
            "saturated": of_signal | {"at": size},
            "noise": of_signal | {"sigma": size},
            "reversed": of_signal,
            "invalid": {"node": node},
            "late": {"node": node, "by_ms": round(draw.uniform(0.5, 50), 2)},
            "silent": {"node": node},
            "slow": {"node": node, "longer_percent": draw.uniform(1, 100)},
            "clock_step": {"node": node, "by_ms": round(draw.uniform(-50, 50), 2)},
            "clock_drift": {"node": node, "by_ppm": draw.uniform(-1000, 1000)},
            "restart": {"node": node, "silent_s": round(draw.uniform(0.01, 0.2), 3)},
            "counter_jump": {"messages": [name], "by": draw.randint(1, 14)},
            "delayed": {"messages": [name], "by_ms": round(draw.uniform(0.5, 50), 2)},
            "stranger": {"period_ms": round(draw.uniform(0.5, 20), 2)},
            "flood": {"period_us": draw.randint(200, 1000)},
        }.get(kind, {"messages": [name] if draw.random() < 0.5 else sorted(messages)})
        if kind == "invalid" and all((least, most) != (0, 1) for signals in messages.values() for _, least, most in signals):
            kind = "silent"  # the node has no flag that could be set to invalid
        return {"kind": kind} | keys


def timed(fault, from_s, to_s, every):
    fault |= {"from_s": from_s}
    if fault["kind"] != "restart":
        fault |= {"to_s": to_s}
    return fault if fault["kind"] in STRETCHES else fault | {"every": every}


def toml(value):
    return json.dumps(value)  # strings, numbers and lists are the same in TOML


def scenario(base, seed, duration_s, faults):
    """A scenario of bench/flights, shortened, with these faults. Its only check requires one answer."""
    text = (ROOT / f"bench/flights/{base}.toml").read_text().split("[[check]]")[0]
    text = re.sub(r"(?m)^duration_s = .*", f"duration_s = {duration_s}", text)
    text = re.sub(r"(?m)^seed = .*", f"seed = {seed}", text)
    text += "".join("\n[[fault]]\n" + "".join(f"{k} = {toml(v)}\n" for k, v in fault.items()) for fault in faults)
    return text + '\n[[check]]\nkind = "answers"\nanswers_at_least = 1\n'


def random_scenario(draw, contract, longest_s):
    base = draw.choice(SCENARIOS)
    text = (ROOT / f"bench/flights/{base}.toml").read_text()
    nodes = [n for n in re.findall(r"(?m)^\[(\w+)\]", text) if n.replace("_", "") in contract.messages]
    duration_s = round(draw.uniform(1, longest_s), 2)
    faults = []
    for _ in range(draw.randint(0, 3)):
        fault = contract.fault(draw, draw.choice(contract.kinds), draw.choice(nodes))
        from_s = round(draw.uniform(0, duration_s), 2)
        faults.append(timed(fault, from_s, round(draw.uniform(from_s, duration_s), 2), draw.randint(2, 20)))
    return base, scenario(base, draw.randrange(2**31), duration_s, faults), faults


def tree(pid):
    """The ids of a process and of all processes below it."""
    found = [pid]
    for one in found:
        try:
            for task in os.listdir(f"/proc/{one}/task"):
                found += [int(p) for p in Path(f"/proc/{one}/task/{task}/children").read_text().split()]
        except OSError:
            continue  # the process has ended
    return found


def resident_kib(pid):
    text = Path(f"/proc/{pid}/status").read_text()
    return int(re.search(r"VmRSS:\s+(\d+)", text)[1])


def of_tree(pid, count):
    total = 0
    for one in tree(pid):
        try:
            total += count(one)
        except (OSError, TypeError):
            continue  # the process has ended
    return total


def descriptors(pid):
    return len(os.listdir(f"/proc/{pid}/fd"))


def fly(command, environment, log):
    """Runs the bench. Returns exit code, standard error, peak resident memory [KiB], largest number of open descriptors."""
    bench = subprocess.Popen(command, env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                             stderr=subprocess.PIPE, text=True)
    most, ended = [0], threading.Event()

    def watch():
        while not ended.wait(0.02):
            try:
                most[0] = max(most[0], descriptors(bench.pid))
            except OSError:
                return

    watching = threading.Thread(target=watch)
    watching.start()
    hanging = threading.Timer(PATIENCE_S, bench.kill)
    hanging.start()
    said = bench.stderr.read()
    _, status, usage = os.wait4(bench.pid, 0)
    hanging.cancel()
    ended.set()
    watching.join()
    bench.returncode = os.waitstatus_to_exitcode(status)
    log.write(said)
    return bench.returncode, said.strip(), usage.ru_maxrss, most[0]


class Course:
    """A series of values, one taken after each run, with the kind of that run. Tests whether the value grows from run to run."""

    def __init__(self, name, unit, most_growth, why):
        self.name, self.unit, self.most_growth, self.why = name, unit, most_growth, why
        self.values = []  # (kind of run, value)

    def add(self, sort, value):
        self.values.append((sort, value))

    def settled(self):
        """[(index of the run, value minus the median value of this kind of run)]. Leaves out the first quarter of the
        runs, because in these runs code is executed for the first time."""
        medians = {sort: statistics.median(v for s, v in self.values if s == sort) for sort, _ in self.values}
        all_of_them = [(i, value - medians[sort]) for i, (sort, value) in enumerate(self.values)]
        return all_of_them[len(all_of_them) // 4:]

    def slope(self):
        """Growth per run, by least squares."""
        points = self.settled()
        return statistics.linear_regression(*zip(*points)).slope if len(points) > 2 else 0.0

    def growth(self):
        """Median of the last third minus median of the first third. A median ignores a peak in one run."""
        values = [value for _, value in self.settled()]
        third = max(1, len(values) // 3)
        return statistics.median(values[-third:]) - statistics.median(values[:third])

    def grows(self):
        return self.growth() > self.most_growth

    def words(self):
        last = [value for _, value in self.values]
        return (f"{self.name:<24} {min(last)} to {max(last)} {self.unit}, {self.slope():+.4f} a run, grew by {self.growth():.1f}, "
                f"at most {self.most_growth} ({self.why}): {'GROWS' if self.grows() else 'flat'}")


def courses():
    page = "the allocator's own pages come and go; a byte lost with each frame of a run is more within ten runs"
    whole = "nothing of a run may stay"
    return {"host memory": Course("host of the bus: resident", "KiB", 128, page),
            "host descriptors": Course("host: descriptors", "open", 0, whole),
            "target memory": Course("target: resident", "KiB", 128, page),
            "target descriptors": Course("target: descriptors", "open", 0, whole),
            "bench memory": Course("bench: peak resident", "KiB", 4096, "a bench is new in each run; its peak is that of what it flew, of few runs of a sort"),
            "bench descriptors": Course("bench: most descriptors", "open", 0.5, "it is looked at 50 times a second"),
            "files": Course("files left", "files", 0, whole),
            "bytes": Course("bytes left", "bytes", 0, whole)}


def soak(arguments):
    folder = Path(tempfile.mkdtemp(prefix="soak-"))
    own = {name: folder / name for name in ("tmp", "run")}
    for path in own.values():
        path.mkdir(mode=0o700)
    environment = os.environ | {"TMPDIR": str(own["tmp"]), "XDG_RUNTIME_DIR": str(own["run"])}
    bench = str(Path(arguments.programs).resolve() / "hil-bench")
    target_program = shlex.split(arguments.target or str(Path(arguments.programs).resolve() / "hil-target"))
    contract = Contract(bench, folder)
    bus = f"local:soak-{os.getpid()}"
    print(f"soak: faults of the kinds {', '.join(contract.kinds)}; seed {arguments.seed}", flush=True)
    draw = random.Random(arguments.seed)
    all_courses, ended, unexpected = courses(), {}, []
    host = subprocess.Popen([bench, "bus", bus], env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
    time.sleep(0.5)
    target = subprocess.Popen([*target_program, "--bus", bus], env=environment, stdin=subprocess.DEVNULL)
    time.sleep(0.5)  # if the target is a Python script that starts hil-target, Python needs this time to start
    end = time.monotonic() + 60 * arguments.minutes
    line = time.monotonic() + 60 * arguments.minutes / 10
    runs = silent = 0
    with open(folder / "bench.log", "w") as log:
        while time.monotonic() < end and len(unexpected) < 5:
            mode = ("lockstep", "real time")[runs % 2]
            base, text, faults = random_scenario(draw, contract, LONGEST_S[mode])
            (folder / "scenario.toml").write_text(text)
            report = own["tmp"] / "report.json"
            command = [bench, "run", str(folder / "scenario.toml"), "--bus", bus, "--target", "none", "--json", str(report)]
            for _ in range(MOST_FLIGHTS[mode]):
                code, said, peak_kib, most = fly(command + ["--lockstep"] * (mode == "lockstep"), environment, log)
                how = said or f"ended with {code}"
                if code in (0, 1, 3):
                    ending = json.loads(report.read_text())["ending"]
                    report.unlink()
                    how = "completed" if ending["completed"] else ending["detail"]
                if not how.startswith(("target silent", "the bus is down")):
                    break
                silent += 1
            runs += 1
            ended[how] = ended.get(how, 0) + 1
            # A fault may suppress all IMU samples for more than 200 ms. The target then ends the alignment
            # and reports input_silent.
            if (how != "completed" and "input_silent" not in how) or target.poll() is not None:
                unexpected.append(f"run {runs}, {base}, {mode}, faults {faults}: {how}")
                if target.poll() is not None:
                    unexpected[-1] += f"; the target ended with {target.returncode}"
                    break
            left = [p for path in own.values() for p in path.rglob("*") if p.is_file() or p.is_socket()]
            sort = f"{base}, {mode}"
            for name, value in {"host memory": of_tree(host.pid, resident_kib),
                                "host descriptors": of_tree(host.pid, descriptors),
                                "target memory": of_tree(target.pid, resident_kib),
                                "target descriptors": of_tree(target.pid, descriptors),
                                "files": len(left), "bytes": sum(p.stat().st_size for p in left if p.is_file())}.items():
                all_courses[name].add("any", value)
            all_courses["bench memory"].add(sort, peak_kib)
            all_courses["bench descriptors"].add(mode, most)
            if time.monotonic() >= line:
                line += 60 * arguments.minutes / 10
                now = {name: course.values[-1][1] for name, course in all_courses.items()}
                print(f"{runs:>7} runs; " + ", ".join(f"{name} {value}" for name, value in now.items()), flush=True)
    for one in (target, host):
        if one.poll() is None:
            one.send_signal(signal.SIGTERM)
            one.wait(10)
    print(f"{silent} flights flown again, as the host kept the target or the bench waiting")
    return all_courses, ended, unexpected, runs, folder


def main():
    options = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    options.add_argument("programs", help="folder of hil-bench and hil-target")
    options.add_argument("--minutes", type=float, default=60)
    options.add_argument("--seed", type=int, default=1)
    options.add_argument("--target", help="a program in place of hil-target, with its arguments")
    arguments = options.parse_args()
    if arguments.minutes <= 0:
        options.error("--minutes: expected more than 0")
    all_courses, ended, unexpected, runs, folder = soak(arguments)
    for course in all_courses.values():
        if course.values:
            print(course.words())
    for why in unexpected:
        print(f"unexpected: {why}")
    print(f"{runs} runs: " + ", ".join(f"{count} {how}" for how, count in sorted(ended.items())))
    few = runs < 8  # growth cannot be seen in so few runs
    good = not unexpected and not few and not any(course.grows() for course in all_courses.values())
    print("soak: " + ("all runs ended as they should, nothing grows" if good else "FAILED" + ", too few runs" * few))
    if good:
        shutil.rmtree(folder)
    else:
        print(f"soak: logs and the last scenario are in {folder}")
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
