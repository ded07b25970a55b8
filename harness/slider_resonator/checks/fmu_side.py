"""The FMU in a scene: run, steady motion and blocking force, each computed once on first use."""

from collections.abc import Callable, Generator, Mapping, Sequence
from functools import cached_property, partial
from pathlib import Path
from typing import Any, TypeVar

from slider_resonator.fmu.instance import Instance
from slider_resonator.fmu.isolation.process import Outcome
from slider_resonator.fmu.isolation.tasks import run_tasks
from slider_resonator.fmu.run import Record, run
from slider_resonator.scenes.scene import Scene, ScenePoint
from slider_resonator.steady.searches import Blocking, SteadyMotion, find_blocking, find_steady

PREDICTIONS: Mapping[str, str] = {
    "predicted_velocity_in_run": "steady_velocity",
    "predicted_blocking_force_in_run": "blocking_force",
    "final_predicted_velocity": "steady_velocity",
    "final_predicted_blocking_force": "blocking_force",
    "error_over_estimate": "slow_motion_error",
    **{name: name for name in ("prediction_valid", "slow_motion_error", "friction_power")},
}
"""Quantities, each with the output that it is measured from in a run. These outputs can cost more
than the motion: an FMU computes them when they are read."""


class FmuSide:
    """Run, steady motion and blocking force of one FMU instance in one scene.

    The run has those outputs among `PREDICTIONS` that the scene expects something of.
    """

    def __init__(self, instance: Instance, scene: Scene) -> None:
        self.instance = instance
        self.scene = scene
        expected = {PREDICTIONS.get(expect.quantity) for expect in scene.expect}
        self._unread = {*PREDICTIONS.values()} - expected

    @cached_property
    def record(self) -> Record:
        """The run of the scene."""
        outputs = [name for name in self.instance.fmu.outputs if name not in self._unread]
        return run(self.instance, self.scene.parameters, self.scene.schedule(), outputs=outputs)

    @cached_property
    def resolved(self) -> Record:
        """The mean velocity of the same run at fidelity 2, to a tolerance of 1e-10 at least."""
        tolerance = min(self.scene.device.tolerance, 1e-10)
        parameters = {**self.scene.parameters, "fidelity": 2, "tolerance": tolerance}
        outputs = ("mean_velocity",)
        return run(self.instance, parameters, self.scene.schedule(), outputs=outputs)

    @cached_property
    def steady(self) -> SteadyMotion:
        """The steady motion under the inputs of the scene."""
        return find_steady(self.instance, self.scene.values)

    @cached_property
    def blocking(self) -> Blocking:
        """The blocking force under the inputs of the scene, whatever its load."""
        return find_blocking(self.instance, self.scene.values)


def _measure(instance: Instance, scene: Scene, measure: Callable[[FmuSide], Any]) -> Any:
    return measure(FmuSide(instance, scene))


Point = TypeVar("Point", bound=ScenePoint)


def measure_points(
    fmu: Path,
    points: Sequence[Point],
    measure: Callable[[FmuSide], Any],
    time_limit: float,
    jobs: int = 1,
) -> Generator[tuple[Point | None, Outcome], None, None]:
    """Yield each point with the outcome of `measure` there, which must be picklable.

    Up to `jobs` processes of the FMU share the points, as `run_tasks` has it. After a crash or a
    missed `time_limit` (s) the other points of that scene are left out.
    """
    tasks = [(p, partial(_measure, scene=p.scene, measure=measure)) for p in points]
    return run_tasks(fmu, tasks, time_limit, name=lambda point: point.scene.name, jobs=jobs)
