"""TOML: files, their mistakes explained with line and remedy, and values as text."""

import json
import re
import tomllib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any
from zipfile import is_zipfile

from slider_resonator.errors import SceneError, explained


def toml_value(value: object) -> str:
    """Return a number, text, list or mapping as a TOML value on one line."""
    if isinstance(value, Mapping):
        return f"{{ {', '.join(f'{key} = {toml_value(v)}' for key, v in value.items())} }}"
    if isinstance(value, Sequence) and not isinstance(value, str):
        return f"[{', '.join(map(toml_value, value))}]"
    return json.dumps(value, ensure_ascii=False)


def toml_text(content: Mapping[str, Any]) -> str:
    """Return the content of a scene as the text of its file, a heading for each table."""
    tables = {key: value for key, value in content.items() if isinstance(value, Mapping)}
    blocks: list[tuple[str, Mapping[str, Any]]]
    blocks = [("", {key: v for key, v in content.items() if key not in {*tables, "expect"}})]
    blocks += [(f"[{key}]\n", table) for key, table in tables.items()]
    blocks += [("[[expect]]\n", table) for table in content.get("expect", ())]
    return "\n".join(
        heading + "".join(f"{key} = {toml_value(value)}\n" for key, value in table.items())
        for heading, table in blocks
    )


_LINE = re.compile(r"\(at line (\d+), column \d+\)$")

_OPEN = r"[\[{][^\]}]*$"
_NUMBER = r"[-+]?(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][-+]?\d+)?"
_REMEDIES: tuple[tuple[str, str, str], ...] = (
    ("", r"=\s*([-+]?\d{1,3}),(\d{3})\s*(#.*)?$", r"a number has no comma: write \1\2 or \1.\2"),
    ("", r"=\s*([-+]?\d+),(\d+)\s*(#.*)?$", r"a number has a decimal point: write \1.\2"),
    ("", r"=\s*[-+]?(\.\d|\d+\.\s*(#|$))", "a point is between digits, as in 0.5 and 5.0"),
    ("", rf"=\s*({_NUMBER}\s*[A-Za-z°µμ/%]+)\s*(#.*)?$", r'a unit needs quotes: write "\1"'),
    ("", r"=\s*([\w.()]+\s*[*/^+-]\s*[-+\w.(]|-?(?i:pi|tau)\b)", "must be a number, such as 1e-3"),
    ("", r"^(;|//|--|%|/\*)", "a comment begins with #"),
    ("", r"=[^\[{]*[^\[{,;\s]\s*([,;])\s*(#.*)?$", r"nothing follows a value: delete the \1"),
    ("", r"([“”„‘’«»])", 'quotes are straight: write "'),
    ("", r"([−–])\s*[\d.]", "a minus sign is -"),
    ("", r"=\s*(?i:true|yes|on|false|no|off)\s*(#.*)?$", "write true or false"),
    ("", r"=\s*(\".*\"|'.*')[^#]*[\w\"'][^#]*$", "a text with quotes in it has others around it"),
    ("", r"=\s*\{\s*(#.*)?$", "a table in braces is on one line: close the brace there"),
    ("overwrite|twice|mutate", "", "must be there once: delete one"),
    ("hex value|Unescaped", r"\\", "a path in quotes is written with /"),
    ("Unclosed", r"\]\s*\[", "a comma must be between two values"),
    ("Unclosed|declaration", "", "close the bracket or brace"),
    ("", _OPEN, "close the bracket or brace"),
    ("Illegal character", "", "close the quotes"),
    ("Invalid value", r"=\s*[A-Za-z]", 'a text needs quotes, as in "my_step"'),
    ("", "", "must be key = value with a number, a text in quotes or a list, or a [heading]"),
)
"""The remedy for an error of a line, as patterns of both; the first that fits."""


def toml_mistake(text: str, error: str) -> str:
    """Return where and what is wrong in `text`, and the remedy, for the error of `tomllib`."""
    lines = text.splitlines() or [""]
    place = _LINE.search(error)
    opening = [n for n, line in enumerate(lines, 1) if re.search(_OPEN, line)] or [len(lines)]
    number = min(int(place[1]), len(lines)) if place else opening[-1]
    line = lines[number - 1].strip()
    shown = line if len(line) <= 60 else f"{line[:60]}..."
    wrong = _LINE.sub("", error).removesuffix("(at end of document)").strip()
    remedies = (
        found.expand(remedy)
        for of_error, of_line, remedy in _REMEDIES
        if re.search(of_error, error) and (found := re.search(of_line, line))
    )
    return f"line {number}: {shown}: not TOML: {wrong}; {next(remedies)}"


def read_toml(path: Path) -> dict[str, Any]:
    """Return the content of a TOML file in UTF-8, with or without a byte order mark.

    Raises SceneError with the file, the line and the remedy.
    """
    with explained(f"{path}: cannot be read: "):
        content = path.read_bytes()
    if is_zipfile(path):
        raise SceneError(f"{path}: not TOML: a zip archive, such as an FMU; must be UTF-8 text")
    try:
        text = content.decode("utf-8-sig")
        return tomllib.loads(text)
    except UnicodeDecodeError as error:
        line = content.count(b"\n", 0, error.start) + 1
        raise SceneError(
            f"{path}: line {line}: not TOML: {error.reason}; must be UTF-8 text"
        ) from error
    except tomllib.TOMLDecodeError as error:
        raise SceneError(f"{path}: {toml_mistake(text, str(error))}") from error
    except RecursionError as error:
        raise SceneError(f"{path}: nested too deeply; must be tables of values") from error
