"""The frame of every generated header in C."""


def c_header(about: str, source: str, body: str) -> str:
    """Return a header that counts once; `source` is a path below `fmu_src`."""
    return f"/* {about}\n *\n * {generated_from(source)} */\n#pragma once\n\n{body}"


def generated_from(source: str) -> str:
    """Return the sentence that tells readers of a generated file where to edit."""
    return f"Generated from fmu_src/{source}: edit that file instead."
