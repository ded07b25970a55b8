"""Error text for a name that does not exist: the nearest one, and what is allowed."""

from __future__ import annotations

from collections.abc import Iterable
from difflib import get_close_matches


def unknown_name(kind: str, name: str, allowed: Iterable[str]) -> str:
    """Return "unknown KIND 'NAME'", with the nearest of the allowed names and all of them."""
    names = sorted(allowed)
    by_folded = {candidate.lower(): candidate for candidate in names}
    near = get_close_matches(name.lower(), by_folded, n=1, cutoff=0.5)
    hint = f"; did you mean {by_folded[near[0]]!r}?" if near else ""
    return f"unknown {kind} {name!r}{hint} (must be one of {', '.join(names)})"
