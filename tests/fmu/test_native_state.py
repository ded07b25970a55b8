"""The serialised state of the native FMU: the same layout everywhere, and nothing else is taken."""

import ctypes
import math
import struct

import pytest

from tests.fmu.host import Instance, Unpacked
from tests.fmu.native_calls import ERROR, OK, call, check
from tests.fmu.native_layout import HEAD, LAYOUT, SETTABLE, checksum, numbers
from tests.fmus import native_fmu_only

pytestmark = native_fmu_only

STEP = 3.1e-4
NULL, ROOM = ctypes.c_void_p(), ctypes.create_string_buffer(500)


def forged(data: bytes, **changes: float) -> bytes:
    """A state with other numbers and the checksum that belongs to them."""
    changed = numbers(data) | changes
    body = data[:HEAD] + struct.pack(f"<{len(changed)}d", *changed.values())
    return body + struct.pack("<Q", checksum(body))


def test_the_layout_is_that_of_any_platform(instance: Instance, unpacked: Unpacked) -> None:
    instance.set(phase=0.4)
    instance.run(7, STEP)
    data = instance.state()
    magic, guid, *_, found = LAYOUT.unpack(data)
    assert magic == b"SLIDRES\x01", "the version of the layout is part of it"
    assert guid.rstrip(b"\0").decode() == unpacked.description.guid
    assert found == checksum(data[:-8])
    state = numbers(data)
    assert state["time"] == instance.time
    assert state["stop_time"] == math.inf
    assert state["event_age"] >= 0.0
    for name in ("position", "velocity", "reversals", "last_event_time"):
        assert (state[name],) == instance.get(name), name
    for variable in SETTABLE:
        expected = 0.4 if variable.name == "phase" else variable.start
        assert state[variable.name] == expected, variable.name


@pytest.mark.parametrize(
    ("changes", "text"),
    [
        ({"time": math.nan}, "time = nan; must be a finite number"),
        ({"stop_time": math.nan}, "stop_time = nan; must be a finite number"),
        ({"event_age": -math.inf}, "event_age = -inf; must be a finite number"),
        ({"velocity": math.inf}, "velocity = inf; must be a finite number"),
        ({"theta": -1e-6}, "theta = -1e-06; must be a phase from 0 to 2 pi"),
        ({"psi": 6.3}, "psi = 6.3; must be a phase from 0 to 2 pi"),
        ({"psi": 1e300}, "psi = 1e+300; must be a phase from 0 to 2 pi"),
        ({"theta": math.nan}, "theta = nan; must be a phase from 0 to 2 pi"),
        ({"mode": 3.0}, "mode = 3.0; must be an integer from -1 to 2"),
        ({"mode": 0.5}, "mode = 0.5; must be an integer from -1 to 2"),
        ({"sliding": math.nan}, "sliding = nan; must be an integer from -1 to 1"),
        ({"lifecycle": 4.0}, "lifecycle = 4.0; must be an integer from 0 to 3"),
        ({"complete": -1.0}, "complete = -1.0; must be an integer from 0 to 1"),
        ({"load": math.nan}, "load = nan refused: must be a finite number"),
        ({"slider_mass": 0.0}, "slider_mass = 0.0 refused: must be a finite number of at least"),
        ({"friction_faces": 1.5}, "friction_faces = 1.5 refused: must be an integer"),
        (
            {"friction_law": 1.0, "friction_coefficient": 0.0},
            "friction_coefficient = 0.0 refused: with LuGre friction",
        ),
    ],
    ids=str,
)
def test_numbers_that_no_instance_has_are_refused(
    instance: Instance, changes: dict[str, float], text: str
) -> None:
    instance.run(3, STEP)
    with instance.refuses(text):
        instance.restore(forged(instance.state(), **changes))


def test_a_state_of_another_build_is_refused_by_name(instance: Instance) -> None:
    data = instance.state()
    body = data[:8] + data[8:48].replace(data[8:12], b"0bad") + data[48:-8]
    with instance.refuses("FMU state refused: it is of another build; must be of the build"):
        instance.restore(body + struct.pack("<Q", checksum(body)))


def test_a_state_of_another_fmu_is_refused(instance: Instance) -> None:
    with instance.refuses("FMU state refused", "without the header of a state"):
        instance.restore(b'{"format": "slider state"}'.ljust(LAYOUT.size))


def test_memory_of_another_size_is_refused(instance: Instance) -> None:
    state = instance.slave.getFMUstate()
    size = ctypes.c_size_t()
    assert call(instance, "fmi2SerializedFMUstateSize", state, ctypes.byref(size)) == OK
    memory = ctypes.create_string_buffer(size.value + 1)
    for wrong in (0, size.value - 1, size.value + 1):
        assert call(instance, "fmi2SerializeFMUstate", state, memory, wrong) == ERROR
        assert f"size = {wrong} refused: must be {size.value}" in instance.log[-1]
        assert memory.raw == bytes(size.value + 1), "nothing was written"
    instance.slave.freeFMUstate(state)


@pytest.mark.parametrize(
    ("function", "arguments"),
    [
        ("GetFMUstate", (NULL,)),
        ("SetFMUstate", (NULL,)),
        ("SerializedFMUstateSize", (NULL, ROOM)),
        ("SerializeFMUstate", (NULL, ROOM, 500)),
        ("DeSerializeFMUstate", (NULL, 500, ROOM)),
        ("DeSerializeFMUstate", (ROOM, 500, NULL)),
    ],
)
def test_null_pointers_are_refused(
    instance: Instance, function: str, arguments: tuple[object, ...]
) -> None:
    with instance.refuses(f"fmi2{function}: ", "null pointer"):
        check(call(instance, f"fmi2{function}", *arguments))
    assert ROOM.raw == bytes(500), "nothing was written"
