"""What an FMU may use; the environment passes the limits on to the process of the FMU."""

import os

from slider_resonator.errors import HarnessError

MEMORY = "SLIDER_RESONATOR_MAX_MEMORY"
UNPACKED = "SLIDER_RESONATOR_MAX_UNPACKED"
DEFAULTS = {MEMORY: 4096, UNPACKED: 1024}
"""Variable to its value where it is not set, MiB."""
MAX_WRITTEN = 2**26
"""Maximum size (bytes) of a file that an FMU writes, also of what it prints."""
MAX_ENTRIES = 20_000
"""Maximum number of files in an FMU."""


def max_bytes(variable: str) -> int:
    """Return a limit: the memory of an FMU and all that it starts, or the size of its files."""
    text = os.environ.get(variable) or str(DEFAULTS[variable])
    if not text.isdecimal() or int(text) == 0:
        raise HarnessError(f"{variable} = {text!r}: must be a whole number of MiB above 0")
    return int(text) * 2**20
