"""Describing how the process of an FMU ended, and in which call."""

from __future__ import annotations

import re
import signal
from collections.abc import Mapping

MAX_PRINTED = 500
"""Maximum characters of the FMU's own output in the report."""

_CALLS: Mapping[str, str] = {
    "step_to": "fmi2DoStep",
    "step_by": "fmi2DoStep",
    "read": "fmi2GetReal",
    "write": "fmi2SetReal",
    "value": "fmi2GetReal or fmi2GetInteger",
    "start": "initialisation",
    "instantiate": "fmi2Instantiate",
    "end": "fmi2Terminate or fmi2FreeInstance",
}
"""Function of `slider_resonator.fmu.instance` to the FMI functions that it calls."""

_FRAME = re.compile(r'File ".*[\\/]fmu[\\/]instance\.py", line \d+ in (\w+)')
_TRACEBACK = re.compile(r"^(Fatal Python error: |Timeout \(|Windows fatal exception: )", re.M)


def crash_report(log: str, code: int | None, limit: float) -> str:
    """Return a sentence on how the process ended; `code` is None where it had to be killed.

    `log` is what it wrote to standard error, with the traceback of the call it was in; `limit` is
    its time limit (s).
    """
    timed_out = code is None or (code > 0 and "Timeout (" in log)
    call = next((_CALLS[name] for name in _FRAME.findall(log) if name in _CALLS), "")
    where = f" in {call}" if call else ""
    if timed_out:
        report = f"no answer within the time limit of {limit:g} s{where}: the FMU was ended"
    else:
        report = f"the FMU crashed{where}: its process ended with {_ending(code)}"
    found = _TRACEBACK.search(log)
    printed = log[: found.start()] if found else log
    own = " ".join(printed.split())[-MAX_PRINTED:]
    return f"{report}; it printed: {own}" if own else report


def _ending(code: int | None) -> str:
    if code is not None and code < 0:
        try:
            return signal.Signals(-code).name
        except ValueError:
            return f"signal {-code}"
    return f"exit code {code}"
