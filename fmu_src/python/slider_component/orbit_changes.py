"""What has changed since the last step of averaged motion of second order."""

from __future__ import annotations

from typing import NamedTuple

from .device import Device, Inputs
from .fast_vibration import FastVibration
from .orbit_ride import orbit_phase_of
from .orbit_state import MAX_TUNINGS, OrbitState, OrbitValues, PaidTables, Stage
from .slow_motion_error import first_order_error


class OrbitChanges(NamedTuple):
    """What is other than in the last step.

    `shaken` is the vibration: by another drive, or by a step with first-order averages. `tuned` is
    the contact, `led` the lead of the normal load, `loaded` the load and `turned` the frequency
    ratio.
    """

    shaken: bool
    tuned: bool
    led: bool
    loaded: bool
    turned: bool


def orbit_values(device: Device, inputs: Inputs) -> OrbitValues:
    """What a held orbit depends on, at present."""
    return OrbitValues(
        phase=inputs.phase,
        load=inputs.load,
        ratio=inputs.frequency_ratio,
        waves=orbit_phase_of(device, inputs.frequency_ratio).waves,
        preload=device.normal_preload,
        amplitude=device.normal_amplitude,
        coefficient=device.friction_coefficient,
        base=device.base_amplitude,
        frequency=device.drive_frequency,
        force=device.tangential_force,
    )


def noted(
    device: Device, inputs: Inputs, fast: FastVibration, orbit: OrbitState
) -> tuple[OrbitState, OrbitChanges]:
    """The state with present values in place of those of the last step, and what has changed."""
    before, present = orbit.under, orbit_values(device, inputs)
    drive_before = before.base, before.frequency, before.force
    driven = drive_before != (present.base, present.frequency, present.force)
    contact_before = before.preload, before.amplitude, before.coefficient
    changes = OrbitChanges(
        shaken=driven or orbit.stage == Stage.AVERAGED,
        tuned=contact_before != (present.preload, present.amplitude, present.coefficient),
        led=(before.phase, before.waves) != (present.phase, present.waves),
        loaded=present.load != before.load,
        turned=before.ratio != present.ratio,
    )
    tunings = orbit.tunings
    if changes.shaken or changes.tuned:
        tunings = min(tunings + 1, MAX_TUNINGS)
    paid = PaidTables() if driven or changes.tuned else orbit.paid
    doubt = first_order_error(device, fast) if orbit.stage == Stage.AVERAGED else orbit.doubt
    return orbit._replace(under=present, tunings=tunings, paid=paid, doubt=doubt), changes
