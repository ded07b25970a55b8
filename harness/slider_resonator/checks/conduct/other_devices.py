"""A run after runs of other devices on the same instance: nothing of them may be left."""

from __future__ import annotations

from slider_resonator.checks.conduct.findings import NOTHING, Findings, differences
from slider_resonator.checks.conduct.other_values import other_value
from slider_resonator.checks.conduct.replays import plain_rows
from slider_resonator.checks.fmu_side import FmuSide
from slider_resonator.device.interface import PARAMETERS, VARIABLES
from slider_resonator.errors import Refusal


def other_device_differences(fmu: FmuSide) -> Findings:
    """Compare a run with those after runs of devices that differ in one parameter each.

    Each of them is the first on its instance. A device that the FMU refuses is left out.
    """
    instance, schedule, given = fmu.instance, fmu.scene.schedule(), fmu.scene.parameters
    renews = not instance.fmu.description.coSimulation.canBeInstantiatedOnlyOncePerProcess
    if renews:
        instance.recreate()
    plain = plain_rows(instance, given, schedule)
    found = NOTHING
    for name in PARAMETERS:
        if name not in instance.fmu.variables or name in schedule.tuning:
            continue
        value = given.get(name, VARIABLES[name].start or 0.0)
        if renews:
            instance.recreate()  # for the other device to be the first one that is prepared
        try:
            plain_rows(instance, {**given, name: other_value(name, value)}, schedule)
        except Refusal:
            continue
        rows = plain_rows(instance, given, schedule)
        what = f"after a device of another {name}"
        found += differences(what, instance.fmu.outputs, schedule.readings(), rows, plain)
    return found
