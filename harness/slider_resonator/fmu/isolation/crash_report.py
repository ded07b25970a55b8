"""Describing how the process of an FMU ended, and in which call."""

import re
import signal
from collections.abc import Mapping
from contextlib import suppress

from slider_resonator.fmu.fmi3_slave import in_fmi_3
from slider_resonator.fmu.isolation.supervised import Ending

MAX_PRINTED = 500
"""Maximum characters of the FMU's own output in the report."""

_CALLS: Mapping[str, str] = {
    "step_to": "fmi2DoStep",
    "step_by": "fmi2DoStep",
    "read": "fmi2GetReal",
    "write": "fmi2SetReal",
    "write_rates": "fmi2SetRealInputDerivatives",
    "start": "initialisation",
    "instantiate": "fmi2Instantiate",
    "end": "fmi2Terminate or fmi2FreeInstance",
}
"""Function of `fmu.instance` to the FMI functions that it calls."""

_FRAME = re.compile(r'File ".*[\\/]fmu[\\/]instance\.py", line \d+ in (\w+)')
_FRAME_3 = re.compile(r'File ".*[\\/](?:fmu[\\/]fmi3_slave|fmpy[\\/]fmi3)\.py", line')


def crash_report(
    fmu: str, printed: str, trace: str, ending: Ending, limit: float
) -> tuple[str, bool]:
    """Return a sentence on how the process of an FMU ended, and whether it exceeded a limit.

    `fmu` is the name of its file, `printed` the end of what it wrote to standard error, `trace` the
    traceback of the call that it was in, `limit` its time limit (s).
    """
    call = next((_CALLS[name] for name in _FRAME.findall(trace) if name in _CALLS), "")
    if _FRAME_3.search(trace):
        call = in_fmi_3(call)
    where = f" in {call}" if call else ""
    # While it writes the traceback of a thread that goes on it may crash.
    is_late = ending.code is None or (ending.code != 0 and "Timeout (" in trace)
    if ending.excess:
        report = f"{fmu} was ended: it had {ending.excess}"
    elif is_late:
        report = f"no answer within the time limit of {limit:g} s{where}: {fmu} was ended"
    else:
        end = f"exit code {ending.code}"
        if ending.code is not None and ending.code < 0:
            end = f"signal {-ending.code}"
            with suppress(ValueError):
                end = signal.Signals(-ending.code).name
        report = f"{fmu} crashed{where}: its process ended with {end}"
    own = " ".join(printed.split())[-MAX_PRINTED:]
    return (f"{report}; it printed: {own}" if own else report), is_late or bool(ending.excess)
