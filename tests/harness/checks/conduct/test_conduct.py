"""Faults of conduct are found and named; those of an FMU of FMI 3.0 are rejected."""

import math
import tomllib
from collections.abc import Callable, Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import cast

import pytest
from fmpy.fmi1 import FMICallException

from slider_resonator.checks.conduct.host_calls import derivative_offer_faults
from slider_resonator.checks.conduct.refusals import Trial
from slider_resonator.checks.conduct.replays import Replay
from slider_resonator.checks.conduct.variables import dependency_faults
from slider_resonator.checks.fmu_side import FmuSide
from slider_resonator.device.schedule import schedule
from slider_resonator.fmu.instance import Instance, instantiate
from slider_resonator.fmu.opening import open_fmu
from slider_resonator.scenes.scene_files import find_scene
from studies.mutants.bench import Judging
from studies.mutants.changes import changes_in
from studies.mutants.runs import run_changes
from tests.harness.scene_text import scene_of


@pytest.fixture
def own(native_fmu: Path) -> Iterator[Instance]:
    """An instance of an FMU whose description may be changed."""
    with open_fmu(native_fmu) as fmu, instantiate(fmu) as made:
        yield made


@pytest.mark.parametrize(
    ("place", "output", "name", "when"),
    [
        ("outputs", "steady_velocity", "phase", "in a run"),
        ("outputs", "friction_force", "load", "in a run"),
        ("initialUnknowns", "steady_velocity", "damping_ratio", "at the start"),
        ("initialUnknowns", "velocity", "initial_velocity", "at the start"),
    ],
)
def test_missing_dependency(own: Instance, place: str, output: str, name: str, when: str) -> None:
    unknowns = getattr(own.fmu.description, place)
    (unknown,) = [one for one in unknowns if one.variable.name == output]
    unknown.dependencies = [one for one in unknown.dependencies if one.name != name]
    found = dependency_faults(FmuSide(own, scene_of("")))
    assert [*found] == [f"{name} acts on {output} {when} without being declared"]


@pytest.mark.parametrize("change", [lambda x: math.nextafter(x, 6.0), lambda _: math.nan])
def test_the_last_bit_and_nan_are_differences(
    own: Instance, change: Callable[[float], float]
) -> None:
    run = Replay(own, {}, schedule(1e-3, 1e-3))
    before, (value, *others) = run.rows
    other = change(value)
    found = run.differences("replayed", [before, [other, *others]])
    assert [*found] == [f"replayed: {own.fmu.outputs[0]} at 0.001 s is {other!r}, was {value!r}"]


@pytest.mark.parametrize(
    ("offer", "value"), [("providesDirectionalDerivative", True), ("maxOutputDerivativeOrder", 2)]
)
def test_a_false_offer_is_a_fault(own: Instance, offer: str, value: object) -> None:
    own.start({})
    assert not [*derivative_offer_faults(own)]
    setattr(own.fmu.offers, offer, value)
    (fault,) = derivative_offer_faults(own)
    assert fault.startswith(f"{offer} is {value}".replace("True", "true"))


@pytest.mark.parametrize(
    ("function", "number", "status"),
    [
        ("fmi2DoStep", 2, "fmi2Discard"),
        ("fmi3DoStep", 2, "fmi3Discard"),
        ("fmi2DoStep", 4, "fmi2Fatal"),
    ],
)
def test_status_that_ends_a_run_is_a_fault(function: str, number: int, status: str) -> None:
    fmu = SimpleNamespace(variables={}, runs_without_python=True)
    instance = SimpleNamespace(messages=[], fmu=fmu, read=lambda names: {})
    trial = Trial(cast(Instance, instance))

    def refused() -> None:
        raise FMICallException(function=function, status=number)

    trial.refuses("a step", refused)
    assert trial.faults == [f"a step gives {status}, at which hosts end a run"]


FAULTS = Path(__file__).with_name("fmi3_faults.toml").read_text(encoding="utf-8")


@pytest.mark.isolated
@pytest.mark.slow
def test_faults_of_fmi_3_are_rejected(native_3_fmu: Path) -> None:
    run = run_changes(native_3_fmu, changes_in(FAULTS), Judging([find_scene("interface")]))
    assert [verdict.variant.meaning for verdict in run.survivors] == []
    found = {verdict.variant.name: verdict.quantity for verdict in run.verdicts}
    entries = {n: entry for table in tomllib.loads(FAULTS).values() for n, entry in table.items()}
    noticed = {name: e["quantity"] for name, e in entries.items() if "quantity" in e}
    assert {name: found[name] for name in noticed} == noticed
