from __future__ import annotations

from studies.mutants.combined import combined_sources, groups_of
from studies.mutants.enumerate_source import source_mutants
from studies.mutants.mutant import Mutant

MODULE = """def worth(x):
    y = 2.0 * x
    note(
        x,
        y,
    )
    if x > 0:
        y = y + 1.0
    return y
"""


def mutants(*changes: str) -> list[Mutant]:
    made = {m.change: m for m in source_mutants("a.py", "package/a.py", MODULE)}
    return [made[change] for change in changes]


def run(source: bytes, x: float) -> tuple[float, set[int]]:
    """Return the value of the function, and the lines that it has noted."""
    namespace: dict[str, object] = {"note": lambda x, y: None}
    exec(source, namespace)
    worth, noted = namespace["worth"], namespace["_noted_lines"]
    assert callable(worth)
    assert isinstance(noted, set)
    return worth(x), noted


def test_all_changes_are_made_and_lines_keep_their_numbers() -> None:
    removed, other = "'note(x, y)' is removed", "> becomes <="
    chosen = mutants("* becomes /", removed, other, "+ becomes -")
    sources = combined_sources(chosen)
    assert list(sources) == ["package/a.py"]
    assert run(sources["package/a.py"], 4.0) == (0.5, {2, 3, 7, 9})
    assert run(sources["package/a.py"], -4.0) == (-1.5, {2, 3, 7, 8, 9})
    assert {m.statement for m in chosen} == {2, 3, 7, 8}, "lines by which a run is known"


def test_groups_are_of_limited_size_and_change_a_statement_once() -> None:
    first, second, third = mutants("* becomes /", "2.0 becomes 3.0", "+ becomes -")
    assert groups_of([first, second, third], 2) == [[first, third], [second]]
    assert groups_of([first, third], 1) == [[first], [third]]
