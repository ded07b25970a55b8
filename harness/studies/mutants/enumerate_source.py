"""All mutants of a Python module, in the order of its lines."""

import ast
from collections.abc import Iterator, Sequence

from studies.mutants.mutant import Mutant
from studies.mutants.operators import Edit, Source, edits, negated

_SHOWN = 40
"""Characters of a removed statement that its name repeats."""

Function = ast.FunctionDef | ast.AsyncFunctionDef


def source_mutants(file: str, path: str, text: str) -> list[Mutant]:
    """Return the mutants of the module `file`, with source `text`, sorted by place.

    Left alone are what describes and what cannot change a number: annotations, decorators,
    texts, and the words of errors.
    """
    source = Source(text)
    found = []
    for statement, inside in statements(ast.parse(text).body):
        for edit in _statement_edits(source, statement, inside):
            line, column = source.position(edit.begin)
            mutated = source.edited(edit)
            found.append(Mutant(file, path, line, column, edit.kind, edit.change, text, mutated))
    return sorted(found, key=lambda m: (m.line, m.column, m.change))


def statements(
    body: Sequence[ast.stmt], inside: Function | None = None
) -> Iterator[tuple[ast.stmt, Function | None]]:
    """Yield every statement with the function that it is in, None outside of any."""
    for statement in body:
        yield statement, inside
        within = statement if isinstance(statement, Function) else inside
        for block in blocks(statement):
            yield from statements(block, within)


def blocks(statement: ast.stmt) -> list[list[ast.stmt]]:
    """Return the lists of statements within a statement."""
    found = [getattr(statement, name, []) for name in ("body", "orelse", "finalbody")]
    found += [handler.body for handler in getattr(statement, "handlers", [])]
    return [block for block in found if block]


def _statement_edits(
    source: Source, statement: ast.stmt, inside: Function | None
) -> Iterator[Edit]:
    if isinstance(statement, ast.If | ast.While):
        yield from negated(source, statement.test)
    if isinstance(statement, ast.AugAssign):
        plain = ast.BinOp(statement.target, statement.op, statement.value)  # what += stands for
        yield from edits(source, plain)
    if inside is not None and _can_go(statement, inside):
        text = ast.unparse(statement)
        shown = text if len(text) <= _SHOWN else f"{text[:_SHOWN]}..."
        begin, end = source.begin(statement), source.end(statement)
        yield Edit(begin, end, "pass", "removed", f"{shown!r} is removed")
    for expression in _own_expressions(statement):
        for node in _nodes(expression):
            yield from edits(source, node)


def _can_go(statement: ast.stmt, inside: Function) -> bool:
    """Whether a function can do without a statement: what it would define exists before."""
    match statement:
        case ast.Expr(value=ast.Call()) | ast.AugAssign() | ast.Break() | ast.Continue():
            return True
        case ast.Raise():
            return True
        case ast.Return():
            return statement is not inside.body[-1]
        case ast.Assign(targets=targets):
            names = {name.id for target in targets for name in _bindings(target)}
            return names <= _bound_before(statement, inside)
    return False


def _bindings(node: ast.AST) -> Iterator[ast.Name]:
    """Yield the names that are bound somewhere in a node."""
    for inner in ast.walk(node):
        if isinstance(inner, ast.Name) and isinstance(inner.ctx, ast.Store):
            yield inner


def _bound_before(statement: ast.stmt, inside: Function) -> set[str]:
    """Return the names that a function has bound in lines above a statement."""
    arguments = inside.args
    named = [*arguments.posonlyargs, *arguments.args, *arguments.kwonlyargs]
    bound = {name.id for name in _bindings(inside) if name.lineno < statement.lineno}
    return bound | {argument.arg for argument in named}


def _own_expressions(statement: ast.stmt) -> list[ast.expr]:
    """Return the expressions that a statement evaluates itself, without those to be left alone."""
    match statement:
        case ast.FunctionDef(args=arguments):
            return [d for d in (*arguments.defaults, *arguments.kw_defaults) if d is not None]
        case ast.If(test=test) | ast.While(test=test):
            return [test]
        case ast.For(iter=over):
            return [over]
        case ast.With(items=items):
            return [item.context_expr for item in items]
        case ast.Return(value=value) | ast.AnnAssign(value=value) if value is not None:
            return [value]
        case ast.Assign(value=value) | ast.AugAssign(value=value) | ast.Expr(value=value):
            return [value]
    return []


def _nodes(expression: ast.expr) -> Iterator[ast.expr]:
    """Yield an expression and all within it but for formatted texts."""
    if isinstance(expression, ast.JoinedStr):
        return
    yield expression
    for child in ast.iter_child_nodes(expression):
        if isinstance(child, ast.expr):
            yield from _nodes(child)
        elif isinstance(child, ast.keyword):
            yield from _nodes(child.value)
        elif isinstance(child, ast.comprehension):
            for part in (child.iter, *child.ifs):
                yield from _nodes(part)
