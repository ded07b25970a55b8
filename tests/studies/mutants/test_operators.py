from __future__ import annotations

import ast

import pytest

from studies.mutants.operators import Source, edits


def changed(expression: str) -> set[str]:
    """All sources that one edit of any node of an expression leads to."""
    source = Source(expression)
    nodes = [n for n in ast.walk(ast.parse(expression, mode="eval")) if isinstance(n, ast.expr)]
    return {source.edited(edit) for node in nodes for edit in edits(source, node)}


@pytest.mark.parametrize(
    ("expression", "expected"),
    [
        ("a + b", {"a - b"}),
        ("a - b", {"a + b"}),
        ("a * b", {"a / b"}),
        ("a / b", {"a * b"}),
        ("a % b", {"a * b"}),
        ("a ** b", {"a * b"}),
        ("a // b", {"a * b"}),
        ("a < b", {"a <= b", "a >= b"}),
        ("a <= b", {"a < b", "a > b"}),
        ("a > b", {"a >= b", "a <= b"}),
        ("a >= b", {"a > b", "a < b"}),
        ("a == b", {"a != b"}),
        ("a != b", {"a == b"}),
        ("a is b", {"a is not b"}),
        ("a is not b", {"a is b"}),
        ("a in b", {"a not in b"}),
        ("a not in b", {"a in b"}),
        ("a < b <= c", {"a <= b <= c", "a >= b <= c", "a < b < c", "a < b > c"}),
        ("a and b and c", {"a or b and c", "a and b or c"}),
        ("a or b", {"a and b"}),
        ("not a", {"a"}),
        ("-a", {"a"}),
        ("-(a)", {"(a)"}),
        ("a if b else c", {"a if not (b) else c"}),
        ("sin(a)", {"cos(a)"}),
        ("cos(a)", {"sin(a)"}),
        ("min(a, b)", {"max(a, b)"}),
        ("max(a, b)", {"min(a, b)"}),
        ("floor(a)", {"ceil(a)"}),
        ("ceil(a)", {"floor(a)"}),
        ("abs(a)", {"(a)"}),
        ("a.real", {"a.imag"}),
        ("a.imag", {"a.real"}),
        ("True", {"False"}),
        ("3", {"4"}),
        ("0", {"1"}),
        ("0.0", {"1.0"}),
        ("2.0", {"2.02", "3.0"}),
        ("0j", {"1j"}),
        ("2j", {"2.02j"}),
        ("'text'", set()),
        ("None", set()),
        ("a", set()),
    ],
)
def test_each_operator(expression: str, expected: set[str]) -> None:
    assert changed(expression) == expected


def test_only_the_operator_changes_also_over_lines_brackets_and_letters_beyond_ascii() -> None:
    source = "(µ +\n  a) * (b\n  - c)"
    assert changed(source) == {
        "(µ -\n  a) * (b\n  - c)",
        "(µ +\n  a) / (b\n  - c)",
        "(µ +\n  a) * (b\n  + c)",
    }


def test_a_position_is_that_of_the_change() -> None:
    source = Source("a = (b\n     < c)")
    (comparison,) = (n for n in ast.walk(ast.parse("a = (b\n     < c)")) if _compares(n))
    assert isinstance(comparison, ast.expr)
    assert {source.position(edit.begin) for edit in edits(source, comparison)} == {(2, 6)}


def _compares(node: ast.AST) -> bool:
    return isinstance(node, ast.Compare)
