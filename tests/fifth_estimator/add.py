#!/usr/bin/env python3
"""Creates a copy of the project with a fifth estimator: python3 tests/fifth_estimator/add.py FOLDER

This file contains all changes outside tests/fifth_estimator that the estimator needs: one line in each registry, and the additions to the DBC, which
contract.dbc lists.
"""
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/static"))
import copied_tree  # noqa: E402

HERE = "tests/fifth_estimator"

# (registry, an existing line in it, the line to insert after it)
LINES = [
    ("bench/estimators/registry.cpp", '#include "messages/canhil.hpp"', f'#include "{HERE}/baro_inertial.hpp"'),
    ("bench/estimators/registry.cpp", "    &los_rate,", "    &baro_inertial,"),
    ("bench/nodes/registry.cpp", '#include "bench/nodes/ssbl.hpp"', f'#include "{HERE}/barometer.hpp"'),
    ("bench/nodes/registry.cpp", "    &fins,        // of the glider", "    &barometer,   // of the vehicle"),
    ("target/device/adapters.hpp", "std::unique_ptr<Adapter> make_wind_adapter();",
     "std::unique_ptr<Adapter> make_baro_inertial_adapter();"),
    ("target/device/adapters.hpp", "  adapters.push_back(make_wind_adapter());",
     "  adapters.push_back(make_baro_inertial_adapter());"),
    ("tests/CMakeLists.txt", "canhil_build_for(processes hil-target hil-bench) # what the process tests start",
     "add_subdirectory(fifth_estimator)"),
]
LAST_ESTIMATOR, ONE_MORE = '4 "wind"', '5 "baro_inertial" '


def fail(what: str) -> None:
    sys.exit(f"add.py: {what}")


def with_lines(name: str, text: str) -> str:
    for file, there, line in LINES:
        if file != name:
            continue
        if text.count(f"{there}\n") != 1:
            fail(f"{name}: expected the line '{there}' once")
        text = text.replace(f"{there}\n", f"{there}\n{line}\n")
    return text


def contract(text: str) -> str:
    """Adds the nodes to BU_, the estimator to the lists of estimators, and the rest at the end."""
    own = (ROOT / HERE / "contract.dbc").read_text()
    nodes, rest = own.split("\n", 1)
    lines = []
    for line in text.splitlines():
        if line.startswith("BU_:"):
            line += nodes.removeprefix("BU_:")
        elif line.startswith(("VAL_ ", "VAL_TABLE_ ")) and f" {LAST_ESTIMATOR} " in line:
            line = line.replace(LAST_ESTIMATOR, ONE_MORE + LAST_ESTIMATOR)
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
    copied_tree.copy_tree(pathlib.Path(sys.argv[1]), copied, made=("dbc/canhil-fd.dbc",))


if __name__ == "__main__":
    main()
