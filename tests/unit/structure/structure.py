"""Checks the rules of the source tree in its text: includes, sizes, names, and duplicated code.

check(root) returns one line for each violation: file:line: what, and what was expected.
docs/architecture.md gives the reasons for the rules.
"""

import re
from pathlib import Path

CODE = ("dbc", "target", "bench")
SKIPPED = {".git", "build", "runs", "__pycache__"}

# MAY_INCLUDE: a file under a key may include project headers under the prefixes of this key; the longest key applies.
# An entry that ends in .hpp permits only that header.
ESTIMATOR_SHARED = ("target/estimators/strapdown/", "target/estimators/filtering/")
GENERATED = "messages/"  # headers that dbcgen generates from dbc/: code that may include dbc/ may include these too
DEVICE = "target/device/device.hpp"  # the bench may hold a Device, through this header
MAY_INCLUDE = {
    "dbc/": ("dbc/",),
    "target/": ("dbc/", "target/"),  # main.cpp connects the parts
    "target/device/": ("dbc/", "target/device/", "target/estimators/"),
    "target/estimators/": ESTIMATOR_SHARED,  # and the estimator's own folder, see allowed_prefixes()
    "bench/": ("dbc/", "bench/"),
    "bench/drive/": ("dbc/", "bench/", DEVICE),
    "bench/checks/": ("dbc/", "bench/"),
    "bench/sensors/": ("bench/world/", "bench/scenario/", "bench/processes/", "bench/sensors/"),  # a sensor knows neither messages nor frames
    # Neither does a fault of a sensor.
    "bench/faults/sensors/": ("bench/world/", "bench/scenario/", "bench/sensors/", "bench/faults/"),
}
# Folders that must not be included even indirectly: a check compares decoded frames with the truth and uses nothing
# else.
NEVER_REACHES = {"bench/checks/": ("target/", "bench/nodes/")}

# Code that works on quantities contains no name of an estimator (a folder of bench/estimators) and no name of a
# message, not even in a comment.
ON_QUANTITIES = ("bench/quantities/", "bench/campaign/", "bench/report/")

# Code that may name an estimator: its folder and the registry; the papers, each about one estimator; the seeker,
# which uses the answers of one estimator for guidance; and the glider, whose table [wind] has an estimator's name.
KNOW_ESTIMATORS = ("bench/estimators/", "bench/papers/", "bench/sensors/seeker.", "bench/nodes/seeker.", "bench/nodes/bound_sensor.", "bench/plant/glide/")

# Code that may name a plant with tables of its own (bench/plant/registry.cpp), also in a comment. All other code sees the
# outputs of plants as named quantities.
KNOW_PLANTS = ("bench/plant/",)

# Code that may know whose DBC it is: the bindings (canhil.dbc's, its sensors' and its estimators', and the mappings of other
# DBC files), canhil's own protocol, and what is about that protocol alone (conformance, accept, the drawn faults of hil-target).
# All other code asks the properties of a scenario::Binding.
KNOW_WHOSE_DBC = ("bench/bindings/", "bench/mapping/", "bench/nodes/", "bench/estimators/", "bench/protocol/", "bench/conformance/", "bench/accept/",
                  "bench/campaign/matrix/drawn.", "bench/drive/contract.", "bench/drive/contract_dialect.", "bench/drive/mapped_dialect.",
                  "bench/commands/dbc.", "bench/commands/new.",  # commands about a mapping
                  "bench/campaign/metric_rule.", "bench/campaign/row.",  # stored columns: quantities of a mapping
                  "bench/checks/observations.", "bench/checks/timing_record.", "bench/checks/judge.hpp",  # where a test names no messages
                  "bench/drive/buses.")  # a condition on the build
WHOSE_DBC = re.compile(r"\ball_messages\b|\bbindings::canhil\b|\bmapping::\w+")

# The aim is 300 lines. A file with a long table or a long derivation may exceed 300 lines; a file that is longer by a
# third contains a second subject.
MOST_LINES = 400
VAGUE = {"util", "utils", "common", "manager", "helper", "helpers", "base"}
TERMS = {"time_base"}  # terms of the field that contain a word of VAGUE
OTHER_SUFFIXES = {".h", ".hh", ".hxx", ".cc", ".cxx", ".c", ".inl", ".inc", ".ipp", ".tpp"}

INCLUDE = re.compile(r'^[ \t]*#[ \t]*(?:include|include_next|import)\b[ \t]*(.*)$', re.M)
INCLUDED = re.compile(r'([<"])([^>"]+)[>"]')
COMMENT_OR_STRING = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"', re.S)
STANDARD_HEADER = re.compile(r"[a-z_]+$")  # <cmath>, never <math.h>
# A path that exists on one person's machine. Such a path is permitted after a variable or in an address.
MACHINE_PATH = re.compile(r"(?<![\w.~})\-])/(?:work|root|home/\w+|Users/\w+|builds)/")


DEEPEST = 9  # so many folders of the bench may stand on each other


def check(root):
    root = Path(root)
    files = sorted(p for p in root.rglob("*") if p.is_file() and not SKIPPED & set(p.relative_to(root).parts))
    texts = {p.relative_to(root).as_posix(): p.read_text(encoding="utf-8", errors="replace") for p in files}
    sources = {n: t for n, t in texts.items() if n.split("/")[0] in CODE and n.endswith((".hpp", ".cpp"))}
    graph = {name: includes(text) for name, text in sources.items()}
    return [*direct_breaches(graph), *reach_breaches(graph), *cycle_breaches(graph), *depth_breaches(graph), *size_breaches(sources),
            *name_breaches(texts), *machine_path_breaches(texts), *quantity_breaches(sources),
            *estimator_breaches(sources), *named_test_breaches(texts), *node_breaches(sources, graph), *whose_dbc_breaches(sources),
            *plant_breaches(sources), *dbc_breaches(texts, sources)]


def without_comments(text, keep_strings=True):
    """The text with spaces in place of comments (and strings); line breaks stay."""
    def blank(match):
        if keep_strings and match[0].startswith('"'):
            return match[0]
        return re.sub(r"[^\n]", " ", match[0])
    return COMMENT_OR_STRING.sub(blank, text)


def includes(text):
    """[(line, '<' or '"', name)] of each include; '' in place of '<' if the name is a macro."""
    clean = without_comments(text)
    found = []
    for directive in INCLUDE.finditer(clean):
        line = clean.count("\n", 0, directive.start()) + 1
        name = INCLUDED.match(directive[1].strip())
        if not name:
            found.append((line, "", directive[1].strip()))
        else:
            found.append((line, name[1], "dbc/" + name[2] if name[2].startswith(GENERATED) else name[2]))
    return found


def is_project(name):
    return name.split("/")[0] in (*CODE, "tests", "docs")


def part(name):
    """The part of the project that contains a file: dbc/wire, bench/world, target/estimators/wind, each with
    its subfolders."""
    depth = 3 if name.startswith("target/estimators/") else 2
    return "/".join(name.split("/")[:-1][:depth])


def allowed_prefixes(name):
    own = (part(name) + "/",) if part(name).startswith("target/estimators/") else ()
    key = max((k for k in MAY_INCLUDE if name.startswith(k)), key=len)
    return own + MAY_INCLUDE[key]


def may_include(name, included):
    return any(included == p if p.endswith(".hpp") else included.startswith(p) for p in allowed_prefixes(name))


def direct_breaches(graph):
    for name, included in graph.items():
        for line, quote, other in included:
            where = f"{name}:{line}"
            if not quote:
                yield f"{where}: includes by a macro, expected a name in quotes or angle brackets"
            elif ".." in other.split("/"):
                yield f'{where}: includes "{other}", expected a path from the root, without ".."'
            elif is_project(other):
                if not may_include(name, other):
                    yield f"{where}: includes {other}, expected only {', '.join(allowed_prefixes(name))}"
            elif quote == '"':
                yield f'{where}: includes "{other}", expected a path from the root (libraries in angle brackets)'
            elif name.startswith("target/estimators/") and not (
                    STANDARD_HEADER.match(other) or other.startswith(("Eigen/", "unsupported/Eigen/"))):
                yield f"{where}: includes <{other}>, expected only Eigen and the standard library in an estimator"


def reach_breaches(graph):
    for name in graph:
        for prefix, forbidden in NEVER_REACHES.items():
            if not name.startswith(prefix):
                continue
            seen, ways = {name}, [(name,)]
            while ways:
                way = ways.pop()
                for _, _, other in graph.get(way[-1], ()):
                    if other.startswith(forbidden):
                        yield f"{' -> '.join((*way, other))}: {prefix} reaches {other}, expected never to"
                    elif other not in seen:
                        seen.add(other)
                        ways.append((*way, other))


def folder_edges(graph):
    """{folder: {folder that it includes: an example}}"""
    edges = {}
    for name, included in graph.items():
        for _, _, other in included:
            if is_project(other) and part(other) != part(name):
                edges.setdefault(part(name), {}).setdefault(part(other), f"{name} includes {other}")
    return edges


def depth_breaches(graph):
    edges = {folder: [other for other in others if other.startswith("bench/")]
             for folder, others in folder_edges(graph).items() if folder.startswith("bench/")}
    longest = {}

    def way_from(folder, above=()):
        if folder not in longest and folder not in above:
            ways = [way_from(other, (*above, folder)) for other in edges.get(folder, ())]
            longest[folder] = [folder, *max(ways, key=len, default=[])]
        return longest.get(folder, [])

    way = max((way_from(folder) for folder in edges), key=len, default=[])
    if len(way) > DEEPEST:
        yield f"{' > '.join(way)}: {len(way)} folders, expected at most {DEEPEST}"


def cycle_breaches(graph):
    edges = folder_edges(graph)
    reported = set()

    def visit(node, way):
        if node in way:
            ring = way[way.index(node):]
            if frozenset(ring) not in reported:
                reported.add(frozenset(ring))
                reasons = [edges[a][b] for a, b in zip(ring, [*ring[1:], node])]
                return [f"{' -> '.join([*ring, node])}: a cycle of folders ({'; '.join(reasons)}), expected none"]
            return []
        if node in done:
            return []
        found = [breach for other in edges.get(node, {}) for breach in visit(other, [*way, node])]
        done.add(node)
        return found

    done = set()
    for start in list(edges):
        yield from visit(start, [])


def quantity_breaches(sources):
    estimators = {n.split("/")[2] for n in sources if n.startswith("bench/estimators/") and n.count("/") == 3}
    named = re.compile(rf"\b({'|'.join(sorted(estimators))})\b|\bmessages::[A-Z]\w*") if estimators else None
    for name, text in sources.items():
        if not named or not name.startswith(ON_QUANTITIES):
            continue
        clean = without_comments(text)
        for found in named.finditer(clean):
            line = clean.count("\n", 0, found.start()) + 1
            yield f"{name}:{line}: names {found[0]}, expected quantities: what is particular stands in bench/estimators"


def estimator_breaches(sources):
    """Only the code in KNOW_ESTIMATORS names an estimator or a message of its answers."""
    own = {n: without_comments(t) for n, t in sources.items() if n.startswith("bench/estimators/")}
    estimators = {n.split("/")[2] for n in own if n.count("/") == 3}
    groups = re.findall(r"\b(?:Answer|Navigation)Group<([^<>;]*)>", " ".join(own.values()))
    answers = {m.strip().split("::")[-1] for g in groups for m in g.split(",")} - {"Messages...", "Attitude", "VelocityNE", "VelocityD"}
    if not estimators or not answers:
        return
    named = re.compile(rf'"(?:{"|".join(sorted(estimators))})"|\b(?:{"|".join(sorted(answers))})\b')
    for name, text in sources.items():
        if not name.startswith("bench/") or name.startswith(KNOW_ESTIMATORS):
            continue
        clean = without_comments(text)
        for found in named.finditer(clean):
            line = clean.count("\n", 0, found.start()) + 1
            yield f"{name}:{line}: names {found[0]}, expected the registry: what is particular stands in bench/estimators"


def node_breaches(sources, graph):
    """Only the sensor itself, the registry and the check of its ranges include a sensor's header; only these name its settings."""
    headers = {n for n, t in sources.items() if n.startswith("bench/sensors/") and re.search(r"\bextern const struct Kind \w+;", t)}
    settings = {s for n in headers for s in re.findall(r"\bstruct (\w+Settings) \{", sources[n])}
    named = re.compile(rf"\b({'|'.join(sorted(settings))})\b") if settings else None
    for name, text in sources.items():
        own = name.rsplit(".", 1)[0] + ".hpp"
        for line, _, other in graph[name]:
            if other in headers - {own, own.replace("bench/nodes/", "bench/sensors/")} and name != "bench/sensors/registry.cpp":
                yield f"{name}:{line}: includes {other}, expected the registry: what is particular stands in the sensor's own file"
        if named and not name.startswith(("bench/sensors/", "bench/nodes/")) and (found := named.search(clean := without_comments(text))):
            line = clean.count("\n", 0, found.start()) + 1
            yield f"{name}:{line}: names {found[0]}, expected scenario::NodeSettings: its table stands in bench/sensors"


def plant_breaches(sources):
    plants = re.findall(r"&(\w+)::table\b", sources.get("bench/plant/registry.cpp", ""))
    named = re.compile("|".join(rf"\b(?:{p}|{p.capitalize()}(?:[A-Z]\w*)?)\b" for p in sorted(plants))) if plants else None
    for name, text in sources.items():
        if not named or not name.startswith("bench/") or name.startswith(KNOW_PLANTS):
            continue
        for found in named.finditer(text):
            line = text.count("\n", 0, found.start()) + 1
            yield f"{name}:{line}: names {found[0]}, expected an output of a plant: what is particular stands in bench/plant"


def whose_dbc_breaches(sources):
    for name, text in sources.items():
        if not name.startswith("bench/") or name.startswith(KNOW_WHOSE_DBC):
            continue
        clean = without_comments(text, keep_strings=False)
        for found in WHOSE_DBC.finditer(clean):
            line = clean.count("\n", 0, found.start()) + 1
            yield f"{name}:{line}: names {found[0]}, expected a property of scenario::Binding: only bindings and the protocol know whose DBC it is"


def size_breaches(sources):
    for name, text in sources.items():
        lines = text.count("\n")
        if lines > MOST_LINES:
            yield f"{name}: {lines} lines, expected at most {MOST_LINES}"


def name_breaches(texts):
    for name in texts:
        for part in name.split("/"):
            stem = part.split(".")[0]
            words = re.sub("|".join(TERMS), "", stem.lower())
            vague = VAGUE & set(re.split(r"[_\-.]", words))
            if vague:
                yield f"{name}: named '{vague.pop()}', expected a name that says what it does"
        if name.split("/")[0] in CODE and Path(name).suffix in OTHER_SUFFIXES:
            yield f"{name}: a C++ file must end in .hpp or .cpp, or these rules do not see it"


def machine_path_breaches(texts):
    for name, text in texts.items():
        for number, line in enumerate(text.splitlines(), 1):
            if match := MACHINE_PATH.search(line):
                yield f"{name}:{number}: '{match[0]}' is a path of one machine, expected a relative one"


# The page of the target's duties; it names a test for each duty.
PROVEN = "docs/duty.md"
NAMED_TEST = re.compile(r"`([A-Z]\w+)\.([A-Z]\w+)`")
TEST = re.compile(r"\bTEST(?:_[FP])?\((\w+),\s*(\w+)\)")


def named_test_breaches(texts):
    tests = {match.groups() for name, text in texts.items() if name.endswith("_test.cpp") for match in TEST.finditer(text)}
    for number, line in enumerate(texts.get(PROVEN, "").splitlines(), 1):
        for match in NAMED_TEST.finditer(line):
            if match.groups() not in tests:
                yield f"{PROVEN}:{number}: there is no test {match[1]}.{match[2]}, expected one"


# Ids, scales and cycle times may be written only in the DBC. A hexadecimal number is compared with the ids
# on any line, a decimal number only on a line about an id.
BUILT_FROM = "dbc/canhil.dbc"
HEX = re.compile(r"\b0[xX]([0-9a-fA-F']+)[uUlL]*\b")
ABOUT_ID = re.compile(r"(?:\b\w*_?id\w*\s*(?:==|!=|=|\{|\()\s*|\bcase\s+)(\d+)[uUlL]*\b", re.I)
ABOUT_SCALE = re.compile(r"scale|factor|lsb|resolution|quantum", re.I)
NUMBER = re.compile(r"(?<![\w.])(?:\d+\.\d*|\.\d+|\d+)(?:[eE][+-]?\d+)?(?![\w.])")
CYCLE = re.compile(r"\b\w*(?:cycle_time|cycle_ms|cycle_us)\w*\s*(?:=|\{|\()\s*(\d+)", re.I)


def dbc_breaches(texts, sources):
    dbc = texts.get(BUILT_FROM, "")
    ids = {int(m) & 0x1FFFFFFF for m in re.findall(r"^BO_ (\d+)", dbc, re.M)}
    data_ids = {int(m) for m in re.findall(r'^BA_ "E2eDataId" BO_ \d+ (\d+)', dbc, re.M)}
    scales = {float(m) for m in re.findall(r"^ SG_ .*?@[01][+-] \(([^,]+),", dbc, re.M)} - {1.0}
    for name, text in sources.items():
        if name.startswith("dbc/"):
            continue
        for number, line in enumerate(without_comments(text, keep_strings=False).splitlines(), 1):
            where = f"{name}:{number}"
            hexes = {int(m.replace("'", ""), 16) for m in HEX.findall(line)}
            decimals = {int(m) for m in ABOUT_ID.findall(line)}
            for value in sorted((hexes | decimals) & (ids | data_ids)):
                yield f"{where}: {value} (0x{value:x}) is an id of {BUILT_FROM}, expected the generated name"
            if ABOUT_SCALE.search(line):
                for value in sorted({float(m) for m in NUMBER.findall(line)} & scales):
                    yield f"{where}: {value:g} is a scale of {BUILT_FROM}, expected the generated one"
            if cycle := CYCLE.search(line):
                yield f"{where}: a cycle time of {cycle[1]}, expected the one of {BUILT_FROM}"
