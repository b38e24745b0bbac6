"""The pytest plugin, in tests of its own."""

from pathlib import Path

import pytest

BUS = "--canhil-bus=in-process"


@pytest.fixture
def project(pytester: pytest.Pytester, scenario: Path) -> pytest.Pytester:
    """A folder with a scenario whose checks of values pass, one that fails, and a TOML file that is none."""
    text = scenario.read_text()
    good = text[: text.index("[[check]]")] + (
        '[[check]]\nkind = "error"\nquantity = "los.rate"\nrequirement = "LOS-1"\nstatistic = "rms"\n'
        "time_to_go_s = [2, 3]\nbelow_mradps = 2.3\n"
    )
    (pytester.path / "good.toml").write_text(good)
    (pytester.path / "bad.toml").write_text(good.replace("2.3", "0.1"))
    (pytester.path / "unclear.toml").write_text(good + '[[check]]\nkind = "heartbeat"\nsilent_at_most_s = 1\n')
    (pytester.path / "mapping.toml").write_text('dbc = "a.dbc"\n')
    (pytester.path / "broken.toml").write_text("not TOML")
    return pytester


def fly(project: pytest.Pytester, *words: str) -> pytest.RunResult:
    return project.runpytest_inprocess("-p", "canhil.pytest_plugin", *words)


def test_scenarios_are_tests(project: pytest.Pytester) -> None:
    result = fly(project, BUS, "--junitxml=j.xml")
    result.assert_outcomes(passed=1, failed=1, skipped=1)
    result.stdout.fnmatch_lines(["*FAIL*error los.rate*LOS-1*expected RMS < 0.1 mrad/s*", "*canhil-artefacts/bad.toml-scenario/report.html"])
    result.stdout.no_fnmatch_line("*Traceback*")
    assert "<svg" in (project.path / "canhil-artefacts/bad.toml-scenario/report.html").read_text()
    assert [one.name for one in (project.path / "canhil-artefacts").iterdir()] == ["bad.toml-scenario"]
    assert '<property name="requirement" value="LOS-1"' in (project.path / "j.xml").read_text()


def test_not_measured_can_be_a_failure(project: pytest.Pytester) -> None:
    project.makeini("[pytest]\ncanhil_not_measured = fail\ncanhil_bus = in-process\ncanhil_artefacts = kept\n")
    fly(project, "unclear.toml", "good.toml").assert_outcomes(passed=1, failed=1)
    assert (project.path / "kept/unclear.toml-scenario/report.json").exists()
    project.makeini("[pytest]\ncanhil_not_measured = maybe\n")
    assert fly(project, "good.toml").ret == pytest.ExitCode.USAGE_ERROR


def test_an_error_of_the_bench_is_one_line(project: pytest.Pytester) -> None:
    (project.path / "good.toml").write_text("duration_s = 3\n")
    result = fly(project, "good.toml", BUS)
    result.assert_outcomes(failed=1)
    result.stdout.fnmatch_lines(["*good.toml*'title'*is missing*"])
    result.stdout.no_fnmatch_line("*pytest_plugin.py*")


def test_fixtures_markers_and_artefacts(project: pytest.Pytester) -> None:
    project.makepyfile(
        """
        import canhil, pytest

        @pytest.mark.requirement("REQ-1", "REQ-2")
        def test_good(bench, bus, target):
            assert (bus, target) == ("in-process", None)
            bench.check(bench.run("good.toml"))

        @pytest.mark.parametrize("limit", [0.1, 0.2])
        def test_bad(bench, limit):
            for seed in (1, 2):
                run = bench.run("good.toml", seed=seed, set={"check.1.below_mradps": limit})
            bench.check(run)

        def test_nothing_flown():
            assert False
        """
    )
    result = fly(project, "--strict-markers", "-k", "test_", BUS, "--junitxml=j.xml")
    result.assert_outcomes(passed=1, failed=3)
    kept = sorted(one.name for one in (project.path / "canhil-artefacts").iterdir())
    name = "test_fixtures_markers_and_artefacts.py-test_bad"
    assert kept == [f"{name}-{limit}" for limit in (0.1, 0.2)]
    assert sorted(one.name for one in (project.path / "canhil-artefacts" / kept[0]).iterdir()) == ["1", "2"]
    assert '<property name="requirement" value="REQ-2"' in (project.path / "j.xml").read_text()


def test_a_scenario_that_is_wrong_does_not_disappear(project: pytest.Pytester) -> None:
    good = (project.path / "good.toml").read_text()
    for name, text in (("quote", good.replace('"', "", 1)), ("key", good.replace("duration_s", "duration")), ("twice", "duration_s = 1\n" + good)):
        (project.path / f"{name}.toml").write_text(text)
    result = fly(project, BUS, "-v", "quote.toml", "key.toml", "twice.toml")
    result.assert_outcomes(failed=3)
    result.stdout.fnmatch_lines(["*duration*is unknown, expected 'duration_s'*"])
    fly(project, BUS).assert_outcomes(passed=1, failed=4, skipped=1)
    fly(project, BUS, "broken.toml").assert_outcomes(failed=1)  # named, so it is a test


def test_assertions_after_a_check_that_was_not_measured_count(project: pytest.Pytester) -> None:
    project.makepyfile(
        """
        import pytest

        def test_wrong(bench):
            bench.check(bench.run("unclear.toml"))
            assert False

        def test_right(bench):
            bench.check(bench.run("unclear.toml"))

        def test_no_run(bench):
            with pytest.raises(TypeError, match="expected what bench.run returned"):
                bench.check("unclear.toml")
        """
    )
    result = fly(project, "-rs", "-k", "test_", BUS)
    result.assert_outcomes(passed=1, failed=1, skipped=1)
    result.stdout.fnmatch_lines(["SKIPPED*.py*not measured: 1 of 2 checks*"])


def test_files_of_an_earlier_failure_go(project: pytest.Pytester) -> None:
    fly(project, "bad.toml", BUS).assert_outcomes(failed=1)
    kept = project.path / "canhil-artefacts/bad.toml-scenario"
    assert kept.exists()
    (project.path / "bad.toml").write_text((project.path / "good.toml").read_text())
    fly(project, "bad.toml", BUS).assert_outcomes(passed=1)
    assert not kept.exists()


def test_requirements_select_scenarios(project: pytest.Pytester) -> None:
    fly(project, BUS, "-m", "requirement", "good.toml").assert_outcomes(passed=1)
    fly(project, BUS, "-m", "not requirement", "good.toml").assert_outcomes(deselected=1)


def test_several_processes_of_xdist(project: pytest.Pytester) -> None:
    result = project.runpytest_subprocess("-p", "xdist.plugin", "-p", "canhil.pytest_plugin", "-n", "2", BUS)
    result.assert_outcomes(passed=1, failed=1, skipped=1)
    assert (project.path / "canhil-artefacts/bad.toml-scenario/report.html").exists()


def test_a_failure_that_is_none_of_the_bench_has_its_traceback(project: pytest.Pytester, monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(*_: object, **__: object) -> None:
        raise RuntimeError("of another kind")

    monkeypatch.setattr("canhil.pytest_plugin.run", broken)
    fly(project, "good.toml", BUS).stdout.fnmatch_lines(["*RuntimeError: of another kind"])
