#!/usr/bin/env python3
"""Checks that each link from a page to a file or heading of the project has a target: links.py [ROOT]"""
import re
import sys
from pathlib import Path

LINK = re.compile(r"\]\(([^)#\s]*)(?:#([^)\s]*))?\)")
FENCED = re.compile(r"^```.*?^```", re.S | re.M)


def anchors(page):
    """The link targets (anchors) that GitHub and GitLab make from the headings of a Markdown page."""
    headings = re.findall(r"^#+ +(.*)$", FENCED.sub("", page.read_text()), re.M)
    return [re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", "-") for heading in headings]


def main():
    root = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parents[2]).resolve()
    pages = [*root.glob("*.md"), *(p for part in ("bench", "dbc", "docs", "target", "tests") for p in (root / part).rglob("*.md"))]
    broken = []
    for page in sorted(pages):
        for line, text in enumerate(FENCED.sub(lambda m: "\n" * m[0].count("\n"), page.read_text()).splitlines(), 1):
            for target, anchor in LINK.findall(text):
                if re.match(r"[a-z]+:", target):
                    continue
                file = page.parent / target if target else page
                if not file.exists():
                    broken.append(f"{page.relative_to(root)}:{line}: no file {target}")
                elif anchor and file.suffix == ".md" and anchor not in anchors(file):
                    broken.append(f"{page.relative_to(root)}:{line}: no heading #{anchor} in {file.resolve().relative_to(root)}")
    print("\n".join(broken) if broken else f"{len(pages)} pages, no broken link")
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main())
