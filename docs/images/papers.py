#!/usr/bin/env python3
"""Copies figures from the pages of the papers to docs/images/papers/PAPER_FIGURE.svg; the pages in docs/papers show these files.

    hil-bench campaign --paper transfer --out paper-transfer     # transfer, wind and los: two minutes each; inflight: seven
    python3 docs/images/papers.py paper-*/*.html

Writes only figures that docs/papers shows. Each gets its title, and a white background, because a browser may show the page with dark colours.
"""
import re
import sys
from html import unescape
from pathlib import Path

TO = Path(__file__).resolve().parent / "papers"
FIGURE = re.compile(r'<figure id="([^"]+)">\s*<h3>(.*?)</h3>.*?(<svg.*?</svg>)', re.S)


def standalone(svg, title):
    width, height = re.search(r'viewBox="0 0 (\d+) (\d+)"', svg).groups()
    head, body = svg.split(">", 1)
    return (f'{head} width="{width}" height="{height}">\n<title>{title}</title>\n'
            f'<rect width="{width}" height="{height}" fill="#ffffff"/>{body}\n')


def main(pages):
    if not pages:
        sys.exit(__doc__)
    TO.mkdir(exist_ok=True)
    shown = "".join(page.read_text() for page in (TO.parents[1] / "papers").glob("*.md"))
    for page in map(Path, pages):
        for name, title, svg in FIGURE.findall(page.read_text()):
            path = TO / f"{page.stem}_{name}.svg"
            if path.name not in shown:
                print(f"{path.name:28} not shown  {unescape(title)}")
                continue
            path.write_text(standalone(svg, title))
            print(f"{path.name:28} {path.stat().st_size // 1000:4} kB  {unescape(title)}")


if __name__ == "__main__":
    main(sys.argv[1:])
