"""The frame of every generated header in C."""

from __future__ import annotations


def c_header(name: str, about: str, source: str, body: str) -> str:
    """Return a header with an include guard; `source` is a path below `fmu_src`."""
    guard = f"SLIDER_{name.upper()}_H"
    return (
        f"/* {about}\n *\n * {generated_from(source)} */\n"
        f"#ifndef {guard}\n#define {guard}\n\n{body}\n#endif\n"
    )


def generated_from(source: str) -> str:
    """Return the sentence that tells readers of a generated file where to edit."""
    return f"Generated from fmu_src/{source}: edit that file instead."
