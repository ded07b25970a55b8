"""Answers of an FMU that belong to no run: what it is, whom it serves, and what it logs."""

import math
from collections.abc import Iterator
from contextlib import suppress
from ctypes import byref, c_char_p, c_double, c_int, c_uint
from typing import Any

from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import (
    FMU2Slave,
    fmi2CallbackFunctions,
    fmi2CallbackLoggerTYPE,
    fmi2CoSimulation,
    fmi2DoStepStatus,
    fmi2ModelExchange,
    fmi2OK,
    fmi2PendingStatus,
    fmi2Warning,
)

from slider_resonator.checks.conduct.event_mode import event_mode_faults
from slider_resonator.checks.conduct.findings import accepted, answer_of, is_refused
from slider_resonator.checks.conduct.process import (
    crowd_faults,
    instance_leaks,
    process_faults,
    step_leaks,
)
from slider_resonator.checks.fmu_side import FmuSide
from slider_resonator.errors import NotApplicable
from slider_resonator.fmu import fmu_log
from slider_resonator.fmu.instance import Instance

STATUSES = [f"logStatus{name}" for name in ("OK", "Warning", "Discard", "Error", "Fatal")]
"""Log categories, each for messages of a status."""
WARNINGS, EVERYTHING = "logStatusWarning", "logAll"
"""Log categories: one to which no refusal belongs, and that of all messages."""

STEP = 1.1e-3
"""Size of a step (s), after which no output is 0."""


def host_faults(fmu: FmuSide) -> Iterator[str]:
    """Ask for the version, try instances that must not be made, and switch logging off and on.

    One of FMI 3.0 is asked about its event mode, where it has one.
    An FMU that runs in Python is not tried with bad instances: pythonfmu checks none of them.
    """
    instance = fmu.instance
    slave, is_native = instance.slave, instance.fmu.runs_without_python
    if not isinstance(slave, FMU2Slave):
        if not instance.fmu.offers.hasEventMode:
            raise NotApplicable("needs FMI 2.0, whose calls are tried, or hasEventMode = true")
        yield from accepted(instance, "a run with event mode", event_mode_faults(instance))
        yield from process_faults(instance)
        yield from step_leaks(instance)
        return
    for name, needed in (("fmi2GetVersion", "2.0"), ("fmi2GetTypesPlatform", "default")):
        found = (getattr(slave, name)() or b"").decode("utf-8", "replace")
        if found != needed:
            yield f"{name} returns {found!r}, must be {needed!r}"
    if is_native:
        yield from _instance_faults(instance, slave)
    instance.start({})
    instance.step_by(STEP)
    yield from accepted(instance, "switching logging", _switching_faults(instance))
    if is_native:
        yield from _other_host_faults(instance, slave)
    yield from _number_faults(instance)
    yield from _offer_faults(instance, slave)
    instance.terminate()
    if is_native:
        slave.dll.fmi2FreeInstance(None)  # which is no error, and must not crash
        yield from crowd_faults(instance)
        yield from process_faults(instance)
    yield from step_leaks(instance)
    yield from instance_leaks(instance)


def _instance_faults(instance: Instance, slave: FMU2Slave) -> Iterator[str]:
    """Try to make instances that FMI 2.0 forbids, each with one argument wrong, and unusual ones.

    An FMU with log categories must say why it refuses them; FMI 2.0 does not ask that of others.
    All that are made are freed in initialization mode.
    """
    folder, guid = (instance.fmu.folder / "resources").as_uri(), instance.fmu.description.guid

    def made(name: str = "other", **arguments: Any) -> tuple[bool, list[str]]:
        """Make an instance and free it; return whether there was one, and the log."""
        messages, callbacks = fmu_log.collect(name)
        component = _instantiated(instance, callbacks, name=name, **arguments)
        if component:
            slave.dll.fmi2DoStep(component, 0.0, -1.0, True)  # which is refused with a message
            slave.dll.fmi2SetupExperiment(component, False, 0.0, 0.0, False, 0.0)
            slave.dll.fmi2EnterInitializationMode(component)
            slave.dll.fmi2FreeInstance(component)
        fmu_log.forget(name)
        return bool(component), messages

    last = "1" if guid[-2] == "0" else "0"
    wrong: dict[str, dict[str, Any]] = {
        "of another GUID": {"guid": guid[:-2] + last + guid[-1]},
        "without a name": {"name": ""},
    }
    if instance.fmu.description.modelExchange is None:
        wrong["for model exchange"] = {"kind": fmi2ModelExchange}
    for what, argument in wrong.items():
        is_made, messages = made(**argument)
        if is_made:
            yield f"an instance {what} is made"
        elif instance.fmu.log_categories and not messages:
            yield f"an instance {what} is refused without a message"
    # Some hosts show instances, and write the authority of a URI or leave it out.
    unusual: list[dict[str, Any]] = [
        {"visible": True},
        {"location": folder.replace("file:///", "file:/")},
        {"location": f"{folder}/"},
        {"location": folder.replace("unpacked", "un%20packed")},
        *({"name": name} for name in ("x" * 300, "größer", "100%d %s %n")),
    ]
    for argument in unusual:
        is_made, _ = made(**argument)
        if not (is_made or instance.fmu.offers.canBeInstantiatedOnlyOncePerProcess):
            yield f"an instance with {argument} is not made"


def _instantiated(instance: Instance, callbacks: fmi2CallbackFunctions, **changed: Any) -> Any:
    """Make another instance, as hosts make it but for the arguments that are changed."""
    usual = {
        "name": "other",
        "kind": fmi2CoSimulation,
        "guid": instance.fmu.description.guid,
        "location": (instance.fmu.folder / "resources").as_uri(),
        "callbacks": byref(callbacks),
        "visible": False,
        "logs": True,
    }
    arguments = {**usual, **changed}.values()  # in the order of fmi2Instantiate
    encoded = (one.encode() if isinstance(one, str) else one for one in arguments)
    return instance.slave.dll.fmi2Instantiate(*encoded)


def _switching_faults(instance: Instance) -> Iterator[str]:
    """Step with logging off; make a call that is refused with it on, and on for other messages."""
    instance.call("fmi2SetDebugLogging", False, 0, None)
    del instance.messages[:]
    instance.step_by(STEP)
    if instance.messages:
        yield "a step is logged after logging is switched off"
    categories = instance.fmu.log_categories
    if WARNINGS in categories and _refusal_is_logged(instance, WARNINGS):
        yield "a refusal is logged though only warnings were asked for"
    # pythonfmu logs a refusal without a category.
    categorised = EVERYTHING in categories and instance.fmu.runs_without_python
    if categorised and not _refusal_is_logged(instance, EVERYTHING):
        yield "a refusal is not logged though all messages were asked for"
    if not _refusal_is_logged(instance):
        yield "a refusal is not logged after logging is switched on"
    # An unknown category whose name looks like a format, which a logger must get as a text.
    del instance.messages[:]
    is_refused(instance.slave.setDebugLogging, True, ["logs of %d"])
    for message in instance.messages:
        if "logs of " in message and "logs of %d" not in message:
            yield f"a message takes %d for a format: {message}"


def _refusal_is_logged(instance: Instance, *categories: str) -> bool:
    """Switch logging on for some categories, all without any, and make a call that is refused."""
    if categories:
        instance.slave.setDebugLogging(True, categories)
    else:
        instance.call("fmi2SetDebugLogging", True, 0, None)
    del instance.messages[:]
    is_refused(instance.set, {"load": math.nan})
    return bool(instance.messages)


def _other_host_faults(instance: Instance, slave: FMU2Slave) -> Iterator[str]:
    """Create an instance for another host, to which alone its refusals may be reported."""
    if instance.fmu.offers.canBeInstantiatedOnlyOncePerProcess:
        return
    name, host = "an instance beside another one", 7
    declared = instance.fmu.log_categories
    environments: list[int | None] = []
    wrong: list[str] = []

    def listen(
        environment: int | None, given: bytes, status: int, category: bytes, *_: object
    ) -> None:
        environments.append(environment)
        called = (category or b"").decode("utf-8", "replace")
        due = dict(enumerate(STATUSES)).get(status)
        if given != name.encode():
            wrong.append("with the name of another instance")
        if status <= fmi2Warning:
            wrong.append("as a success")
        if called != due and (called in STATUSES or due in declared):
            wrong.append("in another category than that of its status")
        if EVERYTHING in declared and called not in declared:
            wrong.append("in a category that is not declared")

    messages, callbacks = fmu_log.collect(name)
    callbacks.logger = fmi2CallbackLoggerTYPE(listen)
    callbacks.componentEnvironment = host  # an FMU must only hand it back
    made, again = (_instantiated(instance, callbacks, name=name, logs=False) for _ in range(2))
    if not (made and again):
        yield "an instance beside another, or a further one of the same name, is not made"
        return
    slave.dll.fmi2FreeInstance(again)
    del instance.messages[:]
    slave.dll.fmi2SetupExperiment(made, False, 0.0, 0.0, False, 0.0)
    slave.dll.fmi2EnterInitializationMode(made)
    slave.dll.fmi2ExitInitializationMode(made)
    slave.dll.fmi2DoStep(made, 0.0, STEP, True)
    if environments:
        yield "good calls are logged without debug logging"
    slave.dll.fmi2DoStep(made, STEP, -1.0, True)
    slave.dll.fmi2FreeInstance(made)
    fmu_log.forget(name)
    if messages or instance.messages or set(environments) - {host}:
        yield "an instance beside another reports to the host of that one"
    yield from (f"a refusal is logged {how}" for how in dict.fromkeys(wrong))


def _number_faults(instance: Instance) -> Iterator[str]:
    """Read nothing, one variable twice, and so often that it may be refused, but must not crash."""
    if is_refused(instance.call, "fmi2GetReal", None, 0, None):
        yield "a call for no values at all is refused"
    reference, load = map(instance.fmu.reference, ("normal_force", "load"))
    expected = instance.value("normal_force")
    twice = list(instance.slave.getReal([reference, load, reference]))
    nowhere = byref(c_uint(reference)), 1, None
    if instance.fmu.runs_without_python and not is_refused(instance.call, "fmi2GetReal", *nowhere):
        yield "a null pointer is accepted as the place of a value"
    if twice != [expected, instance.value("load"), expected]:
        yield "normal_force read twice in a call is not the same"
    many = 4096  # far more than there are variables
    references, found = (c_uint * many)(*[reference] * many), (c_double * many)()
    with suppress(FMICallException):
        instance.call("fmi2GetReal", references, many, found)
        if set(found) != {expected}:
            yield f"normal_force read {many} times in a call is not {expected!r} each time"


def _offer_faults(instance: Instance, slave: FMU2Slave) -> Iterator[str]:
    """Ask for what is offered and for what is lacking, and about a step that was refused."""
    yield from derivative_offer_faults(instance)
    pending = is_refused(instance.call, "fmi2GetStringStatus", fmi2PendingStatus, byref(c_char_p()))
    number = is_refused(instance.call, "fmi2GetIntegerStatus", fmi2DoStepStatus, byref(c_int()))
    other = is_refused(instance.call, "fmi2GetStatus", fmi2PendingStatus, byref(c_int()))
    if not (pending and number and other):
        yield "a status is given of a step that is not pending"
    is_refused(instance.call, "fmi2DoStep", instance.time, -1.0, True)
    if answer_of(slave.getStatus, fmi2DoStepStatus) == fmi2OK:
        yield "fmi2GetStatus calls a refused step a success"
    if not is_refused(slave.cancelStep):
        yield "fmi2CancelStep is accepted though no step is pending"


def derivative_offer_faults(instance: Instance) -> Iterator[str]:
    """Ask for each kind of derivative that the description offers, and for those it does not."""
    offers, slave = instance.fmu.offers, instance.slave
    position, velocity, load = map(instance.fmu.reference, ("position", "velocity", "load"))
    derivatives, order = slave.getRealOutputDerivatives, offers.maxOutputDerivativeOrder or 0
    if order > 0 and is_refused(derivatives, [position], [order]):
        yield f"maxOutputDerivativeOrder is {order}, but position has no such derivative"
    for what, reference, wrong in (
        (f"order {order + 1}", position, order + 1),
        ("order 0", position, 0),
        ("an input", load, 1),
    ):
        if not is_refused(derivatives, [reference], [wrong]):
            yield f"an output derivative of {what} is given"
    if order > 0:
        both = derivatives([position, velocity], [1, 1])
        if both != [*derivatives([position], [1]), *derivatives([velocity], [1])]:
            yield "derivatives of outputs are others together than one by one"
    refused = is_refused(slave.getDirectionalDerivative, [position], [load], [1.0])
    if refused and offers.providesDirectionalDerivative:
        yield "providesDirectionalDerivative is true, but that of position by load is refused"
    if not (refused or offers.providesDirectionalDerivative):
        yield "fmi2GetDirectionalDerivative is accepted though there are none"
