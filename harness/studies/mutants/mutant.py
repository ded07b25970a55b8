"""A faulty FMU: the change and its place."""

from collections.abc import Mapping
from dataclasses import dataclass
from difflib import unified_diff

KINDS: Mapping[str, str] = {
    "operator": "arithmetic operator or function replaced",
    "constant": "constant changed",
    "sign": "minus dropped",
    "condition": "comparison, its boundary, and, or, not or a test changed",
    "removed": "statement removed",
    "unit": "unit mislabelled in the model description",
}
"""Kinds of mutants and what they change."""


@dataclass(frozen=True)
class Mutant:
    """One change to one file of an FMU.

    `path` is that of the file in the archive, `old` and `new` are its texts. `line` and `column`
    (from 1) are those of the change, `change` describes it.
    """

    file: str
    path: str
    line: int
    column: int
    kind: str
    change: str
    old: str
    new: str

    @property
    def name(self) -> str:
        """Place and change, different for each mutant."""
        return f"{self.file}:{self.line}:{self.column}: {self.change}"

    @property
    def diff(self) -> str:
        """The change as a unified diff with a line of context."""
        lines = unified_diff(
            self.old.splitlines(), self.new.splitlines(), self.file, self.file, n=1, lineterm=""
        )
        return "\n".join(lines)
