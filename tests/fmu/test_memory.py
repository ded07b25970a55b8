"""The native FMU's memory, by the functions of its host: tables come when they are first needed."""

import math

import pytest
from fmpy.fmi1 import FMICallException

from tests.fmu.host import HostMemory, Instance, Unpacked
from tests.fmus import native_fmu_only

pytestmark = native_fmu_only

SMALL = 40_000
"""What an instance may take until it uses a table, in bytes."""


@pytest.mark.parametrize("fidelity", [2, 1, 0])
def test_coulomb_friction_needs_little_memory(unpacked: Unpacked, fidelity: int) -> None:
    memory = HostMemory()
    instance = Instance(unpacked, memory=memory)
    instance.initialize(fidelity=fidelity, averaging_order=1)
    instance.step(0.01)
    assert 0 < memory.in_use <= SMALL
    instance.free()
    assert memory.in_use == 0


@pytest.mark.parametrize("fidelity", [2, 1, 0])
def test_tables_come_when_they_are_needed(unpacked: Unpacked, fidelity: int) -> None:
    """In memory that the host does not zero, they give the numbers of memory that it does."""
    choices = {"friction_law": 1, "fidelity": fidelity, "averaging_order": 1}
    memory = HostMemory()
    instance, other = Instance(unpacked, memory=memory), Instance(unpacked).initialize(**choices)
    instance.enter_initialization(**choices)
    assert 0 < memory.in_use <= SMALL
    instance.slave.exitInitializationMode()
    for each in (instance, other):
        each.step(0.01)
    assert instance.get("velocity") == other.get("velocity") != (0.0,)
    taken = memory.in_use
    instance.slave.reset()
    instance.initialize(**choices)
    assert memory.in_use == taken, "an instance keeps its tables"
    for each in (instance, other):
        each.free()
    assert memory.in_use == 0


@pytest.mark.parametrize("fidelity", [2, 0])
def test_without_memory_for_tables_a_call_is_refused(unpacked: Unpacked, fidelity: int) -> None:
    """It changes nothing: with memory the same call passes."""
    choices = {"friction_law": 1, "fidelity": fidelity, "averaging_order": 1}
    memory = HostMemory()
    instance, other = Instance(unpacked, memory=memory), Instance(unpacked).initialize(**choices)
    memory.limit = memory.in_use + 1000
    instance.enter_initialization(**choices)
    with pytest.raises(FMICallException):
        instance.slave.exitInitializationMode()
    assert instance.log == ["out of memory: the host gives none for tables of friction"]
    memory.limit = math.inf
    instance.slave.exitInitializationMode()
    for each in (instance, other):
        each.step(0.01)
    assert instance.get("velocity") == other.get("velocity")
    for each in (instance, other):
        each.free()
    assert memory.in_use == 0
