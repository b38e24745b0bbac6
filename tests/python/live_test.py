"""canhil.live: a script that takes part in a run. canhil.partner: programs that do."""

import io
import math
import subprocess
import sys
from pathlib import Path

import canhil
import pytest
from canhil import Verdict, partner

SOURCE = Path(__file__).resolve().parents[2]
SPIKE = {"name": "spike", "kind": "bias", "quantity": "seeker.error_pitch", "by_mrad": 4.0, "when": "command"}


def test_a_fault_begins_and_ends_by_command(scenario: Path) -> None:
    with canhil.live(scenario, bus="in-process", faults=[SPIKE], truth=["plant.range"]) as flight:
        for now in flight:
            if now.truth["plant.range"] < 900:
                now.end("spike")
            elif now.truth["plant.range"] < 1000:
                now.begin("spike")
    (fault,) = flight.run.document["faults"]
    by_condition = canhil.run(scenario, bus="in-process", faults=[SPIKE | {"when": "plant.range < 1000"}])
    [window] = fault["windows"]
    assert window["from_s"] == by_condition.document["faults"][0]["windows"][0]["from_s"] == 4.45
    assert 0 < window["to_s"] - window["from_s"] < 0.2
    assert flight.run.verdict is Verdict.FAIL


def test_a_run_with_a_script_that_only_looks_is_as_without_it(scenario: Path, flown: canhil.Run) -> None:
    times, truths = [], []
    with canhil.live(scenario, bus="in-process", period=0.1, truth=["los.rate.pitch"], hears=["LosRateEstimate"]) as flight:
        for now in flight:
            times.append(now.t)
            truths.append(now.truth["los.rate.pitch"])
            assert not 0 < now.t < 5 or len(now.heard) > 10
    assert times == pytest.approx([0.1 * step for step in range(len(times))])
    assert not any(map(math.isnan, truths[:50]))
    assert flight.run.log is not None and flown.log is not None
    frames = [[line.split()[2] for line in log.read_text().splitlines()] for log in (flight.run.log, flown.log)]
    assert frames[0] == frames[1]


def test_values_of_sensors_are_replaced(scenario: Path) -> None:
    with canhil.live(scenario, bus="in-process", hears=["SeekerAngles"]) as flight:
        seen = []
        for now in flight:
            seen += [1e3 * heard.values["error_yaw_rad"] for heard in now.heard if heard.t > 1.001]
            if now.t == 1:
                now.set("seeker.error_yaw", 0.005)
            if now.t == 2:
                now.release("seeker.error_yaw")
                break
    assert seen[:100] == pytest.approx([5.0] * 100, abs=0.1)
    assert any("set seeker.error_yaw to 0.005" in note for note in flight.run.document["bus"]["notes"])


def test_frames_and_messages_are_sent_and_heard(scenario: Path) -> None:
    with canhil.live(scenario, bus="in-process", hears=["*"]) as flight:
        for now in flight:
            now.frame("7F0#0102")
            now.send("SeekerRange", {"range_m": 1234})
            if now.t >= 0.05:
                now.stop("enough")
    assert flight.run.verdict is Verdict.NOT_MEASURED and "enough" in flight.run.reason
    assert flight.run.log is not None
    text = flight.run.log.read_text()
    assert text.count(" 7F0#0102 ") >= 5


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        ({"truth": ["plant.rnge"]}, "no truth of plant.rnge"),
        ({"hears": ["Nothing"]}, "a message of the DBC"),
        ({"set": {"seeker.perod_ms": 5}}, "seeker.perod_ms"),
    ],
)
def test_what_the_bench_refuses_is_an_error(scenario: Path, arguments: dict, says: str) -> None:
    with pytest.raises(canhil.Error, match=says), canhil.live(scenario, bus="in-process", **arguments) as flight:
        for _ in flight:
            pass


def test_the_last_step_before_a_script_leaves_counts(scenario: Path) -> None:
    with canhil.live(scenario, bus="in-process", faults=[SPIKE]) as flight:
        for now in flight:
            break
        now.begin("spike")  # after the loop
        assert next(iter(flight)).t == 0.01, "a second loop goes on"
    assert flight.run.document["faults"][0]["windows"][0]["from_s"] == 0
    with pytest.raises(canhil.Error, match="no fault 'spikee'"), canhil.live(scenario, bus="in-process", faults=[SPIKE]) as flight:
        for now in flight:
            now.begin("spikee")
            break
    assert flight.run.verdict is Verdict.NOT_MEASURED


def test_a_fault_is_told_for_each_time_that_it_was_active(scenario: Path, tmp_path: Path) -> None:
    silent = {"name": "silent", "kind": "silent", "node": "seeker", "when": "command"}
    check = {"kind": "answering", "name": "answers"}
    text = scenario.read_text() + "".join(["\n[[check]]\n", *(f'{key} = "{value}"\n' for key, value in check.items())])
    file = tmp_path / "twice.toml"
    file.write_text(text)
    with canhil.live(file, bus="in-process", faults=[silent], period=0.1) as flight:
        for now in flight:
            if round(now.t, 1) in (1.0, 3.0):
                now.begin("silent")
            if round(now.t, 1) in (1.5, 3.5):
                now.end("silent")
    assert flight.run.judgement("answers").outcome is Verdict.PASS, "it owes no answers while the seeker is silent"


def test_what_a_script_does_wrongly_is_an_error_and_ends_the_run(scenario: Path) -> None:
    with pytest.raises(canhil.Error, match="no fault 'nothing'"), canhil.live(scenario, bus="in-process") as flight:
        for now in flight:
            now.begin("nothing")
    with pytest.raises(ZeroDivisionError), canhil.live(scenario, bus="in-process") as flight:
        for _ in flight:
            1 / 0  # noqa: B018


def test_the_live_plot_draws(tmp_path: Path) -> None:
    picture = tmp_path / "live.png"
    words = [sys.executable, str(SOURCE / "docs/examples/python/live_plot.py"), "--save", str(picture)]
    printed = subprocess.run(words, cwd=SOURCE, check=True, stdout=subprocess.PIPE, text=True).stdout
    assert int(printed.split()[0]) > 500, printed
    assert picture.stat().st_size > 10_000


# ---- the lines, without a bench


class Valve:
    inputs = {"valve": "1"}
    outputs = {"level": "m"}

    def __init__(self, area: float = 1.0) -> None:
        self.area, self.level = area, 0.0

    def step(self, t: float, dt: float, inputs: dict) -> None:
        self.level += dt * inputs["valve"] / self.area

    def values(self) -> list:
        return [self.level]


class Compass:
    inputs = {"attitude.heading": "rad"}
    outputs = {"heading": "rad"}

    def measure(self, t: float, truth: dict) -> list:
        return [truth["attitude.heading"] + t]


class Echo:
    period = 0.5
    truth = ["attitude.roll"]
    hears = ["Speed"]

    def step(self, bench: partner.Bench) -> None:
        for heard in bench.heard:
            bench.send("Echo", {"E": heard.values["S"]})
        for _, text in bench.frames:
            bench.frame(text)
        bench.set("gps.height", bench.truth["attitude.roll"])
        bench.release("gps.height")
        bench.end("a fault")


def said(make: type, text: str) -> str:
    sink = io.StringIO()
    partner.converse(make, partner.Lines(io.StringIO(text), sink))
    return sink.getvalue()


def test_a_plant() -> None:
    assert said(Valve, "canhil-plant 1\nnew word\nseed 7\nrun 2\nnumber area 2\nstart\nstep 0 500000 1\nend\n") == (
        "input valve 1\noutput level m\nstate 0.0\nstate 0.25\n"
    )
    assert (partner.run.seed, partner.run.index) == (7, 2)


def test_a_sensor() -> None:
    assert said(Compass, "canhil-sensor 1\nname mine\nseed 1\nrun 0\nstart\nstep 0 500000 0.25\n") == (
        "input attitude.heading rad\noutput heading rad\nstate 0.0\nstate 0.75\n"
    )
    assert partner.run.name == "mine"


def test_a_node() -> None:
    opening = "canhil-node 1\nname n\nclock real\nends 2000000\nseed 1\nrun 0\nstart\n"
    assert said(Echo, opening + "heard 1000 Speed S=2.5\nframe 2000 123#00\nstep 0 500000 0.5\nend\n") == (
        "period 0.5\ninput attitude.roll\nhear Speed\nready\n"
        "send Echo E=2.5\nframe 123#00\nset gps.height 0.5\nrelease gps.height\nend a fault\ndone\n"
    )
    assert (partner.run.virtual_time, partner.run.ends_s) == (False, 2.0)
    with pytest.raises(RuntimeError, match="there is no fault"):
        said(Echo, opening + "error there is no fault\n")


def test_another_protocol_is_refused() -> None:
    with pytest.raises(RuntimeError, match="version 1"):
        said(Valve, "canhil-plant 2\nstart\n")
    with pytest.raises(EOFError):
        said(Valve, "canhil-plant 1\nend\n")


def test_a_program_says_why_it_fails(tmp_path: Path) -> None:
    program = tmp_path / "broken.py"
    program.write_text(f"import sys\nsys.path.insert(0, {str(SOURCE / 'python')!r})\nfrom canhil import partner\npartner.serve(lambda: 1 / 0)\n")
    ended = subprocess.run([sys.executable, program], input="canhil-plant 1\nstart\n", capture_output=True, text=True, check=False)
    assert ended.returncode == 1
    assert ended.stdout == "error ZeroDivisionError: division by zero\n"
