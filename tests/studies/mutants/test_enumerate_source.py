from __future__ import annotations

import ast
from collections import Counter

from studies.mutants.enumerate_source import source_mutants

MODULE = '''"""A module."""

from __future__ import annotations

from dataclasses import dataclass

LIMIT = 2.0


@dataclass(frozen=True)
class Thing:
    size: float = 1.0

    def grown(self, by: float | None = None, times: int = 3) -> float:
        """Return 1 + 1."""
        result = self.size
        if by is not None and by > LIMIT:
            raise ValueError(f"{by + 1} is above {LIMIT}")
        while times:
            times -= 1
            result = result * 2.0
            if result > 100.0:
                break
        note(result)
        return result
'''


def changes() -> list[tuple[int, str]]:
    return [(m.line, m.change) for m in source_mutants("module.py", "p/module.py", MODULE)]


def test_every_change_of_a_module() -> None:
    assert changes() == [
        (7, "2.0 becomes 2.02"),
        (7, "2.0 becomes 3.0"),
        (12, "1.0 becomes 1.01"),
        (12, "1.0 becomes 2.0"),
        (14, "3 becomes 4"),
        (17, "test becomes its negation"),
        (17, "is not becomes is"),
        (17, "and becomes or"),
        (17, "> becomes <="),
        (17, "> becomes >="),
        (18, '"raise ValueError(f\'{by + 1} is above {LI..." is removed'),
        (19, "test becomes its negation"),
        (20, "'times -= 1' is removed"),
        (20, "- becomes +"),
        (20, "1 becomes 2"),
        (21, "'result = result * 2.0' is removed"),
        (21, "* becomes /"),
        (21, "2.0 becomes 2.02"),
        (21, "2.0 becomes 3.0"),
        (22, "> becomes <="),
        (22, "> becomes >="),
        (22, "100.0 becomes 101.0"),
        (23, "'break' is removed"),
        (24, "'note(result)' is removed"),
    ]


def test_annotations_decorators_texts_and_first_definitions_are_left_alone() -> None:
    lines = Counter(line for line, _ in changes())
    described = (1, 3, 5, 10, 11, 15)
    assert not [line for line in described if lines[line]]
    assert not lines[16], "without it the next line would fail: that shows nothing"
    assert not lines[25], "the last return cannot go"


def test_every_mutant_compiles_and_differs() -> None:
    for mutant in source_mutants("module.py", "p/module.py", MODULE):
        tree = ast.parse(mutant.new)
        compile(tree, mutant.name, "exec")
        assert ast.dump(tree) != ast.dump(ast.parse(MODULE)), mutant.name


def test_the_diff_shows_the_change() -> None:
    mutant = next(m for m in source_mutants("m.py", "p/m.py", MODULE) if m.line == 23)
    assert "-                break\n+                pass\n" in mutant.diff
