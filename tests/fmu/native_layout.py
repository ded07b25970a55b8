"""The native state's layout, as state_bytes.h and snapshot.h say, read by other code."""

import json
import struct
from typing import Any

from fmu_src.python.slider_component.variables import VARIABLES

SETTABLE = [v for v in VARIABLES if v.causality != "output"]
FIELDS = (
    *("velocity", "displacement", "rate", "position", "theta", "psi", "mode", "sliding"),
    *("reversals", "event_age", "travel", "work", "elapsed", "sticking", "complete"),
    *("mean_velocity", "friction_power", "stick_fraction", "bristle"),
    *("backward_stop", "backward_drift", "backward_curvature"),
    *("forward_stop", "forward_drift", "forward_curvature", "leap_error"),
    *("time", "time_carry", "stop_time", "last_event_time"),
    *("phase_derivative", "phase_is_new", "load_derivative", "load_is_new"),
    *("ratio_derivative", "ratio_is_new"),
    *(v.name for v in SETTABLE),
    "lifecycle",
)
LAYOUT = struct.Struct(f"<8s40s6d2i{len(FIELDS) - 9}diQ")


def checksum(data: bytes) -> int:
    """FNV-1a."""
    total = 14695981039346656037
    for byte in data:
        total = (total ^ byte) * 1099511628211 % 2**64
    return total


def moment_of(state: bytes) -> dict[str, Any]:
    """The motion in a state of either FMU by name, such as theta and psi."""
    if state.startswith(b"SLIDRES\x02"):
        return dict(zip(FIELDS, LAYOUT.unpack(state)[2:-1], strict=True))
    moment: dict[str, Any] = json.loads(state.partition(b"\n")[2])["moment"]
    return moment
