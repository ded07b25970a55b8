"""Errors that the probe of `choose` predicts for averaged motion in the loop."""

import zipfile
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from functools import partial
from pathlib import Path

from fmpy.ssp.ssd import read_ssd

from slider_resonator.choosing.choice import START_TOLERANCE, Candidate
from slider_resonator.choosing.choosing import TIME_LIMIT
from slider_resonator.choosing.probe import Probe
from slider_resonator.device.model import Model
from slider_resonator.errors import HarnessError
from slider_resonator.fmu.instance import Instance
from slider_resonator.fmu.isolation.process import IsolatedFmu
from slider_resonator.fmu.opening import check_unpacked_size
from slider_resonator.output.files import temporary_folder
from slider_resonator.scenes.scene import Scene, scene_from
from studies.closed_loop.duty import Duty, LoadInterval
from studies.closed_loop.loop import DESIGN, FIDELITY, LoopRecord, parameters

FIRST = 10
"""Communication steps after a step of the load, at each of whose ends the error is predicted."""


def predicted_errors(
    package: Path,
    design: LoopRecord,
    duty: Duty,
    progress: Callable[[float], None] = lambda share: None,
    time_limit: float = TIME_LIMIT,
) -> list[float | None]:
    """Return the largest error (m/s) of the mean velocity at fidelity 0 after each load step.

    The slider of the package is given the phase that the controller gave it in the design, at every
    communication point, and the loads. The error is asked for while the loop answers, where it has
    settled and at the end; None stands for a load under which averaged motion does not meet the
    need, the mean velocity within the duty's band. The slider runs in a process of its own, which
    may take `time_limit` (s) for each prediction. Raises HarnessError without a slider.
    """
    device = _device(package)
    with _slider(package, time_limit) as slider:
        largest: list[float | None] = []
        for index, interval in enumerate(duty.load_steps):
            found = [
                slider.run(partial(_error, scene=_scene(design, duty, device, stop)))
                for stop in _instants(duty, interval)
            ]
            progress((index + 1) / len(duty.load_steps))
            largest.append(None if None in found else max(error for error in found if error))
        return largest


def _instants(duty: Duty, interval: LoadInterval) -> list[int]:
    """Return the communication points, by number, at which the error is predicted."""
    start, end = round(interval.start / duty.step), round(interval.end / duty.step)
    settled = start + round(duty.settling / duty.step)
    return [*range(start + 1, start + FIRST + 1), settled, end]


def _device(package: Path) -> dict[str, float]:
    """Return the slider's parameters in the design's set, but for its fidelity."""
    values = {
        name: value for name, value in parameters(package, DESIGN).items() if name != FIDELITY
    }
    return {n.removeprefix("slider."): v for n, v in values.items() if n.startswith("slider.")}


def _error(instance: Instance, scene: Scene) -> float | None:
    """Return the error (m/s) of averaged motion in a scene, None above the allowed one.

    Its order is that of the device.
    """
    assert scene.need is not None
    device = scene.device
    order = device.averaging_order if instance.fmu.has_orders else None
    model = Model(0, device.friction_law, order)
    candidate = Candidate(model, START_TOLERANCE, scene.step_size)
    found = Probe(instance, scene).measure(candidate)[0]["mean_velocity"]
    allowed = scene.need.needs["mean_velocity"].at(found.magnitude)
    return found.error if found.error <= allowed else None


def _scene(design: LoopRecord, duty: Duty, device: Mapping[str, float], stop: int) -> Scene:
    """Return the scene of the first `stop` communication steps, in which nothing is fed back."""
    phases = [design.phase[0], *design.phase[:-1]]  # each holds over the step after
    inputs = {
        name: [(time, float(value)) for time, value in zip(duty.times, values, strict=True)]
        for name, values in (("phase", phases), ("load", design.load))
    }
    content = {
        "name": "loop",
        "title": "The controller's inputs at fidelity 0",
        "device": device,
        "inputs": {name: {"steps": points[:stop]} for name, points in inputs.items()},
        "run": {"stop_time": stop * duty.step, "step_size": duty.step},
        "need": {"mean_velocity": {"abs": duty.band * duty.reference}},
    }
    return scene_from(content, "the closed loop")


@contextmanager
def _slider(package: Path, time_limit: float) -> Iterator[IsolatedFmu]:
    """Instantiate the slider of a package in a process of its own."""
    check_unpacked_size(package)
    sources = {part.name: part.source for part in read_ssd(str(package)).system.elements}
    if "slider" not in sources:
        raise HarnessError(f"{package}: no component slider, only {', '.join(sources)}")
    with temporary_folder() as folder, zipfile.ZipFile(package) as archive:
        fmu = Path(archive.extract(sources["slider"], folder))
        with IsolatedFmu(fmu, time_limit) as slider:
            yield slider
