#!/usr/bin/env python3
"""Tests the reference of the keys of scenario and campaign files: reference_test.py HIL_BENCH SOURCE.

Checks that docs/scenario-reference.md equals the output of hil-bench reference, that the reference explains the
meaning of each key, and that the reference contains each key of the project's scenario and campaign files. Checks the
JSON schema of scenarios against the same files.
"""

import json
import subprocess
import sys
import tomllib
from pathlib import Path

import jsonschema

hil_bench, source = sys.argv[1], Path(sys.argv[2])
page = source / "docs" / "scenario-reference.md"
wrong: list[str] = []


def printed(*options: str) -> str:
    return subprocess.run([hil_bench, "reference", *options], check=True, capture_output=True, text=True).stdout


# The page docs/scenario-reference.md must equal the output of hil-bench reference.
if not page.exists() or page.read_text() != printed():
    wrong.append(f"{page}: is not what the program prints, make it again by: hil-bench reference > docs/scenario-reference.md")

# The reference must explain the meaning of each key.
parts = {part["title"]: part["tables"] for part in json.loads(printed("--json"))["parts"]}
keys = {(title, table["name"]): [key["key"] for key in table["keys"]] for title, tables in parts.items() for table in tables}
count = sum(map(len, keys.values()))
for title, tables in parts.items():
    for table in tables:
        wrong += [f"{title}, {table['name']}: key '{key['key']}' has no meaning" for key in table["keys"] if not key["meaning"]]
if count < 500:
    wrong.append(f"{count} keys, expected hundreds")


# The reference must contain each key of the project's scenario and campaign files.
def is_known(key: str, title: str, *tables: str) -> bool:
    known = [name for table in tables for name in keys.get((title, table), [])]
    stems = [name.removesuffix("_UNIT") for name in known if name.endswith("_UNIT")]
    marks = [name.removeprefix("MARK") for name in known if name.startswith("MARK")]
    return key in known or any(key.startswith(stem) for stem in stems) or any(key.endswith(mark) for mark in marks)


def expect(file: Path, found, title: str, *tables: str) -> None:
    for key, value in found.items():
        if not isinstance(value, dict) and not is_known(key, title, *tables):
            wrong.append(f"{file}: '{key}' is in no table of the reference ({title}: {', '.join(tables)})")


def tables_of(found, key: str) -> list[dict]:
    value = found.get(key, [])
    return value if isinstance(value, list) else [value]


def expect_scenario(file: Path, scenario) -> None:
    own = {key: value for key, value in scenario.items() if not isinstance(value, (dict, list))}
    expect(file, own, "The file", "Scenario")
    for target in tables_of(scenario, "target"):
        mapped = "mapping" in target
        expect(file, target, "The target", "[target] with a mapping" if mapped else "[target]")
        expect(file, target.get("initial_sigma", {}), "The target", "[target.initial_sigma]")
        expect(file, target.get("parameters", {}), "Parameters of the target", target.get("estimator", ""))
        expect(file, target.get("initial_error", {}), "Truth and initial errors", "[initial_error]")
    for table in ("truth", "initial_error", "engagement", "glide", "wind", "airframe"):
        expect(file, scenario.get(table, {}), "Truth and initial errors", f"[{table}]")
    expect(file, scenario.get("glide", {}).get("initial_error", {}), "Truth and initial errors", "[glide.initial_error]")
    for name, table in scenario.items():
        if isinstance(table, dict) and ("Nodes", f"[{name}]") in keys:
            expect(file, table, "Nodes", "Any sensor that a program computes" if "command" in table else f"[{name}]")
    for node in tables_of(scenario, "node"):
        expect(file, node, "Nodes", "[[node]]")
    for fault in tables_of(scenario, "fault"):
        expect(file, fault, "Faults", "[[fault]]", fault["kind"])
    for check in tables_of(scenario, "check"):
        expect(file, check, "Checks", "[[check]]", check["kind"])


def expect_campaign(file: Path, campaign) -> None:
    expect(file, {key: value for key, value in campaign.items() if not isinstance(value, list)}, "Campaigns", "Campaign")
    for variant in tables_of(campaign, "variant"):
        expect(file, variant, "Campaigns", "[[variant]]")
    for metric in tables_of(campaign, "metric"):
        expect(file, metric, "Campaigns", "[[metric]]", metric["kind"])


files = 0
for folder in ("bench", "docs/examples"):
    for file in sorted((source / folder).rglob("*.toml")):
        found = tomllib.loads(file.read_text())
        if "variant" in found:
            expect_campaign(file, found)
        elif "target" in found:
            expect_scenario(file, found)
        else:
            continue
        files += 1
if files < 20:
    wrong.append(f"{files} scenarios and campaigns found, expected dozens")

# The schema must be that of the program, accept each scenario of the project, and find what a reader would refuse.
schema_file = source / "docs" / "scenario.schema.json"
schema = json.loads(printed("--schema"))
if not schema_file.exists() or schema_file.read_text() != printed("--schema"):
    wrong.append(f"{schema_file}: is not what the program prints, make it again by: hil-bench reference --schema > docs/scenario.schema.json")
jsonschema.Draft7Validator.check_schema(schema)
validator = jsonschema.Draft7Validator(schema)
scenarios = [file for folder in ("bench", "docs/examples") for file in sorted((source / folder).rglob("*.toml")) if "duration_s" in tomllib.loads(file.read_text())]
if len(scenarios) < 20:
    wrong.append(f"{len(scenarios)} scenarios, expected dozens")
for file in scenarios:
    wrong += [f"{file}: {'.'.join(map(str, one.path))}: {one.message[:200]}" for one in validator.iter_errors(tomllib.loads(file.read_text()))]
quick = tomllib.loads((source / "bench/flights/los_quick.toml").read_text())
for what, changed in {
    "a misspelt key": {"seeker": quick["seeker"] | {"perod_ms": 5}},
    "a text for a number": {"duration_s": "six"},
    "a number out of range": {"duration_s": 0},
    "an unknown table": {"sekeer": {}},
    "an unknown check": {"check": [{"kind": "eror"}]},
    "a misspelt key of a fault": {"fault": [{"kind": "bias", "quantity": "seeker.error_pitch", "by_mrad": 4, "form_s": 1}]},
}.items():
    if validator.is_valid(quick | changed):
        wrong.append(f"{schema_file}: accepts {what}")

print("\n".join(wrong) or f"{count} keys, and all of {files} files")
sys.exit(bool(wrong))
