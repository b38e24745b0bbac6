"""Prints two numbers: the passed and the failed cases of a JUnit file that ctest wrote. A case that did not run counts as failed."""

import sys
import xml.etree.ElementTree as ElementTree

try:
    cases = list(ElementTree.parse(sys.argv[1]).getroot().iter("testcase"))
except (OSError, ElementTree.ParseError) as error:
    sys.exit(f"junit_counts.py: {sys.argv[1]}: {error}, expected a JUnit file")
passed = sum(case.get("status") == "run" for case in cases)
for case in cases:
    if case.get("status") not in ("run", "fail"):
        print(f"not run: {case.get('name')} ({case.get('status')})", file=sys.stderr)
print(passed, len(cases) - passed)
