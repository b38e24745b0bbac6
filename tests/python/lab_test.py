"""canhil.lab: scenarios over several benches. ssh and labgrid-client are scripts that run the words here."""

import os
import signal
import threading
import xml.etree.ElementTree as xml
from pathlib import Path

import canhil
import pytest
from canhil import lab

SOURCE = Path(__file__).resolve().parents[2]


@pytest.fixture
def scenarios(tmp_path: Path) -> list[Path]:
    """Two scenarios in a folder of their own; the second one fails."""
    text = (SOURCE / "bench/flights/los_quick.toml").read_text()
    folder = tmp_path / "scenarios"
    folder.mkdir()
    (folder / "good.toml").write_text(text)
    (folder / "bad.toml").write_text(text.replace("below_m = 0.1", "below_m = 1e-9"))
    return [folder / "good.toml", folder / "bad.toml"]


@pytest.fixture
def machines(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Programs in front of PATH that write what they are asked to do."""
    folder = tmp_path / "bin"
    folder.mkdir()
    log = tmp_path / "asked"
    for name, words in {"ssh": 'shift 2; shift; sh -c "$*"', "labgrid-client": 'shift 2; case $1 in ssh) shift 2; sh -c "$*";; esac'}.items():
        (folder / name).write_text(f'#!/bin/sh\necho "{name} $1 $2 $3" >>{log}\n{words}\n')
        (folder / name).chmod(0o755)
    monkeypatch.setenv("PATH", f"{folder}:{os.environ['PATH']}")
    return log


def write_lab(folder: Path, text: str) -> Path:
    (folder / "lab.toml").write_text(text)
    return folder / "lab.toml"


def test_scenarios_fly_over_ssh_and_labgrid(scenarios: list[Path], machines: Path, tmp_path: Path) -> None:
    file = write_lab(
        tmp_path,
        '[[bench]]\nname = "one"\nssh = "hil@rack1"\nbus = "in-process"\n[[bench]]\nname = "two"\nlabgrid = "rack2"\nbus = "in-process"\n',
    )
    result = lab.run(scenarios * 2, lab.benches(file), folder=tmp_path / "out")
    assert [one.outcome for one in result.flown] == ["not measured", "fail"] * 2
    assert result.code == 1
    first = result.flown[0].run
    assert first is not None and len(first.series("los.rate.pitch")) > 1000
    result.junit(tmp_path / "all.xml")
    suites = xml.parse(tmp_path / "all.xml").getroot().findall("testsuite")
    assert len(suites) == 4
    used = {one.get("value") for one in xml.parse(tmp_path / "all.xml").getroot().iter("property") if one.get("name") == "bench"}
    assert used <= {"one", "two"}
    asked = machines.read_text().splitlines()
    assert asked.count("labgrid-client -p rack2 acquire") == asked.count("labgrid-client -p rack2 release") == 1
    assert any(line.startswith("ssh -o BatchMode=yes hil@rack1") for line in asked)


def test_the_command_prints_a_line_for_each_run(scenarios: list[Path], tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = write_lab(tmp_path, '[[bench]]\nname = "here"\nbus = "in-process"\noptions = ["--seed", "7"]\n')
    words = [str(file), *map(str, scenarios), "--out", str(tmp_path / "out"), "--junit", str(tmp_path / "all.xml")]
    assert lab.main(words) == 1
    printed = capsys.readouterr().out.splitlines()
    assert [line.split()[0] for line in printed] == ["not", "fail"]
    assert lab.main(words) == 2, "the folder is not new"
    assert "expected a new folder" in capsys.readouterr().err


def test_a_scenario_that_is_refused_is_an_error_of_its_own(scenarios: list[Path], tmp_path: Path) -> None:
    scenarios[1].write_text("title = 3\n")
    result = lab.run(scenarios, [lab.Bench("here", bus="in-process")], folder=tmp_path / "out")
    assert [one.outcome for one in result.flown] == ["not measured", "error"]
    assert "title" in str(result.flown[1].error) and result.code == 2
    result.junit(tmp_path / "all.xml")
    (error,) = xml.parse(tmp_path / "all.xml").getroot().iter("error")
    assert "title" in error.get("message", "")


def test_a_machine_that_does_not_answer_is_named(
    scenarios: list[Path], machines: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    Path(os.environ["PATH"].split(":")[0], "ssh").write_text("#!/bin/sh\necho 'ssh: no route to host' >&2\nexit 255\n")
    Path(os.environ["PATH"].split(":")[0], "labgrid-client").write_text("#!/bin/sh\necho 'place is not free' >&2\nexit 1\n")
    result = lab.run(scenarios[:1], [lab.Bench("far", ssh="far")], folder=tmp_path / "a")
    assert "no bench" in str(result.flown[0].error)
    assert "no route to host" in capsys.readouterr().err
    result = lab.run(scenarios[:1], [lab.Bench("taken", labgrid="taken")], folder=tmp_path / "b")
    assert "no bench" in str(result.flown[0].error)


@pytest.mark.parametrize(
    "text",
    [
        "nonsense",
        "",
        '[[bench]]\nbus = "can0"\n',
        '[[bench]]\nname = "a"\nbuss = "can0"\n',
        '[[bench]]\nname = "a"\nbus = 3\n',
        '[[bench]]\nname = "a"\noptions = [3]\n',
        '[[bench]]\nname = "a"\nssh = "x"\nlabgrid = "y"\n',
        '[[bench]]\nname = "a"\n[[bench]]\nname = "a"\n',
    ],
)
def test_a_wrong_file_of_a_lab_is_refused(text: str, tmp_path: Path) -> None:
    with pytest.raises(canhil.Error, match="lab.toml"):
        lab.benches(write_lab(tmp_path, text))


def test_nothing_to_do_is_refused(scenarios: list[Path], tmp_path: Path) -> None:
    here = [lab.Bench("here")]
    with pytest.raises(canhil.Error, match="nothing to do"):
        lab.run([], here, folder=tmp_path / "out")
    with pytest.raises(canhil.Error, match="expected a scenario"):
        lab.run([tmp_path / "none.toml"], here, folder=tmp_path / "out")


def test_an_interruption_begins_no_further_run(scenarios: list[Path], tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    begun = tmp_path / "begun"
    slow = tmp_path / "slow"
    slow.write_text(f"#!/bin/sh\necho >>{begun}\nsleep 1\nexit 3\n")
    slow.chmod(0o700)
    file = write_lab(tmp_path, f'[[bench]]\nname = "here"\nprogram = "{slow}"\n')
    threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT)).start()
    assert lab.main([str(file), *map(str, scenarios), "--out", str(tmp_path / "out")]) == 3
    assert "interrupted" in capsys.readouterr().err
    assert begun.read_text() == "\n"
