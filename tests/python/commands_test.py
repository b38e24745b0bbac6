"""Campaigns, acceptance, golden answers, comparisons."""

from pathlib import Path

import canhil
import pytest
from canhil import Verdict, golden

SOURCE = Path(__file__).resolve().parents[2]


def test_a_campaign_has_answers_and_samples(tmp_path: Path) -> None:
    file = SOURCE / "bench/monte_carlo/quick.toml"
    first = canhil.campaign(file, runs=2, threads=2, results=tmp_path / "r.sqlite")
    assert first.verdict in Verdict and "quick campaign" in repr(first)
    assert len(first.variants) == 4
    of_first = [one for one in first.answers if one.variant == first.variants[0]]
    assert of_first[0].metric.startswith("rms_curve") and of_first[0].met is None and of_first[0].raw["curve"]
    assert any(one.met is not None for one in first.answers)
    samples = list(first.samples())
    assert {one["run"] for one in samples} == {0, 1} and {one["variant"] for one in samples} == set(first.variants)
    with pytest.raises(canhil.Error, match="r.sqlite"):
        canhil.campaign(file, runs=2, results=tmp_path / "r.sqlite")
    resumed = canhil.campaign(file, runs=2, results=tmp_path / "r.sqlite", resume=True)
    assert resumed.document == first.document
    with pytest.raises(canhil.Error, match="none.toml"):
        canhil.campaign(tmp_path / "none.toml", target=["false"])


def test_acceptance_names_each_requirement() -> None:
    accepted = canhil.accept(["hil-target"], estimators=["wind"], families=["protocol"], suites=SOURCE / "bench/acceptance", seed=3)
    assert accepted.verdict is Verdict.PASS and "pass" in repr(accepted)
    assert {one.outcome for one in accepted.requirements} == {"pass"} and accepted.requirements[0].suite == "wind"
    assert "text" in accepted.requirements[0].raw
    with pytest.raises(canhil.Error, match="wond"):
        canhil.accept(estimators=["wond"], first_failure=True)


def test_golden_answers(tmp_path: Path, scenario: Path) -> None:
    golden.record(tmp_path / "kept", [scenario])
    same = golden.check(tmp_path / "kept", target="hil-target")
    assert [(one.scenario, one.same, one.difference) for one in same] == [("los_quick", True, "")] and same[0].frames > 1000
    with pytest.raises(canhil.Error, match="exists already"):
        golden.record(tmp_path / "kept", [scenario])
    kept = tmp_path / "kept/los_quick.toml"
    kept.write_text(kept.read_text().replace('algorithm = "combined"', 'algorithm = "low_pass"'))
    differs = golden.check(tmp_path / "kept", tolerance=1)
    assert not differs[0].same and "algorithm is combined in one, low_pass in the other" in differs[0].difference


def test_a_comparison_says_what_got_worse(scenario: Path, flown: canhil.Run) -> None:
    same = canhil.compare(flown, flown.folder / "report.json")
    assert same.worse is False and {"same"} <= {one.what for one in same.lines}
    worse = canhil.compare([flown], [canhil.run(scenario, bus="in-process", seed=4)], tolerance_percent=0)
    assert worse.worse is not None and any(one.what in ("worse", "changed") for one in worse.lines)
    other = canhil.run(SOURCE / "bench/flights/transfer_alignment_quick.toml", bus="in-process")
    assert canhil.compare(flown, other).worse is None
