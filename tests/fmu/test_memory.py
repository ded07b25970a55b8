"""The native FMU's memory, by the functions of its host: tables come when they are first needed."""

import ctypes
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field

import pytest
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import (
    FMU2Slave,
    fmi2CallbackAllocateMemoryTYPE,
    fmi2CallbackFreeMemoryTYPE,
    fmi2CallbackFunctions,
    fmi2CallbackLoggerTYPE,
)

from tests.fmu.host import Unpacked
from tests.fmus import native_fmu_only

pytestmark = native_fmu_only

SMALL = 40_000
"""What an instance may take until it uses a table, in bytes."""


@dataclass
class Memory:
    """The memory of a host: blocks by address, which are not zeroed, up to `limit` bytes."""

    limit: float = float("inf")
    blocks: dict[int, ctypes.Array[ctypes.c_char]] = field(default_factory=dict)
    log: list[str] = field(default_factory=list)

    @property
    def in_use(self) -> int:
        return sum(map(len, self.blocks.values()))

    def allocate(self, count: int, size: int) -> int | None:
        if self.in_use + count * size > self.limit:
            return None
        block = ctypes.create_string_buffer(b"\xa5" * (count * size), count * size)
        address = ctypes.addressof(block)
        self.blocks[address] = block
        return address

    def release(self, address: int) -> None:
        del self.blocks[address]

    def receive(self, _: object, name: bytes, status: int, category: bytes, text: bytes) -> None:
        self.log.append(text.decode())


@contextmanager
def instance_in(memory: Memory, unpacked: Unpacked) -> Iterator[FMU2Slave]:
    slave = FMU2Slave(
        guid=unpacked.description.guid,
        modelIdentifier=unpacked.description.coSimulation.modelIdentifier,
        unzipDirectory=str(unpacked.folder),
        instanceName="slider",
    )
    callbacks = fmi2CallbackFunctions(
        logger=fmi2CallbackLoggerTYPE(memory.receive),
        allocateMemory=fmi2CallbackAllocateMemoryTYPE(memory.allocate),
        freeMemory=fmi2CallbackFreeMemoryTYPE(memory.release),
    )
    slave.instantiate(callbacks=callbacks)
    try:
        yield slave
    finally:
        slave.freeInstance()


def choose(slave: FMU2Slave, unpacked: Unpacked, **choices: int) -> None:
    variables = {v.name: v.valueReference for v in unpacked.description.modelVariables}
    slave.setupExperiment()
    slave.enterInitializationMode()
    slave.setInteger([variables[name] for name in choices], list(choices.values()))


def velocity_after(slave: FMU2Slave, unpacked: Unpacked, duration: float) -> float:
    slave.doStep(currentCommunicationPoint=0.0, communicationStepSize=duration)
    (reference,) = (
        v.valueReference for v in unpacked.description.modelVariables if v.name == "velocity"
    )
    (velocity,) = slave.getReal([reference])
    return float(velocity)


@pytest.mark.parametrize("fidelity", [2, 1, 0])
def test_coulomb_friction_needs_little_memory(unpacked: Unpacked, fidelity: int) -> None:
    memory = Memory()
    with instance_in(memory, unpacked) as slave:
        choose(slave, unpacked, fidelity=fidelity, averaging_order=1)
        slave.exitInitializationMode()
        velocity_after(slave, unpacked, 0.01)
        assert 0 < memory.in_use <= SMALL
    assert memory.in_use == 0


@pytest.mark.parametrize("fidelity", [2, 1, 0])
def test_tables_come_when_they_are_needed(unpacked: Unpacked, fidelity: int) -> None:
    """In memory that the host does not zero, they give the numbers of memory that it does."""
    velocities = []
    for _ in range(2):
        memory = Memory()
        with instance_in(memory, unpacked) as slave:
            choose(slave, unpacked, friction_law=1, fidelity=fidelity, averaging_order=1)
            assert 0 < memory.in_use <= SMALL
            slave.exitInitializationMode()
            velocities.append(velocity_after(slave, unpacked, 0.01))
            taken = memory.in_use
            slave.reset()
            choose(slave, unpacked, friction_law=1, fidelity=fidelity, averaging_order=1)
            slave.exitInitializationMode()
            assert memory.in_use == taken, "an instance keeps its tables"
        assert memory.in_use == 0
    assert velocities[0] == velocities[1] != 0.0


@pytest.mark.parametrize("fidelity", [2, 0])
def test_without_memory_for_tables_a_call_is_refused(unpacked: Unpacked, fidelity: int) -> None:
    """It changes nothing: with memory the same call passes."""
    memory, enough = Memory(limit=SMALL), Memory()
    choices = {"friction_law": 1, "fidelity": fidelity, "averaging_order": 1}
    with instance_in(memory, unpacked) as slave, instance_in(enough, unpacked) as other:
        memory.limit = memory.in_use + 1000
        choose(slave, unpacked, **choices)
        with pytest.raises(FMICallException):
            slave.exitInitializationMode()
        assert memory.log == ["out of memory: the host gives none for tables of friction"]
        memory.limit = float("inf")
        slave.exitInitializationMode()
        choose(other, unpacked, **choices)
        other.exitInitializationMode()
        assert velocity_after(slave, unpacked, 0.01) == velocity_after(other, unpacked, 0.01)
    assert memory.in_use == enough.in_use == 0
