#!/usr/bin/env python3
"""Checks that each rule matches a command in the documentation: rules_test.py SOURCE PAGE..."""

import sys
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).parent))
from pages import commands_of  # noqa: E402
from rules import PREPARED, RULES, rule_of  # noqa: E402

source, pages = Path(sys.argv[1]), sys.argv[2:]
used = [rule_of(command.text, page) for page in pages for command in commands_of(source / page)]
unneeded = [f"no command has the pattern '{rule.pattern}'" for rule in RULES if rule not in used]
unneeded += [f"{page} is no page" for page in PREPARED if page not in pages]
print("\n".join(unneeded) or f"{len(used)} commands, {len(RULES)} rules")
sys.exit(bool(unneeded))
