"""Names in the temporary folder of an isolated FMU."""

from __future__ import annotations

WORK = "work"
"""The folder that the FMU runs in."""
PRINTED = "printed.txt"
"""What the FMU has printed."""
TRACEBACK = "traceback.txt"
"""The calls that the FMU was in at its end."""
