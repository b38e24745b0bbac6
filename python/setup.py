"""The version of the package is that of the project, which CMakeLists.txt states."""

import re
from pathlib import Path

from setuptools import setup

ROOT = Path(__file__).resolve().parents[1]
VERSION = re.search(r"^project\(canhil VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text(), re.M)
assert VERSION is not None
setup(version=VERSION[1])
