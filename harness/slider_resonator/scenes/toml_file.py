"""Read a TOML file that a user has written: a scene or the grid of a sweep."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any
from zipfile import is_zipfile

from slider_resonator.errors import SceneError
from slider_resonator.scenes.toml_mistakes import toml_mistake


def read_toml(path: Path) -> dict[str, Any]:
    """Return the content of a TOML file in UTF-8, with or without a byte order mark.

    Raises SceneError with the file, the line and the remedy.
    """
    try:
        content = path.read_bytes()
    except OSError as error:
        raise SceneError(f"{path}: cannot be read: {error.strerror}") from error
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
