#!/usr/bin/env python3
"""Draws docs/images/imu_allan.svg: the Allan deviation of the simulated IMU and the band that its datasheet's numbers allow.

    docs/images/allan.py [NODES_TEST]      NODES_TEST: the unit test's program (default: build/default/tests/unit/bench/nodes/nodes_test)

The points are those that the test ImuAllan judges: it flies and computes them, and reports them as properties. Package: gnuplot-nox.
"""
import json
import math
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PICTURE = Path(__file__).resolve().parent / "imu_allan.svg"
PANELS = (("gyro", "Gyros", "Allan deviation [deg/h]", 180 * 3600 / math.pi),
          ("accel", "Accelerometers", "Allan deviation [ug]", 1e6 / 9.80665))
AXES = (("x", "#1b6ca8"), ("y", "#c2410c"), ("z", "#4d7c0f"))


def points(program):
    """The properties of the test: axis -> lines 'tau measured expected low high'."""
    with tempfile.TemporaryDirectory() as folder:
        report = Path(folder) / "report.json"
        subprocess.run([program, "--gtest_filter=ImuAllan.IsThatOfTheDatasheetAndOfNoOtherOverSixDecades", f"--gtest_output=json:{report}"],
                       check=True, stdout=subprocess.DEVNULL)
        suite = json.loads(report.read_text())["testsuites"][0]
    return suite["testsuite"][0]


def panel(properties, quantity, title, unit, factor):
    lines = [f"set title '{title}'", f"set ylabel '{unit}'"]
    plots = []
    for axis, colour in AXES:
        rows = properties[f"{quantity}_{axis}"]
        lines.append(f"${quantity}_{axis} << EOD\n{rows}EOD")
        data = f"${quantity}_{axis}"
        plots += [f"{data} using 1:(${4}*{factor}):(${5}*{factor}) with filledcurves fillcolor rgb '{colour}' fillstyle transparent solid 0.2 noborder notitle",
                  f"{data} using 1:(${3}*{factor}) with lines linecolor rgb '{colour}' notitle",
                  f"{data} using 1:(${2}*{factor}) with points pointtype 7 pointsize 0.35 linecolor rgb '{colour}' title '{axis}'"]
    return "\n".join(lines) + "\nplot " + ", ".join(plots) + "\n"


def main(arguments):
    if arguments[:1] in (["-h"], ["--help"]) or len(arguments) > 1:
        sys.exit(__doc__)
    program = Path(arguments[0] if arguments else ROOT / "build/default/tests/unit/bench/nodes/nodes_test")
    if not program.is_file():
        sys.exit(f"allan.py: no program {program}: expected the unit test nodes_test")
    properties = points(program.resolve())
    script = ("set terminal svg size 960,420 font 'DejaVu Sans,12' background rgb 'white'\n"
              "set logscale xy\nset format '10^{%T}'\nset xlabel 'averaging time [s]'\nset xrange [0.005:20000]\n"
              "set grid linecolor rgb '#dddddd'\nset key bottom left\nset multiplot layout 1,2\n"
              + "".join(panel(properties, *one) for one in PANELS))
    svg = subprocess.run(["gnuplot"], input=script, text=True, capture_output=True, check=True).stdout
    PICTURE.write_text("".join(line.rstrip() + "\n" for line in svg.splitlines()))
    print(f"{PICTURE.name} {len(svg)} bytes")


if __name__ == "__main__":
    main(sys.argv[1:])
