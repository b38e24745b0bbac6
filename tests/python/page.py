"""Checks docs/python.md: its commands print what it shows, and draw its first picture. Usage: page.py BUILD [--write]"""

import os
import subprocess
import sys
import tempfile
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
BUILD, WRITE = Path(sys.argv[1]).resolve(), "--write" in sys.argv
PICTURE = SOURCE / "docs/images/python_week.svg"
os.environ["PYTHONPATH"] = str(SOURCE / "python")  # in place of an installation
os.environ["PYTEST_ADDOPTS"] = "-p canhil.pytest_plugin -p no:cacheprovider"
os.environ["PATH"] = f"{BUILD}:/usr/bin:/bin"


def outputs() -> bool:
    words = [sys.executable, SOURCE / "tests/docs/outputs.py", BUILD, SOURCE / "docs/python.md", *["--write"] * WRITE]
    return subprocess.run(words, check=False).returncode == 0


def week() -> bool:
    """Runs week.py, whose output the page shows too: outputs() passes it over, so that it runs only once. Identifiers and the date of an SVG are random, unless matplotlib is told otherwise."""
    with tempfile.TemporaryDirectory(prefix="canhil-page-") as name:
        folder = Path(name)
        (folder / "matplotlibrc").write_text("svg.hashsalt: canhil\nsvg.fonttype: none\n")
        (folder / "bench").symlink_to(SOURCE / "bench")
        environment = os.environ | {"MATPLOTLIBRC": name, "MPLCONFIGDIR": name, "SOURCE_DATE_EPOCH": "0", "MPLBACKEND": "svg"}
        words = [sys.executable, SOURCE / "docs/examples/python/week.py"]
        printed = subprocess.run(words, cwd=name, env=environment, check=True, stdout=subprocess.PIPE, text=True).stdout
        drawn = (folder / "week.svg").read_bytes()
    if WRITE:
        PICTURE.write_bytes(drawn)
    if printed not in (SOURCE / "docs/python.md").read_text():
        print(f"docs/python.md: does not show what week.py prints:\n{printed}")
        return False
    if not PICTURE.exists() or drawn != PICTURE.read_bytes():
        print(f"{PICTURE}: is not what week.py draws, expected python3 tests/python/page.py {BUILD} --write")
        return False
    return True


script = (SOURCE / "docs/examples/python/week.py").read_text()
assert len(script.splitlines()) <= 40, "docs/python.md promises forty lines"
results = [outputs(), week()]
sys.exit(0 if all(results) else 1)
