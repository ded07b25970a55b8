"""States of an FMU in the hands of a host: got again, freed, and damaged on their way."""

from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from ctypes import byref, c_char, c_void_p, create_string_buffer
from functools import partial
from itertools import product
from uuid import UUID

from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Slave

from slider_resonator.checks.conduct.findings import (
    is_refused,
    other_value,
    outputs_after,
    unequal,
    values_to_vary,
)
from slider_resonator.checks.conduct.output_derivatives import status_faults
from slider_resonator.checks.conduct.process import state_leaks
from slider_resonator.checks.fmu_side import FmuSide
from slider_resonator.errors import FmuError
from slider_resonator.fmu.instance import Instance, SavedState
from slider_resonator.fmu.isolation.process import TIME_LIMIT, IsolatedFmu

STEP = 1.3e-3
"""Size of a step, s."""
STATES, MANY = 12, 300
"""How many states a host goes back to, and how many it keeps at a time."""
DAMAGED = 24
"""Places in a serialised state at which a bit is turned."""


def state_faults(fmu: FmuSide) -> Iterator[str]:
    """Get a state into the place of another, damage serialised ones, and free them."""
    instance = fmu.instance
    instance.fmu.require("canGetAndSetFMUstate")
    instance.start(fmu.scene.parameters)
    instance.step_by(STEP)
    yield from _pointer_faults(instance)
    if instance.fmu.offers.canSerializeFMUstate:
        yield from _damage_faults(instance)
        yield from _process_faults(instance)
    yield from _later_faults(instance, fmu.scene.parameters)
    yield from state_leaks(instance)
    yield from _early_faults(instance, fmu.scene.parameters)
    instance.terminate()


def _pointer_faults(instance: Instance) -> Iterator[str]:
    """Get the state twice into one place, the second time after a step, and free it.

    The pointer must then be null, but pythonfmu leaves it as it is. To free a null pointer is no
    error.
    """
    call, is_native = instance.call, instance.fmu.runs_without_python
    state = c_void_p()
    call("fmi2GetFMUstate", byref(state))
    instance.step_by(STEP)
    call("fmi2GetFMUstate", byref(state))
    kept, time = instance.outputs(), instance.time
    instance.step_by(STEP)
    call("fmi2SetFMUstate", state)
    instance.time = time
    if instance.outputs() != kept:
        yield "a state that is got into the place of another is still the old one"
    call("fmi2FreeFMUstate", byref(state))
    if state.value and is_native:
        yield "the pointer to a state that is freed is not null"
    state.value = None
    if is_native and not is_refused(call, "fmi2SetFMUstate", state):
        yield "a null pointer is accepted as a state"
    if is_refused(call, "fmi2FreeFMUstate", byref(state)):
        yield "freeing a null pointer is refused"


def _damage_faults(instance: Instance) -> Iterator[str]:
    """Read back states with a bit turned, the end cut off or those of another FMU.

    They must be refused. Turned bits may also be of no account: the state is then the one that was
    written, and not the present one.
    """
    slave = instance.slave
    with SavedState.of(instance) as saved:
        content = saved.serialised()
    instance.step_by(STEP)
    before = instance.outputs()
    slave.freeFMUstate(slave.deSerializeFMUstate(content))
    if instance.outputs() != before:
        yield "a serialised state that is read is set at once"
    size = len(content)
    damaged = {f"cut off after {n} bytes": content[:n] for n in (0, size // 2, size - 8, size - 1)}
    for number in range(DAMAGED):
        place, bit = (2 * number + 1) * size // (2 * DAMAGED), number % 8
        changed = bytearray(content)
        changed[place] ^= 1 << bit
        damaged[f"with bit {bit} of byte {place} turned"] = bytes(changed)
    damaged["of zeros"] = bytes(size)
    damaged["with something after it"] = content + bytes(8)
    guid, other = instance.fmu.description.guid.strip("{}"), str(UUID(int=0))
    foreign = content.replace(guid.encode(), other.encode())
    damaged["of another FMU"] = foreign if foreign != content else content[::-1]
    with SavedState.of(instance) as present:
        if isinstance(slave, FMU2Slave) and instance.fmu.runs_without_python:
            behind = b"\xff" * 8
            target = create_string_buffer(content + behind)
            instance.call("fmi2SerializeFMUstate", present.handle, target, size)
            if not target.raw[size:].startswith(behind):
                yield "a state is serialised beyond its size"
            few = (c_char * (size - 1))()
            arguments = present.handle, few, size - 1
            if not is_refused(instance.call, "fmi2SerializeFMUstate", *arguments):
                yield "a state is serialised into too few bytes"
        for what, bad in damaged.items():
            with suppress(FMICallException):
                instance.resume(bad, instance.time)
                with SavedState.of(instance) as again:
                    if again.serialised() != content:
                        yield f"a serialised state {what} is accepted"
            present.restore()
        if instance.outputs() != before:
            yield "a damaged state that is refused changes outputs"


def _process_faults(instance: Instance) -> Iterator[str]:
    """Take over a serialised state in another process, as a run that goes on after a restart.

    What the state refers to is not there, such as the instance that it was saved of.
    """
    instance.start({"load": 0.02})
    instance.step_by(STEP)
    with SavedState.of(instance) as state:
        content = state.serialised()
    expected = outputs_after(instance, STEP)
    try:
        isolated = IsolatedFmu(instance.fmu.file, TIME_LIMIT)
    except (FmuError, OSError):  # there may be one instance, or no other process
        return
    try:
        with isolated:
            found = isolated.run(partial(_outputs_after, content=content))
    except FmuError as error:
        yield f"a serialised state is not taken over in another process: {error}"
        return
    if found != expected:
        yield "a serialised state is another one in another process"


def _outputs_after(instance: Instance, content: bytes) -> dict[str, float]:
    """Return all outputs a step after a serialised state, which takes the place of a run."""
    instance.start({})
    with instance.explained():
        instance.resume(content, STEP)
        return outputs_after(instance, STEP)


def _later_faults(instance: Instance, parameters: Mapping[str, float]) -> Iterator[str]:
    """Save some states, and go back to each: in a run, after its end and after a reset."""
    instance.start(parameters)
    states, rows = [], []
    for _ in range(STATES):
        rows.append(outputs_after(instance, STEP))
        states.append(SavedState.of(instance))
    for state in [SavedState.of(instance) for _ in range(MANY)]:
        state.free()
    other = {"resonator_mass": 0.2, "damping_ratio": 0.1, "friction_faces": 1.0}
    ways: dict[str, Callable[[], object]] = {
        "in a run": lambda: None,
        "after the end of a run": instance.terminate,
        "after a reset": lambda: instance.call("fmi2Reset"),
        "in initialization mode": lambda: instance.initialise({}),
        "in a run of another device": lambda: instance.start(other),
    }
    for when, leave in ways.items():
        leave()
        for state, expected in zip(reversed(states), reversed(rows), strict=True):
            try:
                state.restore()
            except FMICallException as error:
                yield f"a state is refused {when}: {error}"
                break
            if instance.outputs() != expected:
                yield f"a state is another one {when}"
            if instance.fmu.runs_without_python:  # pythonfmu keeps the time of the last step
                yield from status_faults(instance)
        instance.start(parameters)
        instance.step_by(STEP)
    instance.terminate()
    if is_refused(lambda: SavedState.of(instance).free()):
        yield "no state is given after the end of a run"
    instance.start(parameters)
    instance.step_by(STEP)
    for state in states:
        state.free()


def _early_faults(instance: Instance, parameters: Mapping[str, float]) -> Iterator[str]:
    """Save the state before or in initialization, go on with other values, and go back.

    The state goes back as it is and, where the FMU offers that, in serialised form.
    """
    instance.start(parameters)
    values, expected = instance.read(values_to_vary(instance)), outputs_after(instance, STEP)
    ways: list[Callable[[SavedState], None]] = [SavedState.restore]
    if instance.fmu.offers.canSerializeFMUstate:
        ways.append(lambda state: state.transfer(instance))
    for when, go_back in product(("before", "in"), ways):
        instance.set_up()
        instance.set(parameters)
        if when == "in":
            instance.call("fmi2EnterInitializationMode")
        with SavedState.of(instance) as state:
            instance.set({name: other_value(name, value) for name, value in values.items()})
            if when == "before":
                instance.call("fmi2EnterInitializationMode")
            else:
                instance.begin()
            instance.outputs()
            try:
                go_back(state)
                if when == "before":
                    instance.call("fmi2EnterInitializationMode")
                yield from unequal(instance, values, f"after a state saved {when} initialization")
                instance.begin()
                instance.step_by(STEP)
            except FMICallException as error:
                yield f"a run cannot go on from a state saved {when} initialization: {error}"
                return
        if instance.outputs() != expected:
            yield f"a state saved {when} initialization keeps the values set after it"
