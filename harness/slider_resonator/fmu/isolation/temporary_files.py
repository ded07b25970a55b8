"""Temporary files of processes that may end before they tidy up."""

from __future__ import annotations

_VARIABLES = ("TMPDIR", "TEMP", "TMP")
"""Environment variables that name the folder for temporary files, on one platform or another."""


def temporary_files_in(folder: str) -> dict[str, str]:
    """Return the environment variables with which a process makes its temporary files there."""
    return dict.fromkeys(_VARIABLES, folder)
