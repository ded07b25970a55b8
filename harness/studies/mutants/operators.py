"""Small changes of an expression, as edits of the source: one token or one operand each.

The choice follows the usual tools for Python: neighbouring operators, boundaries and negations of
comparisons, constants that are a little off or one too large, signs. Beside these there are
functions whose confusion is a slip that happens in formulas.
"""

import ast
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import pairwise

ARITHMETIC: Mapping[type[ast.operator], tuple[str, str]] = {
    ast.Add: ("+", "-"),
    ast.Sub: ("-", "+"),
    ast.Mult: ("*", "/"),
    ast.Div: ("/", "*"),
    ast.Mod: ("%", "*"),
    ast.Pow: ("**", "*"),
    ast.FloorDiv: ("//", "*"),
}
"""Operator to its sign and the one that takes its place."""

COMPARISONS: Mapping[type[ast.cmpop], tuple[str, ...]] = {
    ast.Lt: ("<", "<=", ">="),
    ast.LtE: ("<=", "<", ">"),
    ast.Gt: (">", ">=", "<="),
    ast.GtE: (">=", ">", "<"),
    ast.Eq: ("==", "!="),
    ast.NotEq: ("!=", "=="),
    ast.Is: ("is", "is not"),
    ast.IsNot: ("is not", "is"),
    ast.In: ("in", "not in"),
    ast.NotIn: ("not in", "in"),
}
"""Comparison to its sign, the one with the other boundary if any, and its negation."""

FUNCTIONS: Mapping[str, str] = {
    "sin": "cos",
    "cos": "sin",
    "min": "max",
    "max": "min",
    "floor": "ceil",
    "ceil": "floor",
    "abs": "",
}
"""Function to the one that takes its place; without a name the argument does."""

PARTS: Mapping[str, str] = {"real": "imag", "imag": "real"}
OFF = 1.01


@dataclass(frozen=True)
class Edit:
    """Bytes from `begin` up to `end` of a source replaced by `text`, and what that means."""

    begin: int
    end: int
    text: str
    kind: str
    change: str


class Source:
    """The bytes of a source, addressed by the positions of its syntax tree."""

    def __init__(self, text: str) -> None:
        self.data = text.encode()
        self._starts = [0]
        for line in self.data.splitlines(keepends=True):
            self._starts.append(self._starts[-1] + len(line))

    def begin(self, node: ast.expr | ast.stmt) -> int:
        """Return where a node begins."""
        return self._starts[node.lineno - 1] + node.col_offset

    def end(self, node: ast.expr | ast.stmt) -> int:
        """Return where a node has ended."""
        assert node.end_lineno is not None
        assert node.end_col_offset is not None
        return self._starts[node.end_lineno - 1] + node.end_col_offset

    def between(self, left: ast.expr, right: ast.expr, sign: str) -> tuple[int, int]:
        """Return where the operator `sign` between two operands begins and ends."""
        begin = self.data.index(sign.encode(), self.end(left), self.begin(right))
        return begin, begin + len(sign)

    def position(self, offset: int) -> tuple[int, int]:
        """Return line and column, from 1, of a byte."""
        line = next(n for n, start in enumerate(self._starts) if start > offset)
        return line, offset - self._starts[line - 1] + 1

    def edited(self, edit: Edit) -> str:
        """Return the source with an edit made."""
        changed = self.data[: edit.begin] + edit.text.encode() + self.data[edit.end :]
        return changed.decode()


def edits(source: Source, node: ast.expr) -> Iterator[Edit]:
    """Yield the changes of one node of an expression, leaving its operands alone."""
    match node:
        case ast.BinOp(left=left, op=operator, right=right) if type(operator) in ARITHMETIC:
            sign, other = ARITHMETIC[type(operator)]
            yield _swap(*source.between(left, right, sign), sign, other, "operator")
        case ast.Compare(left=first, ops=ops, comparators=rest):
            for left, comparison, right in zip([first, *rest], ops, rest, strict=False):
                sign, *others = COMPARISONS[type(comparison)]
                for other in others:
                    yield _swap(*source.between(left, right, sign), sign, other, "condition")
        case ast.BoolOp(op=junction, values=values):
            sign, other = ("and", "or") if isinstance(junction, ast.And) else ("or", "and")
            for left, right in pairwise(values):
                yield _swap(*source.between(left, right, sign), sign, other, "condition")
        case ast.UnaryOp(op=ast.USub(), operand=operand):
            yield _dropped(source, node, operand, "-", "sign")
        case ast.UnaryOp(op=ast.Not(), operand=operand):
            yield _dropped(source, node, operand, "not", "condition")
        case ast.Constant(value=value):
            for other in dict.fromkeys(_other_constants(value)):
                where = source.begin(node), source.end(node)
                yield _swap(*where, repr(value), other, "constant")
        case ast.Call(func=ast.Name(id=name) as function) if name in FUNCTIONS:
            where = source.begin(function), source.end(function)
            yield _swap(*where, name, FUNCTIONS[name], "operator")
        case ast.Attribute(attr=part) if part in PARTS:
            end = source.end(node)
            yield _swap(end - len(part), end, part, PARTS[part], "operator")
        case ast.IfExp(test=test):
            yield from negated(source, test)


def negated(source: Source, test: ast.expr) -> Iterator[Edit]:
    """Yield the negation of a test that is neither a comparison nor a negation itself."""
    if isinstance(test, ast.Compare) and len(test.ops) == 1:
        return
    if isinstance(test, ast.UnaryOp) and isinstance(test.op, ast.Not):
        return
    begin, end = source.begin(test), source.end(test)
    text = source.data[begin:end].decode()
    yield Edit(begin, end, f"not ({text})", "condition", "test becomes its negation")


def _swap(begin: int, end: int, old: str, new: str, kind: str) -> Edit:
    what = f"{old} becomes {new}" if new else f"{old} is dropped"
    return Edit(begin, end, new, kind, what)


def _dropped(source: Source, node: ast.expr, operand: ast.expr, sign: str, kind: str) -> Edit:
    begin, end = source.begin(node), source.begin(operand)
    rest = source.data[begin + len(sign) : end].decode()  # an opening bracket may stand there
    return Edit(begin, end, rest.lstrip(), kind, f"{sign} is dropped")


def _other_constants(value: object) -> list[str]:
    match value:
        case bool():
            return [repr(not value)]
        case int():
            return [repr(value + 1)]
        case float() | complex() if value == 0:
            return [repr(value + 1) if isinstance(value, float) else "1j"]
        case float():
            return [repr(float(f"{OFF * value:.12g}")), repr(value + 1.0)]
        case complex():
            return [repr(OFF * value)]
    return []
