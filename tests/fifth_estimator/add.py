#!/usr/bin/env python3
"""Creates a copy of the project with a fifth estimator: python3 tests/fifth_estimator/add.py FOLDER

This file makes all changes outside tests/fifth_estimator that the estimator needs: one line in each registry, and the additions to the DBC, which
contract.dbc lists. The estimator's sensor and one of its checks are the examples of docs/adding-a-sensor.md and docs/adding-a-check.md. Their code is
taken from these two pages, so the tests of the copy fail if a page is out of date.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/static"))
import copied_tree  # noqa: E402

HERE = "tests/fifth_estimator"



def fail(what: str) -> None:
    sys.exit(f"add.py: {what}")


def block(page: str, above: str) -> str:
    """The first code block of docs/PAGE.md below the line that begins with `above`."""
    found = re.search(rf"^{re.escape(above)}.*?^```\w*\n(.*?)\n```$", (ROOT / f"docs/{page}.md").read_text(), re.DOTALL | re.MULTILINE)
    if not found:
        fail(f"docs/{page}.md: has no line '{above}...' with code below it")
    return found[1]


# Source files that two pages of docs contain: the text of each file is the code block below the line that begins with the file's name.
FROM_PAGES = {name: block(page, f"`{name}`").encode() + b"\n" for page, name in [
    ("adding-a-sensor", "bench/sensors/barometer.hpp"), ("adding-a-sensor", "bench/sensors/barometer.cpp"),
    ("adding-a-check", "bench/checks/kinds/spread.hpp"), ("adding-a-check", "bench/checks/kinds/spread.cpp")]}

# (registry, an existing line in it, the line to insert after it)
LINES = [
    ("bench/estimators/registry.cpp", '#include "bench/scenario/scenario.hpp"', f'#include "{HERE}/baro_inertial.hpp"'),
    ("bench/estimators/registry.cpp", "    &los_rate,", "    &baro_inertial,"),
    ("bench/sensors/registry.cpp", '#include "bench/sensors/registry.hpp"', '#include "bench/sensors/barometer.hpp"'),
    ("bench/sensors/registry.cpp", "    &fins,        // of the glider", block("adding-a-sensor", "## 3. The registry")),
    ("bench/checks/kinds.cpp", '#include "bench/checks/kinds/sigma_grows.hpp"', '#include "bench/checks/kinds/spread.hpp"'),
    ("bench/checks/kinds.cpp", "                                      check_kind<Convergence>,", block("adding-a-check", "## 2. The registry")),
    ("target/device/adapters.hpp", "std::unique_ptr<Adapter> make_wind_adapter();",
     "std::unique_ptr<Adapter> make_baro_inertial_adapter();"),
    ("target/device/adapters.hpp", "  adapters.push_back(make_wind_adapter());",
     "  adapters.push_back(make_baro_inertial_adapter());"),
    # This folder is added before the other tests, because its tests contain the campaign that lasts longest.
    ("tests/CMakeLists.txt", "add_compile_options(${canhil_not_numerical})", "add_subdirectory(fifth_estimator)"),
]
LAST_ESTIMATOR, ONE_MORE = '4 "wind"', '5 "baro_inertial" '
IMU_MESSAGE = r'BA_ "Estimators" BO_ (128|129|130) ".*";'  # the estimator reads the IMU too


def with_lines(name: str, text: str) -> str:
    for file, there, line in LINES:
        if file != name:
            continue
        if text.count(f"{there}\n") != 1:
            fail(f"{name}: expected the line '{there}' once")
        text = text.replace(f"{there}\n", f"{there}\n{line}\n")
    return text


def contract(text: str) -> str:
    """Adds the parts of contract.dbc to the text of the DBC: the nodes to BU_, the estimator to the lists of estimators and to the messages of the IMU, the rest
    at the end."""
    own = (ROOT / HERE / "contract.dbc").read_text()
    nodes, rest = own.split("\n", 1)
    for line in block("adding-a-sensor", "## 1. The DBC").splitlines():
        if line not in own.splitlines():
            fail(f"docs/adding-a-sensor.md: '{line}' is not in {HERE}/contract.dbc")
    lines = []
    for line in text.splitlines():
        if line.startswith("BU_:"):
            line += nodes.removeprefix("BU_:")
        elif line.startswith(("VAL_ ", "VAL_TABLE_ ")) and f" {LAST_ESTIMATOR} " in line:
            line = line.replace(LAST_ESTIMATOR, ONE_MORE + LAST_ESTIMATOR)
        elif re.fullmatch(IMU_MESSAGE, line):
            line = line.replace('";', f' {ONE_MORE.split(chr(34))[1]}";')
        lines.append(line)
    return "\n".join(lines) + "\n" + rest


def copied(name: str, content: bytes) -> bytes:
    if name == "dbc/canhil.dbc":
        return contract(content.decode()).encode()
    if any(file == name for file, _, _ in LINES):
        return with_lines(name, content.decode()).encode()
    return content


def main() -> None:
    if len(sys.argv) != 2:
        fail("expected one argument, the folder for the copy")
    # dbcgen --fd derives the FD variant of the DBC from the DBC of the copy.
    copied_tree.copy_tree(pathlib.Path(sys.argv[1]), copied, made=("dbc/canhil-fd.dbc",), added=FROM_PAGES)


if __name__ == "__main__":
    main()
