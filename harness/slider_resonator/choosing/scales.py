"""The scales that determine the error of cheaper models, from device and inputs alone."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from itertools import pairwise
from math import inf, pi, sqrt

from slider_resonator.choosing.candidate import LUGRE
from slider_resonator.device.device import Device
from slider_resonator.device.signal import Signal
from slider_resonator.errors import SceneError
from slider_resonator.references.closed_forms import equivalent_force
from slider_resonator.scenes.scene import Scene

LONG_MEMORY = 100.0
"""Drive periods beyond which memory does not indicate the distance from resonance."""
BREAKS_LOOSE = 0.3
"""Friction over vibration below which the slider slides nearly all the time."""
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
    `lifts` says whether the contact ever lifts off. `bristle_turns` are the oscillations of the
    slider on its bristle in a drive period, 0 where the vibration breaks the contact loose.
    `ratio` is the starting frequency ratio, `damping` the damping ratio of the resonator beside a
    slider that slides.
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
    lifts: bool
    bristle_turns: float
    ratio: float
    damping: float

    @property
    def has_slow_motion(self) -> bool:
        """Whether the slow motion is slower than the resonator forgets, and slow in a period.

        Else averages of second order leap over nothing.
        """
        decay = 1.0 / self.memory if self.memory else inf
        return self.slowness is not None and 0.0 < 4.0 * self.slowness < min(1.0, decay)

    @property
    def bristle_share(self) -> float:
        """Share of the time in which LuGre friction is not Coulomb's, of the order of kappa^(-1/2).

        After a reversal the bristle bends over the path mu/bristle_stiffness, which takes a time as
        the root of it.
        """
        return min(1.0, self.kappa**-0.5) if self.kappa else 1.0

    @property
    def averaging_error(self) -> float | None:
        """Error (m/s) to expect of the averaged slow velocity: friction over drive, and over the
        resonator that it disturbs, by as much as that is in resonance.
        """
        if self.slowness is None or self.fast_velocity is None:
            return None
        disturbed = 1.0 + self.mass_ratio * pi * min(self.memory, LONG_MEMORY)
        return self.slowness * self.fast_velocity * disturbed


def longest_memory(scales: Scales, law: int) -> float:
    """Return the drive periods that the resonator remembers, or a bristle of LuGre friction."""
    bristle = 0.25 / scales.kappa if law == LUGRE and scales.kappa else 0.0
    return max(scales.memory, bristle)


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
    period = 2.0 * pi / device.drive_frequency
    friction = device.friction_faces * device.friction_coefficient * device.normal_preload
    ratio = scene.signals["frequency_ratio"].at(0.0)
    detuning = abs(ratio - round(ratio))
    fast = _fast_velocity(device)
    damping = device.damping_ratio * device.resonator_frequency / (1.0 - device.mass_ratio)
    load = max(map(abs, scene.signals["load"].values))
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
        input_rate=_input_rate(scene, period, friction),
        lifts=_highest(scene, "normal_amplitude") > _lowest(scene, "normal_preload"),
        bristle_turns=_bristle_turns(device, slowness),
        ratio=ratio,
        damping=device.damping_ratio / sqrt(1.0 - device.mass_ratio),
    )


def _highest(scene: Scene, name: str) -> float:
    return max(scene.tuning[name].values if name in scene.tuning else [getattr(scene.device, name)])


def _lowest(scene: Scene, name: str) -> float:
    return min(scene.tuning[name].values if name in scene.tuning else [getattr(scene.device, name)])


def _fast_velocity(device: Device) -> float | None:
    try:
        return equivalent_force(device).velocity_amplitude or None
    except ValueError:  # no friction, or an undamped resonator at resonance
        return None


def _bristle_turns(device: Device, slowness: float | None) -> float:
    if slowness is not None and slowness < BREAKS_LOOSE:
        return 0.0
    stiffness = device.friction_faces * device.normal_preload * device.bristle_stiffness
    return sqrt(stiffness / device.total_mass) / device.drive_frequency


def _input_rate(scene: Scene, period: float, friction: float) -> float:
    sizes = {"phase": 1.0, "load": friction or 1.0, "frequency_ratio": 1.0}
    return max(_steepest(scene.signals[name]) * period / size for name, size in sizes.items())


def _steepest(signal: Signal) -> float:
    """Return the largest rate (1/s) of a polyline, 0 for one that is held."""
    if signal.hold:
        return 0.0
    points = list(zip(signal.times, signal.values, strict=True))
    return max((abs((v1 - v0) / (t1 - t0)) for (t0, v0), (t1, v1) in pairwise(points)), default=0.0)
