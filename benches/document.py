"""Puts what a benchmark has measured into docs/performance.md, between two markers."""

import os
from pathlib import Path

DOCUMENT = Path(__file__).resolve().parent.parent / "docs" / "performance.md"


def replace(section, text):
    """Replaces what stands between the markers of a section; the rest of the document stays."""
    begin, end = f"<!-- {section}: written by its benchmark -->", f"<!-- {section}: end -->"
    whole = DOCUMENT.read_text(encoding="utf-8")
    if whole.count(begin) != 1 or whole.count(end) != 1:
        raise SystemExit(f"{DOCUMENT} has no section {section}: {begin}")
    before, _, rest = whole.partition(begin)
    after = rest.partition(end)[2]
    beside = DOCUMENT.with_suffix(".md.part")
    beside.write_text(f"{before}{begin}\n\n{text.strip()}\n\n{end}{after}", encoding="utf-8")
    os.replace(beside, DOCUMENT)
