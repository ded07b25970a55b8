"""The help of commands, with examples that fit the terminal and can still be copied."""

import re
import textwrap
from collections.abc import Iterable

import click

from slider_resonator.output.terminal import fitting

_EXAMPLE = re.compile(r"\s*(slider-resonator|python|pip) ")
_OPTION_AND_VALUE = re.compile(r"(?:--?\S+ (?!-)|> )?\S+")


_WHOLE = "\N{NON-BREAKING HYPHEN}"
"""Stands for a hyphen while click wraps: it would split names there."""


class FittingHelp(click.HelpFormatter):
    r"""A help formatter that splits no name, and wraps the examples that click leaves unwrapped.

    Examples are the paragraphs that begin with a line \b.
    """

    def write(self, string: str) -> None:
        """Write what is wrapped."""
        super().write(string.replace(_WHOLE, "-"))

    def write_text(self, text: str) -> None:
        """Write a text."""
        width = max(self.width - self.current_indent, 20)
        fitted = "\n\n".join(_paragraph(part, width) for part in text.split("\n\n"))
        super().write_text(fitted.replace("-", _WHOLE))

    def write_dl(
        self, rows: Iterable[tuple[str, str]], col_max: int = 30, col_spacing: int = 2
    ) -> None:
        """Write a list of names with their texts."""
        whole = [(name, text.replace("-", _WHOLE)) for name, text in rows]
        super().write_dl(whole, col_max, col_spacing)


def _paragraph(text: str, width: int) -> str:
    lines = text.splitlines()
    if not lines or lines[0].strip() != "\b":
        return text
    for index, line in enumerate(lines):
        if len(line) > width:
            lines[index] = _example(line, width) if _EXAMPLE.match(line) else fitting(line, width)
    return "\n".join(lines)


def _example(line: str, width: int) -> str:
    """Return a command on several lines of a shell, an option on that of its value."""
    indent = line[: len(line) - len(line.lstrip())]
    # textwrap breaks at blanks: those that stay are another character meanwhile.
    joined = [found.replace(" ", "\0") for found in _OPTION_AND_VALUE.findall(line)]
    rows = textwrap.wrap(
        " ".join(joined),
        width - len(" \\"),
        initial_indent=indent,
        subsequent_indent=f"{indent}    ",
        break_long_words=False,
        break_on_hyphens=False,
    )
    return " \\\n".join(rows).replace("\0", " ")
