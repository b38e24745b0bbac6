"""Rules for commands of the documentation that a test cannot run exactly as the page shows them.

A rule changes the command, permits other exit codes, or states why the command is not run. The first rule
whose pattern occurs in the command applies. A command without a rule is run unchanged and must end with exit
code 0. rules_test.py fails if a rule matches no command.
"""

import re
from dataclasses import dataclass


@dataclass(frozen=True)
class Rule:
    pattern: str
    codes: tuple[int, ...] = (0,)
    says: str = ""  # a regular expression that the command's output must match
    instead: tuple[tuple[str, str], ...] = ()  # replacements in the command: (regular expression, new text)
    why_not: str = ""  # why the command is not run; then only its options and files are checked
    pages: str = ""  # a regular expression for the pages of the rule; empty: all pages


# Placeholders in the documentation, and their replacements in this test.
PLACEHOLDERS = (
    (r"\bSCENARIO\b", "bench/flights/transfer_alignment_quick.toml"),
    (r"\bFILE\.dbc\b", "dbc/canhil.dbc"),
    (r"\bMESSAGE\b", "Sync"),
    (r"bench/flights/transfer_alignment\.toml", "bench/flights/transfer_alignment_quick.toml"),
    (r"\bcan(\d)\b", r"nocan\1"),  # an interface that exists on no machine
    (r"\bvcan(\d)\b", r"novcan\1"),
)

NO_INTERFACE = r"cannot open 'no|nov?can\d"
PASSES = (0, 3)  # timing is not measured in virtual time, nor on a busy host
BARS = (0, 1, 3)  # campaigns may fail, because their limits are derived for more runs than a test flies
IN_VIRTUAL_TIME = ((r"$", " --lockstep"),)
FEW_RUNS = ((r"$", " --runs 2"),)
ANY_PORT = (r"--live\b( \d+)?", "--live 0")  # tests run in parallel and would compete for a fixed port

RULES = (
    # Commands that cannot be run here, or that another test runs.
    Rule(r"", pages=r"docs/tutorial\.md$", why_not="is run for what it prints: tests/docs/outputs.py"),
    Rule(r"", pages=r"docs/python\.md$", why_not="is run for what it prints: tests/python/page.py"),
    Rule(r"^bash bench/demo\.sh", why_not="installs packages and builds: .ci/run starts from there"),
    Rule(r"^bash tests/run\.sh", why_not="is what runs this test"),
    Rule(r"with_fifth|tests/fifth_estimator/", why_not="a build of its own: tests/run.sh --full makes it"),
    Rule(r"cmake --(preset|build|install)|\bcpack\b|\bapt install\b|^ctest\b", why_not="builds, installs or tests: tests/run.sh, tests/package"),
    Rule(r"^ip |^gpg ", why_not="of real hardware and people's keys"),
    Rule(r"tests/(controller|vcan)/run\.sh", why_not="an emulated machine: tests/controller, tests/vcan"),
    Rule(r"tests/(mutants|soak|perf)/", why_not="minutes to hours: tests/run.sh --full, --soak"),
    Rule(r"tests/independent/", why_not="an hour; the quick scenarios: test independent.Quick"),
    Rule(r"reception_fuzz", why_not="an hour: tests/fuzz"),
    Rule(r"can\.logconvert|asammdf", why_not="programs of others, on recordings of others"),
    Rule(r"/shared/|-of-N|\bmy\.sqlite|\bOUT\.sqlite", why_not="shards of a cluster: tests/processes/slurm"),
    Rule(r"\[--|transfer\|inflight|\[REPORTS\]|campaign (export|replay) ", why_not="a synopsis: tests/processes/campaign"),
    Rule(r"/usr/share/canhil", why_not="an installed canhil: tests/package"),
    Rule(r"campaign --paper|paper_transfer/table2", why_not="minutes: tests/papers"),
    Rule(r"hil-bench accept", why_not="minutes: tests/processes/accept"),
    Rule(r"hil-bench faults |faults/violation", why_not="minutes: tests/processes/faults"),
    Rule(r"--live-hold|--tui", why_not="waits for Ctrl-C, needs a terminal: tests/processes/live"),
    # Commands for hardware run until they open the interface, which does not exist here.
    Rule(r"hil-bench doctor .*can\d", codes=(0, 1), says="nocan0", instead=((r"--cpu \d", "--cpu 0"), (r" --seconds \d+", ""), (r"$", " --seconds 1"))),
    Rule(r"^sha256sum ", why_not="of the reports of a run on hardware"),
    Rule(r"^hil-(bench|target) .*\bv?can\d", codes=(2,), says=NO_INTERFACE, instead=((r"--cpu \d", "--cpu 0"),)),
    # Commands that would not end by themselves, would take too long, or have another exit code than 0.
    Rule(r"hil-bench run .*--live\b", codes=PASSES, instead=(ANY_PORT, *IN_VIRTUAL_TIME)),
    Rule(r"hil-bench campaign .*--live\b", codes=BARS, instead=((r"\bFILE\b", "bench/monte_carlo/quick.toml"), ANY_PORT, *FEW_RUNS)),
    Rule(r"hil-bench bus ", codes=(124,), instead=((r"^", "timeout -s INT -k 5 1 "), (r"local:\w+", "local:documented"))),
    Rule(r"my_target\.py", codes=(0, 1), says="rules kept", instead=((r"my_target", "docs/examples/kit/los_rate"),)),
    Rule(r"hil-bench campaign (?!merge|report)", codes=BARS, instead=((r"\bFILE\b", "bench/monte_carlo/quick.toml"), *FEW_RUNS)),
    Rule(r"hil-bench compare", codes=(0, 1)),
    Rule(r"all_four\.toml --bus 'in-process\?bitrate=500000'$", codes=(1,), says="1 of 8 checks failed: bus_load"),
    Rule(r"\| head$", codes=(0, 141)),  # head closes the pipe early
    Rule(r"hil-bench run .*(\?bitrate|in-process|--lockstep)", codes=PASSES),
    Rule(r"hil-bench run .*\|\| \[ \$\? = 3 \]", instead=((r" \|\|", " --lockstep ||"),)),
    Rule(r"hil-bench run .*own_ecu\.toml", codes=PASSES, instead=((r"$", " --log drive.log"),)),
    Rule(r"hil-bench run ", codes=PASSES, instead=IN_VIRTUAL_TIME),
    Rule(r"hil-bench dbc check", codes=(0, 1), says="messages played"),
    Rule(r"hil-bench check ", codes=PASSES),
)

RUN = "hil-bench run bench/flights/transfer_alignment_quick.toml --lockstep"
# Commands that make the files which the commands of a page require.
PREPARED = {
    "README.md": tuple(f"{RUN} --json {name}.json" for name in ("before", "after", "a1", "a2", "b1", "b2")),
    "docs/dbc.md": ("cp tests/data/dbc/multiplexed.dbc motion.dbc",),
    "docs/mapping.md": ("cp docs/examples/own_ecu/own_ecu.mapping.toml docs/examples/own_ecu/own_ecu.dbc .",),
    "docs/recorded-data.md": (
        r"sed 's/^\[target.parameters\]/&\naccel_scale_factor_sigma_ppm = 0\naccel_misalignment_sigma_mrad = 0\ngyro_scale_factor_sigma_ppm = 0\n"
        r"gyro_misalignment_sigma_mrad = 0\nlever_arm_sigma_m = 0\nvelocity_correlated_mps = 0\nvelocity_correlation_s = 60/' "
        "bench/flights/transfer_alignment_quick.toml > my.toml",
        r"sed -E '/^\[(master_ins|slave_imu)\]/,/^$/{/^[a-z]/d; s/^\[.*/&\nrecorded = \"first.log\"/}' my.toml > my_again.toml",
    ),
    "docs/report.md": tuple(f"{RUN} --json {name}.json" for name in ("run", "other", "before", "after", "a1", "a2", "a3", "a4", "b1", "b2", "b3", "b4"))
    + (f"{RUN} --log bench.log", "cp bench.log second.log"),
    "docs/recordings.md": (f"{RUN} --log run.log --json run.json", "hil-bench log convert run.log drive.asc", "cp run.log a.log", "cp run.log b.log",
                          r"printf '(1.000000) body 123#11\n(1.010000) engine 123#22\n' >two.log"),
}


def rule_of(text: str, page: str) -> Rule:
    return next((rule for rule in RULES if re.search(rule.pages, page) and re.search(rule.pattern, text)), Rule(""))
