"""One HTML file that needs nothing beside it: the frame around a report's parts."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from pathlib import Path

from slider_resonator.output.atomic import replacing

_STYLE = """
body { font: 15px/1.45 system-ui, sans-serif; margin: 2rem auto; max-width: 72rem; padding: 0 1rem;
  color: #222 }
table { border-collapse: collapse; font-size: 13px; font-variant-numeric: tabular-nums }
th, td { text-align: left; padding: .2rem .6rem; border-bottom: 1px solid #ddd }
td.n { text-align: right; white-space: nowrap }
.pass { color: #1a7f37 } .fail { color: #b3261e; font-weight: 600 } .why { color: #666 }
.wide { overflow-x: auto } .wide table { width: 100% }
img { max-width: 100% } summary { cursor: pointer; margin: 1rem 0 }
pre { background: #f6f6f6; padding: .6rem; overflow-x: auto; font-size: 12px }
"""


def write_page(path: Path, title: str, parts: Sequence[str]) -> None:
    """Write a page with a title and parts of HTML; HarnessError when it cannot be written."""
    page = [
        '<!DOCTYPE html><html lang="en"><head><meta charset="utf-8">',
        '<meta name="viewport" content="width=device-width">',
        f"<title>{escape(title)}</title><style>{_STYLE}</style></head><body>",
        f"<h1>{escape(title)}</h1>",
        *parts,
        "</body></html>",
    ]
    with replacing(path) as temporary:
        temporary.write_text("\n".join(page) + "\n", encoding="utf-8", errors="replace")
