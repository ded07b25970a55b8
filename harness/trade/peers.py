"""Other methods on the same equations: what a user might take instead of the FMU."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from time import process_time
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from harness.reference_steady import (
    Simulate,
    reference_blocking_force,
    reference_steady_velocity,
)
from harness.references import (
    located_cvode,
    located_events,
    lugre_scipy,
    moreau_jean,
    paper_method,
    regularised,
    taylor,
)
from harness.references.averaged_motion import simulate_averaged
from harness.references.closed_forms import equivalent_force
from harness.references.device import Device
from harness.references.held_inputs import HeldInputs
from harness.references.lugre_cvode import simulate_lugre_cvode
from harness.references.lugre_taylor import simulate_lugre
from harness.references.switching_taylor import SlidingEnd, simulate_sliding
from harness.references.trajectory import Trajectory
from harness.trade.method import Answer, Found, Label, Method
from harness.trade.motion import Motion, last_events
from harness.trade.result import PEER
from harness.trade.task import Task

Array = NDArray[np.float64]
Follow = Callable[[Device, Sequence[HeldInputs], Array], Motion]

MOST_EVALUATIONS = 1_000_000
"""Evaluations that a method on sgn may take: one that chatters is given up early."""
NO_EVENTS = {"event_times": "no event is located"}
NOT_SHOT = dict.fromkeys(
    ("steady_velocity", "blocking_force"), "shooting needs a start in any state of the full device"
)


@dataclass(frozen=True)
class Peer:
    """A method by the setting that its error depends on.

    `simulate`, where there is one, can start anywhere and so be shot with to an accuracy of
    `shooting` in units of the state.
    """

    family: str
    setting: str
    tolerance: float | None
    follow: Follow
    simulate: Simulate | None = None
    shooting: float = 1e-9
    sticks_not: bool = False
    missing: Mapping[str, str] = field(default_factory=dict)


def peers(task: Task) -> list[Peer]:
    """Return the peers for the friction law of a task."""
    return [*(_lugre if task.device.friction_law == 1 else _coulomb)(task.device), _averaged()]


def peer_methods(task: Task) -> Iterator[Method]:
    """Yield the peers as methods."""
    for peer in peers(task):
        yield Method(
            _label(task, peer),
            partial(_run, task, peer),
            partial(_seconds, task, peer),
            sticks_not=peer.sticks_not,
            missing=peer.missing,
        )


def _seconds(task: Task, peer: Peer, periods: int) -> float:
    began = process_time()
    motion = _run(task, peer, periods)
    return process_time() - began - (motion.start_cpu or 0.0)


def peer_answers(task: Task) -> Iterator[Answer]:
    """Yield the searches for steady motion and blocking force by those peers that can be shot."""
    for quantity in ("steady_velocity", "blocking_force"):
        for peer in peers(task):
            if peer.simulate is not None:
                find = partial(shoot, task, quantity, peer.simulate, peer.shooting)
                yield Answer(_label(task, peer), quantity, find)


def shoot(task: Task, quantity: str, simulate: Simulate, tolerance: float, budget: float) -> Found:
    """Return a steady velocity or blocking force by shooting with any integrator.

    Raises RuntimeError when that takes more CPU time (s) than its budget.
    """
    turns: list[float] = []
    began = process_time()

    def counted(device: Device, held: Sequence[HeldInputs], times: Array) -> Trajectory:
        if process_time() - began > budget:
            raise RuntimeError(
                f"the search by shooting takes more than its budget of {budget:g} s of CPU time"
            )
        turns.append((held[-1].stop - held[0].start) / task.period)
        return simulate(device, held, times)

    phase, load, ratio = (task.inputs[name] for name in ("phase", "load", "frequency_ratio"))
    options = {"simulate": counted, "tolerance": tolerance}
    if quantity == "steady_velocity":
        value = reference_steady_velocity(task.device, phase, load, ratio, **options)  # type: ignore[arg-type]
    else:
        value = reference_blocking_force(task.device, phase, ratio, **options)  # type: ignore[arg-type]
    return Found(value, "the search by shooting has found none", round(sum(turns)))


def motion_of(run: Trajectory, *, located: bool) -> Motion:
    """Return a trajectory as the trade takes it; events count if they were located."""
    return Motion(
        times=run.time,
        position=run.position,
        velocity=run.velocity,
        last_event=last_events(run.event_times, run.time) if located else None,
        steps=run.steps or None,
        evaluations=run.evaluations,
        events=len(run.event_times) if located else run.reversals,
    )


def _label(task: Task, peer: Peer) -> Label:
    name = f"{peer.family}, {peer.setting}" if peer.setting else peer.family
    return Label(PEER, peer.family, name, task.device.friction_law, tolerance=peer.tolerance)


def _run(task: Task, peer: Peer, periods: int) -> Motion:
    times = task.readings(periods)
    if task.beat is not None:
        times = np.union1d(times, task.ends(periods))
    motion = peer.follow(task.device, task.held(periods), times)
    if task.beat is None:
        return motion
    ends = task.ends(periods)
    position = motion.position[np.searchsorted(times, ends)]
    return replace(motion, course=(ends[1:], np.diff(position) / task.period))


def _trajectory(
    family: str,
    setting: str,
    simulate: Simulate,
    *,
    tolerance: float | None = None,
    shooting: float = 1e-9,
    located: bool = True,
) -> Peer:
    def follow(device: Device, held: Sequence[HeldInputs], times: Array) -> Motion:
        return motion_of(simulate(device, held, times), located=located)

    missing = {} if located else NO_EVENTS
    return Peer(family, setting, tolerance, follow, simulate, shooting, missing=missing)


def _coulomb(device: Device) -> Iterator[Peer]:
    for tolerance in (1e-3, 1e-6, 1e-9, 1e-12):
        yield _sliding("heyoka at its fastest", "path", taylor.simulate, tolerance)
    for tolerance in (1e-6, 1e-12):
        simulate: Simulate = partial(taylor.simulate, tolerance=tolerance)
        yield _at("heyoka, events located outside", tolerance, simulate)
    for method, tolerances in (
        ("DOP853", (1e-3, 1e-5, 1e-8, 1e-11)),
        ("LSODA", (1e-5, 1e-8)),
        ("Radau", (1e-3, 1e-5)),
    ):
        for tolerance in tolerances:
            simulate = partial(
                located_events.simulate,
                method=method,
                rtol=tolerance,
                atol=1e-2 * tolerance,
                steps_per_period=4,
            )
            yield _at(f"{method} with located events", tolerance, simulate)
    for tolerance in (1e-5, 1e-7, 1e-9, 1e-11):
        simulate = partial(located_cvode.simulate, tolerance=tolerance)
        yield _at("CVODE with root finding", tolerance, simulate)
    for atol in (1e-4, 1e-6, 1e-8, 1e-10):
        simulate = partial(paper_method.simulate, atol=atol, most_evaluations=MOST_EVALUATIONS)
        yield _trajectory(
            "DOP853 on sgn (the paper)",
            f"rtol 1e-06, atol {atol:.0e}",
            simulate,
            tolerance=atol,
            shooting=1e-6,
            located=False,
        )
    for count in (16, 64, 256, 1024):
        simulate = partial(moreau_jean.simulate, steps_per_period=count)
        setting = f"{count} steps a period"
        yield _trajectory("Moreau-Jean", setting, simulate, shooting=1e-6, located=False)
    speed = equivalent_force(device).velocity_amplitude
    for share in (1e-1, 1e-2, 1e-3, 1e-4):
        simulate = partial(regularised.simulate, width=share * speed, rtol=1e-7, atol=1e-9)
        setting = f"width {share:g} of the fast velocity"
        yield _trajectory("tanh, LSODA", setting, simulate, shooting=1e-6, located=False)


def _lugre(_: Device) -> Iterator[Peer]:
    for bristle in ("path", "state"):
        for tolerance in (1e-3, 1e-6, 1e-9, 1e-12):
            family = f"heyoka at its fastest, bristle {'from' if bristle == 'path' else 'as'} "
            yield _sliding(family + bristle, bristle, simulate_lugre, tolerance)
    for method, tolerances in (
        ("LSODA", (1e-4, 1e-6, 1e-8, 1e-10)),
        ("Radau", (1e-4, 1e-6)),
        ("DOP853", (1e-6, 1e-9)),
    ):
        for tolerance in tolerances:
            simulate: Simulate = partial(
                lugre_scipy.simulate_lugre, method=method, rtol=tolerance, atol=1e-2 * tolerance
            )
            family = f"{method}, bristle as state"
            yield _at(family, tolerance, simulate, located=False)
    for tolerance in (1e-4, 1e-6, 1e-8, 1e-10):
        yield Peer(
            "CVODE BDF, bristle as state",
            f"tol {tolerance:.0e}",
            tolerance,
            partial(_cvode, tolerance=tolerance),
            missing={**NO_EVENTS, **NOT_SHOT},
        )


def _at(family: str, tolerance: float, simulate: Simulate, *, located: bool = True) -> Peer:
    setting, shooting = f"tol {tolerance:.0e}", max(1e-9, tolerance)
    return _trajectory(
        family, setting, simulate, tolerance=tolerance, shooting=shooting, located=located
    )


def _averaged() -> Peer:
    def follow(device: Device, held: Sequence[HeldInputs], times: Array) -> Motion:
        run = simulate_averaged(device, held, times)
        return Motion(times, run.position, run.velocity, run.mean_velocity)

    missing = {"event_times": "averaged motion has no events", **NOT_SHOT}
    return Peer("averaged equation, scipy", "", None, follow, missing=missing)


def _cvode(device: Device, held: Sequence[HeldInputs], times: Array, *, tolerance: float) -> Motion:
    inputs = _single(held)
    return _sliding_motion(
        simulate_lugre_cvode(device, inputs, tolerance=tolerance, times=times), times
    )


def _sliding(
    family: str, bristle: Literal["path", "state"], first: Simulate, tolerance: float
) -> Peer:
    """Return heyoka in one call; it starts from where `first` is after one drive period."""

    def follow(device: Device, held: Sequence[HeldInputs], times: Array) -> Motion:
        inputs = _single(held)
        begin = min(2.0 * np.pi / device.drive_frequency, inputs.stop)
        early = times[times <= begin]
        began = process_time()
        start = first(device, [replace(inputs, stop=begin)], np.append(early, begin))
        started = process_time() - began
        if begin == inputs.stop:
            return replace(
                motion_of(start, located=False),
                times=early,
                position=start.position[:-1],
                velocity=start.velocity[:-1],
            )
        if start.contact_mode[-1] == 0:
            raise ValueError("the slider sticks after a drive period, which it does not cover")
        moving = replace(
            device,
            initial_position=float(start.position[-1]),
            initial_velocity=float(start.velocity[-1]),
            initial_resonator_displacement=float(start.resonator_displacement[-1]),
            initial_resonator_velocity=float(start.resonator_velocity[-1]),
            initial_bristle_deflection=float(getattr(start, "bristle_deflection", [0.0])[-1]),
        )
        later = times[times > begin]
        end = simulate_sliding(
            moving, inputs, tolerance=tolerance, bristle=bristle, begin=begin, times=later
        )
        rest = _sliding_motion(end, later)
        return replace(
            rest,
            times=times,
            position=np.concatenate([start.position[:-1], rest.position]),
            velocity=np.concatenate([start.velocity[:-1], rest.velocity]),
            start_cpu=started,
        )

    missing = {"event_times": "it does not tell when it reverses", **NOT_SHOT}
    setting = f"tol {tolerance:.0e}"
    return Peer(family, setting, tolerance, follow, sticks_not=True, missing=missing)


def _single(held: Sequence[HeldInputs]) -> HeldInputs:
    if len(held) != 1:
        raise ValueError("inputs vary, which it does not cover")
    return held[0]


def _sliding_motion(end: SlidingEnd, times: Array) -> Motion:
    return Motion(
        times,
        end.samples[:, 0],
        end.samples[:, 1],
        steps=end.steps or None,
        evaluations=end.evaluations or None,
        events=end.reversals or None,
    )
