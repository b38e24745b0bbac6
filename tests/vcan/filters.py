"""filters.py BUILD: fails if a pattern of a --gtest_filter in the CTest cases of BUILD matches no test of its program.

Otherwise, if a test is renamed, nobody would notice that it no longer runs over vcan."""

import json
import subprocess
import sys

build = sys.argv[1]
listed = subprocess.run(["ctest", "--test-dir", build, "--show-only=json-v1", "-R", "^vcan"],
                        check=True, capture_output=True, text=True).stdout
dead, seen = [], 0
for case in json.loads(listed)["tests"]:
    command = case.get("command", [])
    for option in command:
        if not option.startswith("--gtest_filter="):
            continue
        program = command[command.index(option) - 1]
        for pattern in option.split("=", 1)[1].replace("-", ":").split(":"):
            tests = subprocess.run([program, "--gtest_list_tests", f"--gtest_filter={pattern}"],
                                   check=True, capture_output=True, text=True).stdout.splitlines()
            seen += 1
            if not any(line.startswith("  ") for line in tests):
                dead.append(f"{case['name']}: '{pattern}' matches no test of {program}")
print("\n".join(dead) if dead else f"{seen} patterns, each matches a test")
sys.exit(bool(dead) or not seen)
