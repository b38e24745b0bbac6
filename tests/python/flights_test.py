"""canhil.run and the results of a run."""

import csv
import json
import math
import os
import shlex
from pathlib import Path

import canhil
import pytest
from canhil import Verdict

BIAS = {"name": "off", "kind": "bias", "quantity": "seeker.error_pitch", "by_mrad": 4.0, "from_s": 3.0, "to_s": 3.2}


def test_results_are_those_of_the_json_report(flown: canhil.Run) -> None:
    report = json.loads((flown.folder / "report.json").read_text())
    assert flown.title == report["title"]
    assert str(flown.verdict) == report["verdict"] == "not measured"
    assert flown.duration_s == 6 and flown.wall_s > 0
    assert flown.results == report["results"]
    assert len(flown.judgements) == len(report["checks"]) == 10
    miss = flown.judgement("miss_distance")
    assert miss and miss.value is not None and miss.upper == 0.1 and miss.unit == "m" and miss.lower is None
    assert 0 < miss.value < miss.upper
    assert miss.margin == pytest.approx(1 - miss.value / miss.upper)
    assert not flown.judgement("heartbeat") and flown.judgement("heartbeat").value is None
    assert flown.answers["LosRateTarget"] == canhil.Answers(due=1112, came=1112)
    assert flown.latencies == {}, "virtual time has no latencies"
    assert "not measured" in repr(flown)


def test_a_judgement_is_found_by_name_or_by_its_kind(flown: canhil.Run) -> None:
    name = "error los.rate rms 3 to 2 s to go"
    assert flown.judgement(name).name == name
    assert flown.judgement("consistency").quantity == "los.nis"
    for ambiguous in ("error", "nothing"):
        with pytest.raises(KeyError, match="expected one of"):
            flown.judgement(ambiguous)


def test_a_series_has_the_values_of_the_table(flown: canhil.Run) -> None:
    series = flown.series("los.rate.pitch")
    with (flown.folder / "values.csv").open() as file:
        rows = [row for row in csv.DictReader(file) if (row["estimator"], row["quantity"]) == ("los_rate", "los.rate.pitch")]
    assert [len(one) for one in (series.t_s, series.estimate, series.truth, series.error, series.sigma)] == 5 * [len(rows)]
    assert len(series) == len(rows) > 1000
    assert series.unit == "rad/s"
    assert series.error[7] == float(rows[7]["error"]) == pytest.approx(series.estimate[7] - series.truth[7])
    assert math.isnan(flown.series("los.nis").truth[0]), "a statistic has no truth"
    assert flown.series("los.rate.pitch", estimator="plant").estimator == "plant"
    assert "los.rate.yaw" in flown.quantities
    with pytest.raises(KeyError, match="expected one of"):
        flown.series("los.rate.rol")


def test_a_series_as_pandas(flown: canhil.Run) -> None:
    frame = flown.series("los.rate.yaw").pandas()
    assert list(frame.columns) == ["estimate", "truth", "error", "sigma"]
    assert frame.index.name == "t_s" and len(frame) == len(flown.series("los.rate.yaw"))


def test_settings_change_the_flight(scenario: Path) -> None:
    run = canhil.run(
        scenario, bus="in-process", seed=9, set={"target": {"algorithm": "low_pass"}, "seeker.gyro_noise_mradps": 2, "title": 'a "b"'}
    )
    assert run.title == 'a "b"'
    assert run.document["provenance"]["seed"] == 9
    assert run.document["provenance"]["settings"]["target.algorithm"] == "'low_pass'"


def test_a_fault_from_code_makes_a_check_fail(scenario: Path, flown: canhil.Run, tmp_path: Path) -> None:
    run = canhil.run(scenario, bus="in-process", faults=[BIAS])
    assert run.verdict is Verdict.FAIL and flown.verdict is not Verdict.FAIL
    assert {one.quantity for one in run.failures} == {"los.rate", "los.nis"}
    assert run.document["faults"][0]["count"] > 10
    file = tmp_path / "faults.toml"
    file.write_text(canhil.toml_text.toml_tables("fault", [BIAS]))
    assert canhil.run(scenario, bus="in-process", faults=file).judgements == run.judgements
    assert canhil.run(scenario, bus="in-process", faults=BIAS).judgements == run.judgements
    assert f"fault '{BIAS['name']}'" in run.report(tmp_path / "page.html").read_text()
    with pytest.raises(canhil.Error, match=r"^faults: key 'fault\[1\].kind'") as caught:
        canhil.run(scenario, bus="in-process", faults=[BIAS | {"kind": "bais"}])
    assert caught.value.file is None


def test_arguments_of_another_type_are_named(scenario: Path) -> None:
    with pytest.raises(TypeError, match="expected a list of dicts"):
        canhil.run(scenario, faults=["seed=3"])  # type: ignore[list-item]
    with pytest.raises(TypeError, match="expected a dict"):
        canhil.run(scenario, set=["seed=3"])  # type: ignore[arg-type]
    with pytest.raises(canhil.Error, match="is a folder, expected the file of one scenario"):
        canhil.run(scenario.parent)


def test_a_name_that_is_unknown_has_near_ones(flown: canhil.Run) -> None:
    for name in ("los.rate", "los.rate.pich"):
        with pytest.raises(KeyError, match="'los.rate.pitch'"):
            flown.series(name)
    with pytest.raises(KeyError, match="expected one of run.quantities"):
        flown.series("zzz")


def test_latencies_and_flags_over_a_bus(scenario: Path) -> None:
    run = canhil.run(scenario, bus="in-process?bitrate=500000")
    latency = run.latencies["LosRateTarget"]
    assert latency.p50 is not None and latency.p99 is not None and 0 < latency.p50 <= latency.p99 < 0.01
    assert sum(count for _, count in latency.buckets_us) == latency.count
    flags = canhil.run(SOURCE_CAR, bus="local:", target=["python3", str(SOURCE_CAR.with_name("car.py"))], lockstep=True).flags
    assert [one.name for one in flags] and flags[0].changes[0][0] >= 0


SOURCE_CAR = Path(__file__).resolve().parents[2] / "docs/examples/car/car.toml"


def test_reports(flown: canhil.Run, tmp_path: Path) -> None:
    for name, begin in (("r.html", "<!"), ("r.json", "{"), ("r.xml", "<?xml"), ("r.csv", "t_s,"), ("r.log", "(")):
        assert flown.report(tmp_path / name).read_text().startswith(begin), name
    with pytest.raises(ValueError, match="ends in '.pdf', expected one of"):
        flown.report(tmp_path / "r.pdf")
    assert flown.log is not None and flown.log.read_text().startswith("(")
    kept = flown.keep(tmp_path / "kept")
    assert {"report.json", "report.html", "values.csv", "frames.log"} <= {one.name for one in kept.iterdir()}


def test_the_files_stay_in_a_folder_or_go_with_the_run(scenario: Path, tmp_path: Path) -> None:
    run = canhil.run(scenario, bus="in-process?unrounded", folder=tmp_path / "own")
    assert run.log is None, "a log has no room for frames that round nothing"
    assert (tmp_path / "own/report.json").exists()
    with pytest.raises(canhil.Error, match="holds another run already, expected a new folder"):
        canhil.run(scenario, bus="in-process", folder=tmp_path / "own")
    temporary = canhil.run(scenario, bus="in-process")
    folder = temporary.folder
    assert folder.exists()
    del temporary
    assert not folder.exists()


def test_errors_name_file_line_and_key(scenario: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(canhil.Error) as caught:
        canhil.run(scenario, set={"seeker.perod_ms": 5})
    assert (caught.value.file, caught.value.line, caught.value.key) == (scenario, None, "seeker.perod_ms")
    wrong = tmp_path / "wrong.toml"
    wrong.write_text(scenario.read_text().replace("duration_s = ", "duration_s = true # "))
    with pytest.raises(canhil.Error) as caught:
        canhil.run(wrong)
    assert caught.value.file == wrong and caught.value.key == "duration_s"
    assert caught.value.line == wrong.read_text()[: wrong.read_text().index("duration_s")].count("\n") + 1
    assert "expected a number" in str(caught.value)
    with pytest.raises(canhil.Error) as caught:
        canhil.run(tmp_path / "none.toml")
    assert caught.value.file == tmp_path / "none.toml" and caught.value.line is None
    with pytest.raises(canhil.Error) as caught:
        canhil.run(scenario, bus="in-process", options=["--nonsense"])
    assert caught.value.file is None and "--nonsense" in str(caught.value)
    for no_program in (scenario, scenario.parent):
        monkeypatch.setenv("CANHIL_BENCH", str(no_program))
        with pytest.raises(canhil.Error, match="is not a program"):
            canhil.run(scenario)
    monkeypatch.delenv("CANHIL_BENCH")
    monkeypatch.setenv("PATH", "/nowhere")
    with pytest.raises(canhil.Error, match="not in PATH"):
        canhil.run(scenario)


def test_an_error_has_a_line_for_each_key(scenario: Path) -> None:
    with pytest.raises(canhil.Error) as caught:
        canhil.run(scenario, set={"seed": -1, "seeker.perod_ms": 5})
    assert [line.partition(": ")[2].partition(":")[0] for line in str(caught.value).splitlines()] == ["key 'seed'", "key 'seeker.perod_ms'"]
    assert caught.value.key == "seed"
    spike = {"name": "spike", "kind": "bias", "quantity": "seeker.error_pitch", "by_mrad": "4", "from_s": -3}
    with pytest.raises(canhil.Error) as caught:
        canhil.run(scenario, faults=spike)
    assert all(line.startswith("faults: key 'fault[1].") for line in str(caught.value).splitlines())


def test_what_the_bench_does_when_it_dies_is_an_error(scenario: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    program = tmp_path / "bench"
    monkeypatch.setenv("CANHIL_BENCH", str(program))
    for script, message in (("kill -9 $$", "signal 9"), ("exit 2", "without a message"), ("exit 3", "interrupted")):
        program.write_text(f"#!/bin/sh\n{script}\n")
        os.chmod(program, 0o700)
        with pytest.raises(canhil.Error, match=message):
            canhil.run(scenario)


def test_values_of_toml() -> None:
    to_text = canhil.toml_text.toml_value
    assert [to_text(one) for one in (True, 3, 2.5, 1e30, math.inf, -math.inf)] == ["true", "3", "2.5", "1e+30", "inf", "-inf"]
    assert to_text(math.nan) == "nan"
    assert to_text("a\x7f\n\"") == '"a\\u007f\\n\\""'
    numpy = pytest.importorskip("numpy")
    assert to_text(numpy.float64(2.5)) == "2.5" and to_text(numpy.int64(3)) == "3"
    with pytest.raises(TypeError, match="is not a value of TOML"):
        to_text(None)  # type: ignore[arg-type]


def test_the_command_of_a_target_is_a_text_or_words() -> None:
    assert canhil.program.command_of(["a b", "c"]) == shlex.join(["a b", "c"])
    assert canhil.program.command_of("a b") == "a b"
