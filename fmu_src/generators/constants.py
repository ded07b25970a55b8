"""The constants of the twins as macros of C, from the Python module that defines them."""

from __future__ import annotations

import ast
import inspect
import textwrap

from fmu_src.generators.origin import origin
from fmu_src.python.slider_component import constants

_FILE = """\
/* Constants that the twins share.
 *
 * {origin} */
#ifndef SLIDER_CONSTANTS_H
#define SLIDER_CONSTANTS_H

{definitions}
#endif
"""


def c_constants() -> str:
    """Return the text of constants.h: each number with its docstring as the comment before it."""
    source = inspect.getsource(constants)
    body = ast.parse(source).body
    definitions = "\n".join(
        f"{_comment(following)}#define {statement.targets[0].id} {_number(source, statement)}\n"
        for statement, following in zip(body, [*body[1:], None], strict=True)
        if isinstance(statement, ast.Assign) and isinstance(statement.targets[0], ast.Name)
    )
    return _FILE.format(
        origin=origin("python/slider_component/constants.py"), definitions=definitions
    )


def _number(source: str, statement: ast.Assign) -> str:
    """Return the number as it is written; C has no underscores between digits."""
    return str(ast.get_source_segment(source, statement.value)).replace("_", "")


def _comment(statement: ast.stmt | None) -> str:
    """Return a docstring as a comment, or nothing where there is none."""
    if not isinstance(statement, ast.Expr):
        return ""
    text = " ".join(str(ast.literal_eval(statement.value)).split())
    return textwrap.fill(f"/* {text} */", 100, subsequent_indent=" * ") + "\n"
