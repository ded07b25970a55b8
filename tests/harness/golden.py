"""Texts against the files in the folder `screens`, which `UPDATE_SCREENS=1 pytest` writes anew."""

import os
from pathlib import Path

SCREENS = Path(__file__).parent / "screens"


def assert_as_before(name: str, text: str) -> None:
    """Compare a text with the file of that name; review what an update changes."""
    file = SCREENS / name
    if os.environ.get("UPDATE_SCREENS"):
        file.write_text(text, encoding="utf-8")
    assert text == file.read_text(encoding="utf-8")
