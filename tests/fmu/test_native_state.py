"""The serialised state of the native FMU: the same layout everywhere, and nothing else is taken."""

import ctypes
import math
import struct

import pytest

from tests.fmu.host import Instance, Unpacked
from tests.fmu.native_calls import ERROR, OK, call, check
from tests.fmu.native_layout import LAYOUT, SETTABLE, checksum, moment_of
from tests.fmus import native_fmu_only

pytestmark = native_fmu_only

STEP = 3.1e-4
NULL, ROOM = ctypes.c_void_p(), ctypes.create_string_buffer(500)


def test_the_layout_is_that_of_any_platform(instance: Instance, unpacked: Unpacked) -> None:
    instance.set(phase=0.4)
    instance.run(7, STEP)
    data = instance.state()
    magic, guid, *_, found = LAYOUT.unpack(data)
    assert magic == b"SLIDRES\x02", "the version of the layout is part of it"
    assert guid.rstrip(b"\0").decode() == unpacked.description.guid
    assert found == checksum(data[:-8])
    state = moment_of(data)
    assert state["time"] == instance.time
    assert state["stop_time"] == math.inf
    assert state["event_age"] >= 0.0
    for name in ("position", "velocity", "reversals", "last_event_time"):
        assert (state[name],) == instance.get(name), name
    for variable in SETTABLE:
        expected = 0.4 if variable.name == "phase" else variable.start
        assert state[variable.name] == expected, variable.name


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
