"""The axes: what is taken to its extremes around table 1, as tables of values."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from math import nextafter, pi, sqrt, tau
from random import Random
from typing import Any

from slider_resonator.device.device import Device
from slider_resonator.device.interface import INPUTS
from slider_resonator.device.model import Model
from slider_resonator.references.averaged.device_average import blocking_force
from slider_resonator.stressing.case import DEVICE, MODELS, Case, Hold, Limit

TABLE_1 = Device()
W = TABLE_1.drive_frequency
PERIOD = tau / W
AMPLITUDE = TABLE_1.base_amplitude
STICK_TO_SLIP = sqrt(1.0 - TABLE_1.mass_ratio)
"""Frequency of the resonator in stick over that in slip."""
Q = 1.301353
"""q of table 1; it is proportional to the base amplitude."""
NEAR_ONE = 1e-12
AROUND_ONE = {"1 - 1e-12": 1.0 - NEAR_ONE, "1": 1.0, "1 + 1e-12": 1.0 + NEAR_ONE}
FULL_FRICTION = TABLE_1.mean_friction
"""Friction of table 1 at a constant normal load, N."""
CHANGES = 150
"""Steps of a run whose inputs change at each of them."""
DETUNING = 0.05
BEATS = {"1 beat": 1.0, "90 beats": 90.0, "1/3 beat": 1.0 / 3.0}
JUMPS = {"phase": -2.0, "load": 0.15, "frequency_ratio": 3.0}
"""Inputs late in a run, by name."""
BEYOND_NUMBERS = (
    *(("friction_coefficient", 1e308), ("friction_coefficient", 1.7e308)),
    *(("resonator_mass", 1e300), ("normal_preload", 1e308), ("bristle_stiffness", 1e300)),
    *(("drive_frequency", 1e200), ("initial_velocity", 1e308)),
)
"""Values that leave the range of numbers: to be refused, or carried out finitely."""
STEADY = {
    Model(2, 0): 0.12666700,
    Model(1, 0): 0.1266646,
    Model(0, 0, 1): 0.126731,
    Model(0, 0, 2): 0.12666700,
}
"""Steady velocity of table 1, m/s, found without long runs."""

CHEAP = tuple(model for model in MODELS if model != Model(0, 1, 2))
"""All but the model whose cases take longest: it is left out where others try the same."""
AVERAGED = tuple(model for model in MODELS if model.fidelity == 0)
COULOMB = tuple(model for model in MODELS if model.friction_law == 0)
LUGRE = tuple(model for model in MODELS if model.friction_law == 1)
COULOMB_RESOLVED, LUGRE_RESOLVED = (Model(2, 0), Model(1, 0)), (Model(2, 1), Model(1, 1))
CHEAP_LUGRE = tuple(model for model in CHEAP if model in LUGRE)
COULOMB_AVERAGE = Model(0, 0, 1)

Settings = Mapping[str, float]
"""Parameters, and inputs of all steps, that differ from table 1."""
Steps = Callable[[Model, str], Sequence[Hold]]
"""Returns the communication steps of a model at a value."""


def usual_steps(model: Model, period: float = PERIOD) -> Sequence[Hold]:
    """Return steps that show the motion: resolved 32 a period (s), averaged one in ten periods.

    Steps of averages of second order are long enough for leaps, their runs short enough for a
    resolved reference.
    """
    if model.fidelity == 0:
        return [Hold(120.0 * period, 4) if model.leaps else Hold(10.0 * period, 100)]
    return [Hold(period / 32.0, 160)]


@dataclass(frozen=True)
class Axis:
    """The values of an axis, by name, and the models that take each of them.

    Without `steps` they are the usual ones at the drive frequency of the value. Inputs are those of
    all steps. `limits` are those of a value and a model, `start_time` (s) that of its cases.
    """

    name: str
    values: Mapping[str, Settings]
    models: Sequence[Model] = MODELS
    steps: Steps | None = None
    limits: Mapping[tuple[str, Model], Sequence[Limit]] = field(default_factory=dict)
    start_time: float = 0.0

    def cases(self) -> Iterator[Case]:
        """Yield all values, each by all models."""
        for value, settings in self.values.items():
            inputs: dict[str, Any] = {n: settings[n] for n in settings if n in INPUTS}
            parameters = {name: settings[name] for name in settings if name not in INPUTS}
            for model in self.models:
                if self.steps is None:
                    steps = usual_steps(model, tau / parameters.get("drive_frequency", W))
                else:
                    steps = self.steps(model, value)
                holds = tuple(replace(hold, **inputs) for hold in steps)
                limits = tuple(self.limits.get((value, model), ()))
                yield Case(self.name, value, model, parameters, holds, self.start_time, limits)


def _texts(*values: float) -> dict[str, float]:
    return {f"{value:g}": value for value in values}


def _decades(first: int, last: int) -> dict[str, float]:
    return {f"1e{n}": float(f"1e{n}") for n in range(first, last + 1)}


def _each(name: str, values: Mapping[str, float]) -> dict[str, Settings]:
    return {text: {name: value} for text, value in values.items()}


def _around(value: float) -> dict[str, float]:
    below, above = nextafter(value, 0.0), nextafter(value, 2.0 * value)
    return {"at": value, "1 ulp below": below, "1 ulp above": above}


def _tuned_to(w: float) -> Settings:
    """Return table 1 driven at another frequency (rad/s), with its q."""
    return {"drive_frequency": w, "resonator_frequency": w, "base_amplitude": AMPLITUDE * W / w}


def _masses(resonator: float, slider: float) -> Settings:
    """Return masses by their shares in that of table 1."""
    mass = TABLE_1.total_mass
    return {"resonator_mass": mass * resonator, "slider_mass": mass * slider}


def _held(model: Model, value: str) -> list[Limit]:
    """Return what holds a slider without drive under a load as great as its friction."""
    above = AROUND_ONE[value] - 1.0
    (steps,) = usual_steps(model)
    allowed = 2.0 * FULL_FRICTION * max(0.0, above) * steps.duration / TABLE_1.slider_mass
    limits = [Limit("velocity", 0.0, allowed, "excess force times time over mass")]
    if model.fidelity > 0:
        limits.append(Limit("contact_mode", above > 0.0, 0.0, "slips only above full friction"))
    return limits


def _changing_inputs(model: Model, value: str) -> list[Hold]:
    """Return steps that are no simple part or multiple of a period, each under other inputs."""
    size = (3.7 if model.fidelity == 0 else 0.137) * PERIOD
    if value == "changes every step":
        draw = Random(1)
        return [Hold(size, frequency_ratio=draw.uniform(-3.0, 3.0)) for _ in range(CHANGES)]
    draw = Random(int(value.removeprefix("seed ")))
    return [
        Hold(
            size,
            phase=draw.uniform(-10.0, 10.0),
            load=draw.uniform(-0.2, 0.2),
            frequency_ratio=draw.choice((0.0, 1.0, -1.0, 2.0, 3.0, draw.uniform(-5.0, 5.0))),
        )
        for _ in range(CHANGES)
    ]


def _beats(model: Model, value: str) -> list[Hold]:
    """Return steps in all of whose stages the phase of the normal load is the same."""
    beats = BEATS[value]
    # Averages of second order resolve beats: more of them take more work than a step may.
    count = 8 if beats > 1.0 or model.leaps else 24
    size = min(beats, 90.0 if model.fidelity == 0 else 3.0) * (PERIOD / DETUNING)
    return [Hold(size, count)]


def _long(model: Model, first_order: float, second_order: float) -> float:
    """Return the time (s) of a long step that a reference can follow; orders are in periods."""
    return PERIOD * (first_order if model.averages else second_order if model.leaps else 10.0)


def _steps_of_late_jump(model: Model, value: str) -> list[Hold]:
    """Return a few long steps, and shorter ones after them."""
    before = Hold(_long(model, 400.0, 40.0), 4)
    jump: dict[str, Any] = {value: JUMPS[value]}
    return [before, replace(before, size=before.size / 20.0, count=20, **jump)]


def _power_of_ten(_: Model, value: str) -> list[Hold]:
    size = float(value.removesuffix(" s"))
    count = 300 if size < 1e-4 else 20 if size < 1.0 else 2 if size < 1e4 else 1
    return [Hold(PERIOD * SLOWER[value] / 3.0), Hold(size, count)]


def _drive_periods(periods: float, models: Sequence[Model]) -> Axis:
    """Return long runs, in parts of up to 1e4 periods: one step each in the other partition."""
    text = f"{periods:.0e}"
    parts = max(2, min(100, round(periods / 1e4)))
    why = "the steady motion, found without a long run, does not drift"
    return Axis(
        "drive periods",
        {text: {"phase": 0.0}},
        models,
        steps=lambda *_: parts * [Hold(periods * PERIOD / (5 * parts), 5)],
        limits={
            (text, model): [Limit("mean_velocity", velocity, 1e-6, why)]
            for model, velocity in STEADY.items()
        },
    )


ALPHAS = {"0": 0.0, **AROUND_ONE, "1 + 1 ulp": nextafter(1.0, 2.0), "2": 2.0, "100": 100.0}
MASSES = {f"1e{n}": _masses(10.0**n, 1.0 - 10.0**n) for n in (-12, -9, -6, -3)}
MASSES |= {f"1 - 1e{n}": _masses(1.0 - 10.0**n, 10.0**n) for n in (-1, -3, -6, -9)}
RESONANCES = {
    f"{cause} {where} {mode}, xi {xi:g}": {"damping_ratio": xi, "resonator_frequency": w}
    for mode, factor in (("stick", 1.0), ("slip", 1.0 / STICK_TO_SLIP))
    for cause, turns in (("drive", 1.0), ("load", 2.0))
    for where, w in _around(turns * W / factor).items()
    for xi in (0.0, 1e-12)
}
CRITICAL = {
    f"{where} {mode}": {"damping_ratio": xi}
    for mode, damping in (("stick", 1.0), ("slip", STICK_TO_SLIP))
    for where, xi in _around(damping).items()
}
STANDS = Limit("mean_velocity", 0.0, 1e-7, "(22): the averaged slider stands")
BLOCKING = blocking_force(TABLE_1, Hold(PERIOD).phase, 1.0)
RATIOS = {
    **{"0": 0.0, "1e-6": 1e-6, "1 - 1e-12": 1.0 - NEAR_ONE, "1 + 1e-12": 1.0 + NEAR_ONE},
    **{"100": 100.0, "-1": -1.0, "pi": pi, "2^(1/2)": sqrt(2.0)},
}
STILL = {"base_amplitude": 0.0, "normal_amplitude": 0.0}
BEATING = {
    **{"normal_preload": 0.01, "normal_amplitude": 0.01, "initial_velocity": -0.144},
    **{"phase": 0.5, "frequency_ratio": 1.0 + DETUNING},
}
BEATING_VELOCITY = Limit("mean_velocity", -0.0984030, 1e-6, "by small steps")
IN_FLIGHT = {"normal_preload": 0.5, "phase": -pi / 2.0}
FLOWN_VELOCITY = Limit("mean_velocity", 0.0063860, 1e-7, "by small steps")
SLOWER = {f"1e{n} s": 10.0 ** min(max(n + 1, 0), 3) for n in range(-12, 5)}
"""Size of a step to the factor by which the device is slower: a step has 5600 periods at most."""
_DRAW = Random(3)
MIXED = {
    "smallest denormal": [Hold(5e-324 if i % 2 else PERIOD / 7.0) for i in range(60)],
    "random, 1e-12 to 1e-2 s": [Hold(10.0 ** _DRAW.uniform(-12.0, -2.0)) for _ in range(100)],
    "10 periods and 1e-15 s in turn": [Hold(10.0 * PERIOD if i % 2 else 1e-15) for i in range(40)],
}
LATE = [Hold(2.0**-13, 300), Hold(2.0**-5, 3)]
"""At 1e12 s time is known to 2^-13 s, so the steps are multiples of it."""
AROUND_LIMIT = dict(zip(("at", "below", "above"), _around(FULL_FRICTION).values(), strict=True))
AT_REST = {"base_amplitude": 0.0, "phase": 0.0}
CONSTANT_LOAD = {**AT_REST, "normal_amplitude": 0.0}
GRAZING: dict[str, Settings] = {
    f"peak {text} the limit": {**CONSTANT_LOAD, "tangential_force": force}
    for text, force in AROUND_LIMIT.items()
}
UNLOADED = {**AT_REST, "normal_preload": 0.0}
RISING = {
    f"drive {text} the limit all along": {**UNLOADED, "tangential_force": force}
    for text, force in AROUND_LIMIT.items()
}
TOUCHING = {"base_amplitude": 0.0, "phase": pi, "tangential_force": FULL_FRICTION}
RINGING = {**AT_REST, "initial_resonator_displacement": 1e-4}
UNDAMPED = {**RINGING, "damping_ratio": 0.0}
HOLDS = [
    Limit(name, 0.0, allowed, "friction holds a force up to its limit")
    for name, allowed in (("position", 1e-18), ("velocity", 1e-12))
]
AXES = (
    # Parameters of the device.
    Axis("Omega", {f"1e{n}": _tuned_to(10.0**n) for n in range(1, 8)}),
    Axis("q", {f"1e{n}": {"base_amplitude": AMPLITUDE * 10.0**n / Q} for n in range(-6, 4)}),
    Axis("alpha", {**_each("normal_amplitude", ALPHAS), "infinite": {"normal_preload": 0.0}}),
    Axis("mu", _each("friction_coefficient", _texts(0.0, 1e-9, 1e-3, 1.0, 10.0))),
    Axis("r_m", {**MASSES, "0": {"resonator_mass": 0.0}}),
    Axis("xi", _each("damping_ratio", _texts(0.0, 1e-12, 0.999, 1.0, 1.5, 10.0, 100.0))),
    Axis("resonance", RESONANCES, CHEAP),
    Axis("critical damping", CRITICAL, COULOMB_RESOLVED + LUGRE_RESOLVED),
    Axis("bristle stiffness", _each("bristle_stiffness", _decades(-3, 14)), LUGRE),
    Axis("bristle damping", _each("bristle_damping", {"0": 0.0, **_decades(-2, 6)}), CHEAP_LUGRE),
    Axis("tolerance", _each("tolerance", _decades(-14, -2)), CHEAP_LUGRE),
    # Inputs.
    Axis("frequency ratio", _each("frequency_ratio", RATIOS)),
    Axis("frequency ratio", {"changes every step": {}}, steps=_changing_inputs),
    Axis(
        "blocking load",
        {text: {"load": BLOCKING * share} for text, share in AROUND_ONE.items()},
        steps=lambda model, _: (
            [Hold(500.0 * PERIOD, 100)] if model == COULOMB_AVERAGE else usual_steps(model)
        ),
        limits={(text, COULOMB_AVERAGE): [STANDS] for text in AROUND_ONE},
    ),
    Axis(
        "load at full friction",
        {text: {**STILL, "load": -FULL_FRICTION * share} for text, share in AROUND_ONE.items()},
        limits={(text, model): _held(model, text) for text in AROUND_ONE for model in COULOMB},
    ),
    Axis("inputs jump every step", {"seed 1": {}, "seed 2": {}}, steps=_changing_inputs),
    # Slow phases of the load, and values that leave the range of numbers.
    Axis(
        "beat against step",
        dict.fromkeys(BEATS, BEATING),
        steps=_beats,
        limits={("90 beats", COULOMB_AVERAGE): [BEATING_VELOCITY]},
    ),
    Axis(
        "start in flight",
        {f"ratio {r:g}": {**IN_FLIGHT, "frequency_ratio": r} for r in (0.01, -0.003, 1e-6)},
        steps=lambda model, _: [Hold(_long(model, 1000.0, 50.0), 3)],
        limits={("ratio 0.01", COULOMB_AVERAGE): [FLOWN_VELOCITY]},
    ),
    Axis("late jump", {name: {} for name in JUMPS}, steps=_steps_of_late_jump),
    Axis(
        "neutral motions",
        {
            f"ratio {ratio:g}": {"normal_amplitude": 3.0, "frequency_ratio": ratio, "phase": phase}
            for ratio, phase in ((2.0, 0.3), (4.0, 2.5))
        },
    ),
    Axis(
        "overflow",
        {f"{name} {value:g}": {name: value} for name, value in BEYOND_NUMBERS},
        steps=lambda model, _: usual_steps(model),
    ),
    # Steps and times.
    Axis(
        "communication step",
        {text: _tuned_to(W / by) if by > 1.0 else {} for text, by in SLOWER.items()},
        CHEAP,
        steps=_power_of_ten,
    ),
    Axis(
        "communication step", {text: {} for text in MIXED}, CHEAP, steps=lambda _, text: MIXED[text]
    ),
    Axis("start time", {"1e12 s": {}}, steps=lambda *_: LATE, start_time=1e12),
    _drive_periods(1e8, AVERAGED),
    _drive_periods(1e5, COULOMB_RESOLVED),
    _drive_periods(1e3, LUGRE_RESOLVED),
    # Events that graze, coincide, or stand exactly at their limit.
    Axis(
        "grazing release",
        {**GRAZING, "load lifts in a point": {"phase": -pi / 2.0}},
        CHEAP,
        limits={(text, Model(2, 0)): HOLDS for text in GRAZING},
    ),
    Axis(
        "simultaneous",
        {
            **RISING,
            "drive peaks where the load vanishes": TOUCHING,
            "drive peaks in flight": {**TOUCHING, "normal_amplitude": 2.0},
            "no force at all": {**CONSTANT_LOAD, "normal_preload": 0.0},
        },
        CHEAP,
    ),
    Axis(
        "free ringing",
        {
            "xi 0.05": RINGING,
            "xi 0": UNDAMPED,
            "xi 0, mu 0": {**UNDAMPED, "friction_coefficient": 0.0},
            "slides to rest": {**AT_REST, "initial_velocity": 0.01},
        },
        CHEAP,
    ),
)
LONG = (_drive_periods(1e8, COULOMB_RESOLVED), _drive_periods(1e6, LUGRE_RESOLVED))
"""Resolved runs of up to 1e8 periods."""


def axis_cases(*, long: bool = False) -> list[Case]:
    """Return every case of the axes; `long` adds those of `LONG`."""
    return [case for axis in (*AXES, *(LONG if long else ())) for case in axis.cases()]


def device_cases(name: str, parameters: Settings) -> list[Case]:
    """Return the cases of a device by all models: under several inputs, and in uneven steps.

    `parameters` are those that differ from table 1; what they say of the model does not count.
    """
    device = Device.from_mapping(parameters)
    period = tau / device.drive_frequency
    inputs: dict[str, Settings] = {
        "driven": {"phase": 0.4},
        "against the phase": {"phase": -2.0},
        "pulled": {"phase": 0.4, "load": 0.2 * device.mean_friction},
        "pushed": {"phase": 0.4, "load": -0.2 * device.mean_friction},
        "twice the frequency": {"phase": 0.4, "frequency_ratio": 2.0},
        "a beat": {"phase": 0.4, "frequency_ratio": 1.0 + DETUNING},
    }
    values = {text: {**parameters, **setting} for text, setting in inputs.items()}
    uneven = tuple(Hold(period * share) for share in 20 * (0.013, 0.21, 1.7))
    axes = (
        Axis(f"{DEVICE} {name}", values),
        Axis(f"{DEVICE} {name}", {"uneven steps": parameters}, steps=lambda *_: uneven),
    )
    return [case for axis in axes for case in axis.cases()]
