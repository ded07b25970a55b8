"""Fits of measurements that the FMU itself has made, with and without noise."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import partial
from math import nan
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from slider_resonator.arrays import Array
from slider_resonator.errors import FmuError, HarnessError
from slider_resonator.fitting.estimation import Problem, minimise, predict
from slider_resonator.fitting.fit import NO_INTERVALS, fit, isolated
from slider_resonator.fitting.free import free_parameters
from slider_resonator.fitting.measurements import Measurements, Point, datasheet
from slider_resonator.fitting.notes import OUTLIER_LEVEL, outlying
from slider_resonator.fitting.reading import measurements_of
from slider_resonator.fitting.report import parameter_table
from slider_resonator.fitting.result import Fit
from slider_resonator.fmu.instance import Instance
from slider_resonator.fmu.isolation.process import FmuDied, Task

Values = Mapping[str, float]
TRUE = {"friction_coefficient": 0.13, "damping_ratio": 0.08, "normal_amplitude": 0.7}
AVERAGES = {"fidelity": 0, "averaging_order": 1}
"""A model whose predictions cost next to nothing."""


def velocity_at(phase: float, load: float = 0.0) -> Point:
    return Point({"phase": phase, "load": load}, "steady_velocity", 0.0)


POINTS = tuple(velocity_at(0.3 * i, 0.01 * (i % 3)) for i in range(10))


def fitted(instance: Instance, data: Measurements, free: Sequence[str], **known: Any) -> Fit:
    """Fit in this process."""

    def run(_: str, tasks: Sequence[Task]) -> list[Any]:
        return [task(instance) for task in tasks]

    return fit(data, free, known.pop("parameters", {}), run, **known)


def measured(
    instance: Instance, true: Values, points: Sequence[Point], noise: float = 0.0, seed: int = 0
) -> Measurements:
    """Let the FMU measure, with normal errors of `noise` times the root mean square."""
    values = predict(instance, true, Measurements(tuple(points)))
    size = noise * float(np.sqrt(np.mean(values**2)))
    values += size * np.random.default_rng(seed).normal(size=len(values))
    pairs = zip(points, values.tolist(), strict=True)
    return Measurements(tuple(replace(point, measured=value) for point, value in pairs))


def recorded(
    instance: Instance, true: Values, columns: Mapping[str, Array], noise: Values, seed: int = 0
) -> dict[str, Array]:
    """Return outputs of the FMU under inputs over time, with normal errors of these sizes."""
    none = {name: 0.0 * columns["time"] for name in noise}
    exact = predict(instance, true, measurements_of({**columns, **none}))
    errors = np.random.default_rng(seed).normal(size=(len(columns["time"]), len(noise))).T
    outputs = exact.reshape(errors.shape) + errors * np.array([*noise.values()])[:, np.newaxis]
    return dict(zip(noise, outputs, strict=True))


def interval(found: Fit, of: int = 0) -> tuple[float, float]:
    """Return the 95 % interval of a parameter, with nan for an end that there is not."""
    one = found.parameters[of]
    return one.low or nan, one.high or nan


@pytest.mark.parametrize(
    ("known", "true"),
    [
        ({}, TRUE),
        # A parameter without bounds.
        (AVERAGES, {"tangential_force": 40.0, "friction_coefficient": 0.13}),
    ],
)
def test_exact_data_give_the_parameters_back(
    instance: Instance, known: dict[str, float], true: dict[str, float]
) -> None:
    data = measured(instance, {**known, **true}, POINTS)
    found = fitted(instance, data, list(true), parameters=known)
    assert [one.value for one in found.parameters] == pytest.approx([*true.values()], rel=1e-7)
    assert found.starts_agreeing >= 2
    assert not found.open_directions


def test_each_load_has_a_colour(instance: Instance) -> None:
    device = {**AVERAGES, **TRUE}
    data = measured(instance, device, POINTS)
    found = fitted(instance, data, ["damping_ratio"], parameters=device, starts=1)
    lines = [line for line in found.figure().axes[0].lines if line.get_marker() == "+"]
    assert [np.size(line.get_xdata()) for line in lines] == [4, 3, 3]


def test_a_datasheet_is_solved_without_intervals(instance: Instance) -> None:
    points = [Point({"load": 0.0}, "steady_velocity", 0.0), Point({}, "blocking_force", 0.0)]
    true = {"friction_coefficient": 0.2, "normal_amplitude": 0.6}
    numbers = predict(instance, true, Measurements(tuple(points)))
    velocity, force = numbers.tolist()
    found = fitted(instance, datasheet(velocity, force, []), list(true))
    assert [one.value for one in found.parameters] == pytest.approx(list(true.values()), rel=1e-7)
    assert [one.low for one in found.parameters] == [None, None]


@pytest.mark.parametrize("first", [0, 30])
def test_a_run_is_fitted_over_time(instance: Instance, first: int) -> None:
    """Whole, or cut out of a recording from a later row on."""
    true = {"friction_coefficient": 0.17, "slider_mass": 1.3}
    columns = {"time": np.linspace(0.0, 0.2, 81), "phase": np.full(81, 0.4)}
    columns |= recorded(instance, true, columns, {"velocity": 0.0, "position": 0.0})
    columns["velocity"][first + 5] = np.nan
    data = measurements_of({name: column[first:] for name, column in columns.items()})
    found = fitted(instance, data, list(true), starts=1)
    assert [one.value for one in found.parameters] == pytest.approx(list(true.values()), rel=1e-6)
    assert found.notes == data.notes
    assert ["begins at 75 ms" in note for note in found.notes] == [True] * (first > 0)


def test_set_inputs_act_on_a_run_that_does_not_say_them(instance: Instance) -> None:
    """On its own columns they do not."""
    columns = {"time": np.linspace(0.0, 0.2, 81), "load": np.full(81, 0.01)}
    inputs = {"phase": 0.4, "amplitude_deviation": 0.1}
    said = columns | {name: np.full(81, value) for name, value in inputs.items()}
    outputs = recorded(instance, TRUE, said, {"velocity": 0.0})
    known = {**TRUE, **inputs, "load": 0.5, "damping_ratio": 0.1}
    data = measurements_of(columns | outputs)
    (damping,) = fitted(instance, data, ["damping_ratio"], parameters=known, starts=1).parameters
    assert damping.value == pytest.approx(TRUE["damping_ratio"], rel=1e-6)


@pytest.mark.parametrize(
    ("run_noise", "points"), [(5e-7, POINTS * 2), (5e-5, POINTS * 2), (5e-5, POINTS[:4])]
)
def test_noise_is_that_of_each_source(
    instance: Instance, run_noise: float, points: Sequence[Point]
) -> None:
    """Each quantity of each source errs by what its own residuals say.

    Friction is what the table alone tells: with one noise for all, its interval would be that of
    the noise of the run, and with the degrees of freedom of all numbers too narrow.
    """
    table = measured(instance, TRUE, points, 0.02, seed=3)
    columns = {"time": np.linspace(0.0, 0.02, 201), "phase": np.full(201, 0.4)}
    outputs = recorded(instance, TRUE, columns, {"resonator_displacement": run_noise}, seed=4)
    widths = []
    for data in (table, table + measurements_of(columns | outputs)):
        found = fitted(instance, data, ["friction_coefficient"], parameters=TRUE, starts=1)
        low, high = interval(found)
        assert low < TRUE["friction_coefficient"] < high
        widths.append(high - low)
    assert widths[1] == pytest.approx(widths[0], rel=0.2)
    for rows in found.measurements.series.values():
        assert found.residuals[rows].std() == pytest.approx(1.0, rel=0.3)


def test_the_most_likely_minimum_is_taken(instance: Instance) -> None:
    """With one noise for all, the least squares are at a bristle damping of 1.3, far from 14."""
    start = {"friction_coefficient": 0.1, "bristle_stiffness": 1e5, "bristle_damping": 10.0}
    start |= {"damping_ratio": 0.05, "friction_law": 1, "friction_faces": 2}
    true = {"friction_coefficient": 0.13, "bristle_stiffness": 6e4, "bristle_damping": 14.0}
    true["damping_ratio"] = 0.07
    times = 3e-4 * np.arange(240)
    columns = {"time": times, "phase": np.where(times < 0.03, 0.5, -1.2)}
    columns["load"] = np.where(times < 0.05, 0.0, 0.03)
    noise = {"position": 2e-6, "velocity": 4e-3, "resonator_velocity": 3e-2}
    data = measurements_of(columns | recorded(instance, start | true, columns, noise, seed=110))
    found = fitted(instance, data, list(true), parameters=start)
    assert found.starts_agreeing == 4
    low, high = interval(found, of=2)
    assert low < 14.0 < high


def die(_: Instance, over_limit: bool) -> None:
    """End as a process of its own would."""
    raise FmuDied("no answer", over_limit=over_limit)


@pytest.mark.parametrize(("over_limit", "end"), [(True, "(--time-limit)"), (False, "no answer")])
def test_a_lost_process_says_stage_and_option(native_fmu: Path, over_limit: bool, end: str) -> None:
    with isolated(native_fmu, 1, 60.0) as run, pytest.raises(FmuError) as error:
        run("searching", [partial(die, over_limit=over_limit)])
    assert str(error.value).startswith("searching: no answer")
    assert str(error.value).endswith(end)


def test_what_the_data_leave_open_is_named(instance: Instance) -> None:
    """Friction is coefficient times normal load: all three cannot be told from velocities."""
    data = measured(instance, {**AVERAGES, **TRUE}, POINTS, 0.01)
    free = ["friction_coefficient", "normal_preload", "normal_amplitude", "damping_ratio"]
    found = fitted(instance, data, free, parameters=AVERAGES, starts=1)
    (direction,) = found.open_directions
    assert direction.spread == float("inf")
    assert direction.factors == pytest.approx(
        {name: direction.factors[name] for name in free[:3]}, rel=1e-12
    )
    coefficient, preload, amplitude = (direction.factors[name] for name in free[:3])
    assert preload == pytest.approx(-coefficient, rel=1e-4), "the friction force is unchanged"
    assert amplitude == pytest.approx(-coefficient, rel=1e-4)
    assert {one.name for one in found.parameters if one.is_open} == set(free[:3])
    low, high = interval(found, free.index("damping_ratio"))
    assert low < 0.08 < high
    still = {**AVERAGES, "base_amplitude": 0.0}
    found = fitted(instance, data, ["friction_coefficient"], parameters=still, starts=1)
    assert found.parameters[0].is_open, "a device that never moves"


def test_slopes_at_a_bound_are_those_inside(instance: Instance) -> None:
    """A difference that the bound cuts off is over what is left, not half the slope."""
    data = measured(instance, TRUE, POINTS)
    slopes = []
    for bounds in ({}, {"damping_ratio": (0.08, 0.2)}):
        free = free_parameters(["damping_ratio"], TRUE, bounds)
        start = np.array([free[0].internal(0.08)])
        slopes.append(minimise(instance, Problem(TRUE, free, data), start).jacobian)
    assert np.abs(slopes[1] - slopes[0]).max() < 1e-3 * np.abs(slopes[0]).max()


@pytest.mark.parametrize(
    ("free", "bounds", "said"),
    [
        (["friction_coeff"], {}, "did you mean 'friction_coefficient'?"),
        (["load"], {}, "load cannot be free; must be a parameter"),
        (["friction_faces"], {}, "friction_faces cannot be free; must be"),
        (["slider_mass", "slider_mass"], {}, "must be different parameters"),
        ([], {}, "must be one parameter or more"),
        (["slider_mass"], {"slider_mass": (2.0, 1.0)}, "must be ascending"),
        (
            ["slider_mass"],
            {"slider_mass": (0.1, math.inf)},
            "must be ascending, each a finite number",
        ),
        (["slider_mass"], {"damping_ratio": (0.1, 1.0)}, "bounds of damping_ratio: it is not free"),
        (["slider_mass"], {"slider_mass": 0.1}, "bounds of slider_mass = 0.1: must be two"),
        (["slider_mass"], {"slider_mass": ("1 g", "1 m")}, "in kg, or texts"),
        (
            ["slider_mass"],
            {"slider_mass": (-1.0, 1.0)},
            "each a finite number of at least 1e-12 kg",
        ),
    ],
)
def test_refused_free_parameters(
    free: list[str], bounds: dict[str, tuple[float, float]], said: str
) -> None:
    with pytest.raises(HarnessError) as error:
        free_parameters(free, {}, bounds)
    assert said in str(error.value)


@pytest.mark.parametrize(("count", "factor"), [(20, 1.5), (12, 0.1)])
def test_outliers_are_named_and_noise_is_not(instance: Instance, count: int, factor: float) -> None:
    points = [
        replace(velocity_at(0.1 * i), source="a.csv", row=f"line {i + 2}") for i in range(count)
    ]
    data = measured(instance, TRUE, points, 0.01, seed=3)
    assert not fitted(instance, data, ["damping_ratio"], parameters=TRUE, starts=1).notes
    noisy = list(data.points)
    noisy[6] = replace(noisy[6], measured=factor * noisy[6].measured)
    wrong = Measurements(tuple(noisy))
    (note,) = fitted(instance, wrong, ["damping_ratio"], parameters=TRUE, starts=1).notes
    assert note.startswith("outliers, by their studentised deleted residuals: a.csv line 8: steady")


def test_normal_noise_has_outliers_in_fewer_than_1_of_100_fits() -> None:
    """In linear models of two or three parameters. Two gross errors do not hide each other."""
    random = np.random.default_rng(2)
    false_alarms = 0
    for _ in range(1000):
        phases = random.uniform(-np.pi, np.pi, random.integers(12, 41))
        slopes = np.column_stack([np.sin(phases), np.cos(phases), np.cos(2.0 * phases)])
        noise = 0.01 * random.normal(size=len(phases))
        false_alarms += bool(outlying(noise, slopes[:, : random.integers(2, 4)], OUTLIER_LEVEL))
    assert false_alarms < 10
    noise[[3, 7]] += 1.0
    assert outlying(noise, slopes, OUTLIER_LEVEL) == [3, 7]


def test_systematic_residuals_are_noted(instance: Instance) -> None:
    """Friction cannot stand for damping: the residuals follow the phase."""
    points = [replace(velocity_at(0.1 * i), row=f"line {i}") for i in range(30)]
    data = measured(instance, {"damping_ratio": 0.3}, points, 0.002)
    found = fitted(instance, data, ["friction_coefficient"], starts=1)
    assert found.parameters[0].deviation is None
    missed, no_intervals, note = found.notes
    assert "of steady_velocity, which is 31.6 mm/s (rms)" in missed
    assert missed.endswith("check units and signs, and what is held")
    assert no_intervals == NO_INTERVALS
    assert "residuals of steady_velocity are systematic" in note


def test_all_solutions_are_named_and_the_nearest_to_the_start_is_taken(instance: Instance) -> None:
    """The velocity has a peak over the damping: it is the same on both sides."""
    drive = np.pi * 2.0 * 1.98e4
    device = {"slider_mass": 0.05, "resonator_mass": 0.005, "friction_coefficient": 0.25}
    device |= {"normal_preload": 3.0, "normal_amplitude": 3.0, "friction_faces": 1.0}
    device |= {"resonator_frequency": drive / 0.99, "drive_frequency": drive}
    device |= {"base_amplitude": 1e-6, "damping_ratio": 0.02}
    data = measurements_of({"phase [deg]": [30.0], "load": [0.0], "velocity [mm/s]": [55.0]})
    found = fitted(instance, data, ["damping_ratio"], parameters=device)
    (damping,) = found.parameters
    assert damping.value == pytest.approx(0.0166, abs=1e-4)
    (note,) = found.notes
    assert "are met as well, or almost, by damping_ratio = 0.0318838" in note
    other = fitted(instance, data, ["damping_ratio"], parameters={**device, "damping_ratio": 0.04})
    assert other.parameters[0].value == pytest.approx(0.0318838, rel=1e-5)


def test_stated_deviations_are_used(instance: Instance) -> None:
    """Noise that is stated is no miss."""
    device = {**AVERAGES, **TRUE}
    data = measured(instance, device, POINTS * 20, 0.8, seed=2)
    size = 0.8 * float(np.sqrt(np.mean(predict(instance, device, data) ** 2)))
    widths = []
    for deviation in (size, 2.0 * size):
        stated = Measurements(tuple(replace(one, deviation=deviation) for one in data.points))
        found = fitted(instance, stated, ["damping_ratio"], parameters=device, starts=1)
        assert not found.notes
        widths.append(np.diff(interval(found)))
    assert widths[1] / widths[0] == pytest.approx(2.0, rel=0.1)


@pytest.mark.nightly
def test_intervals_cover_the_truth_in_90_to_99_of_100(instance: Instance) -> None:
    """Random devices and truths, 20 velocities with 1 % noise, three free parameters each."""
    covered = {name: 0 for name in TRUE}
    judged = dict(covered)
    for seed in range(100):
        random = np.random.default_rng(seed)
        true = {name: value * random.uniform(0.7, 1.4) for name, value in TRUE.items()}
        device = {"slider_mass": random.uniform(0.5, 2.0), "friction_law": int(seed % 4 == 0)}
        points = [
            velocity_at(random.uniform(-1.5, 1.5), random.uniform(-0.03, 0.03)) for _ in range(20)
        ]
        data = measured(instance, {**device, **true}, points, 0.01, seed)
        found = fitted(instance, data, list(true), parameters=device, starts=2)
        for of, name in enumerate(true):
            low, high = interval(found, of)
            judged[name] += int(np.isfinite([low, high]).all())
            covered[name] += low <= true[name] <= high
    for name, count in covered.items():
        assert judged[name] >= 95, "few devices leave a parameter open"
        assert 0.90 <= count / judged[name] <= 0.99, name


def test_data_that_do_not_suit_what_is_free_are_refused(instance: Instance) -> None:
    with pytest.raises(HarnessError, match="1 measured number for 2 free parameters"):
        fitted(instance, datasheet(0.1, None, []), ["slider_mass", "damping_ratio"])
    data = measurements_of({"damping_ratio": [0.1, 0.2], "velocity": [0.1, 0.1]})
    with pytest.raises(HarnessError, match="damping_ratio is free, and a column of data; must be"):
        fitted(instance, data, ["damping_ratio"])


def test_an_end_at_a_bound_of_the_search_is_none(instance: Instance) -> None:
    """A small damping ratio is hardly seen in noise: nothing bounds it from below."""
    points = [velocity_at(0.1 * i) for i in range(8)]
    true = {"damping_ratio": 1e-3}
    data = measured(instance, true, points, 0.08, seed=6)
    found = fitted(instance, data, ["damping_ratio"], parameters=true, starts=1)
    (one,) = found.parameters
    assert one.low is None
    assert one.high is not None
    assert "95 % below " in str(found)
    assert str(parameter_table(found).rows[0][3]).startswith("below ")
    given = {"damping_ratio": (1e-7, 1.0)}
    (one,) = fitted(instance, data, [*given], parameters=true, starts=1, bounds=given).parameters
    assert one.low == pytest.approx(1e-7), "a bound that was asked for is an end"
