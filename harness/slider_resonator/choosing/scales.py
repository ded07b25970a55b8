"""The scales that determine the error of cheaper models, from device and inputs alone."""

from dataclasses import asdict, dataclass
from math import inf, pi

import numpy as np

from slider_resonator.checks.natural_scale import fast_velocity
from slider_resonator.errors import SceneError
from slider_resonator.scenes.scene import Scene

NEAR_AN_INTEGER = 0.1
"""Distance of the frequency ratio from an integer within which the phase turns slowly."""


@dataclass(frozen=True)
class Scales:
    """Scales of a scene; those of vibration are None without vibration or friction.

    `period` (s) is the drive's and `fast_velocity` (m/s) is v_q = F_T*/((M+m) w). `slowness` is the
    velocity that friction takes away in a radian of the drive over v_q, the 1/Omega in which
    averaging errs. `relaxation` (s) is the time in which the slow velocity settles and `memory`
    (drive periods) that of the resonator. `kappa` = bristle_stiffness v_q/(mu w) is the path of the
    vibration over that of the bristle, `mass_ratio` is r_m. `detuning` is the distance of the
    starting frequency ratio from an integer, `beat` (Hz) the difference frequency where that is
    small, else 0. `saturation` is the greatest load over the mean friction. `input_rate` is the
    largest change of an input in a drive period, in rad, mean frictions, or drive frequencies.
    """

    period: float
    fast_velocity: float | None
    slowness: float | None
    relaxation: float
    memory: float
    kappa: float | None
    mass_ratio: float
    detuning: float
    beat: float
    saturation: float
    input_rate: float


MAX_MAGNITUDE = 1e50
"""Largest magnitude of a parameter or input, in SI units: products of six are finite."""


def check_magnitudes(scene: Scene) -> None:
    """Raise SceneError naming a parameter or input too large for the scales to be finite."""
    values = {name: float(value) for name, value in asdict(scene.device).items()}
    values |= {
        name: max(map(abs, signal.values))
        for name, signal in (*scene.signals.items(), *scene.tuning.items())
    }
    for name, value in values.items():
        if not abs(value) <= MAX_MAGNITUDE:
            raise SceneError(
                f"{scene.source}: {name} = {value!r}: must be at most {MAX_MAGNITUDE:g} to choose "
                "a model"
            )


def scales_of(scene: Scene) -> Scales:
    """Return the scales of a scene, inputs and tuned parameters as they start."""
    device = scene.device
    period = scene.drive_period
    friction = device.mean_friction
    ratio = scene.signals["frequency_ratio"].at(0.0)
    detuning = abs(ratio - round(ratio))
    fast = (fast_velocity(device) or None) if friction > 0.0 else None
    damping = device.damping_ratio * device.resonator_frequency / (1.0 - device.mass_ratio)
    load = max(map(abs, scene.signals["load"].values))
    sizes = {"phase": 1.0, "load": friction or 1.0, "frequency_ratio": 1.0}
    rates = [0.0]
    for name, size in sizes.items():
        signal = scene.signals[name]
        if not signal.hold and len(signal.times) > 1:
            steepest = np.abs(np.diff(signal.values) / np.diff(signal.times)).max()
            rates.append(float(steepest) * period / size)
    slowness = kappa = None
    relaxation = inf
    if fast:
        slowness = friction / (device.total_mass * device.drive_frequency * fast)
        relaxation = pi * fast * device.total_mass / (2.0 * friction)
        kappa = device.bristle_stiffness * fast / device.friction_coefficient
        kappa /= device.drive_frequency
    return Scales(
        period=period,
        fast_velocity=fast,
        slowness=slowness,
        relaxation=relaxation,
        memory=1.0 / (damping * period) if damping > 0.0 else inf,
        kappa=kappa,
        mass_ratio=device.mass_ratio,
        detuning=detuning,
        beat=detuning / period if detuning < NEAR_AN_INTEGER else 0.0,
        saturation=load / friction if friction > 0.0 else inf if load else 0.0,
        input_rate=max(rates),
    )
