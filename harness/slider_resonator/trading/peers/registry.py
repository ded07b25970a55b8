"""The peers: methods that a user might take instead of the FMU, setting by setting."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial

from slider_resonator.arrays import Array
from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.averaged.averaged_motion import simulate_averaged
from slider_resonator.references.closed_forms import equivalent_force
from slider_resonator.references.resolved.simulate import simulate as simulate_series
from slider_resonator.references.resolved.trajectory import Trajectory
from slider_resonator.steady.reference_steady import Simulate
from slider_resonator.trading.peers import event_free, located_scipy, moreau_jean
from slider_resonator.trading.peers.peer import NO_EVENTS, NOT_SHOT, Peer, solution_of
from slider_resonator.trading.peers.switching_taylor import heyoka_in_one_call
from slider_resonator.trading.problem import Problem
from slider_resonator.trading.solution import Solution

MAX_EVALUATIONS = 1_000_000
"""Maximum evaluations of a method on sgn: one that chatters is stopped early."""


def peers(problem: Problem) -> list[Peer]:
    """Return the peers for the friction law of a problem."""
    return [*(_lugre() if problem.device.friction_law == 1 else _coulomb()), _averaged()]


def _coulomb() -> Iterator[Peer]:
    for tolerance in (1e-3, 1e-6, 1e-9, 1e-12):
        yield heyoka_in_one_call("heyoka at its fastest", tolerance)
    yield _series()
    for method, tolerances in (
        ("DOP853", (1e-3, 1e-5, 1e-8, 1e-11)),
        ("LSODA", (1e-5, 1e-8)),
        ("Radau", (1e-3, 1e-5)),
    ):
        for tolerance in tolerances:
            simulate: Simulate = partial(
                located_scipy.simulate,
                method=method,
                rtol=tolerance,
                atol=1e-2 * tolerance,
                steps_per_period=4,
            )
            yield _at(f"{method} with located events", tolerance, simulate)
    for atol in (1e-4, 1e-6, 1e-8, 1e-10):
        simulate = partial(event_free.simulate_sgn, atol=atol, max_evaluations=MAX_EVALUATIONS)
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
    for share in (1e-1, 1e-2, 1e-3, 1e-4):
        simulate = partial(_regularised, share=share)
        setting = f"width {share:g} of the fast velocity"
        yield _trajectory("tanh, LSODA", setting, simulate, shooting=1e-6, located=False)


def _lugre() -> Iterator[Peer]:
    yield _series()
    for tolerance in (1e-3, 1e-6, 1e-9, 1e-12):
        family = "heyoka at its fastest, bristle from path"
        yield heyoka_in_one_call(family, tolerance)
    for method, tolerances in (
        ("LSODA", (1e-4, 1e-6, 1e-8, 1e-10)),
        ("Radau", (1e-4, 1e-6)),
        ("DOP853", (1e-6, 1e-9)),
    ):
        for tolerance in tolerances:
            simulate: Simulate = partial(
                event_free.simulate_bristle, method=method, rtol=tolerance, atol=1e-2 * tolerance
            )
            family = f"{method}, bristle as state"
            yield _at(family, tolerance, simulate, located=False)


def _series() -> Peer:
    return _trajectory("Taylor series in Python", "", simulate_series, shooting=1e-9, located=True)


def _regularised(
    device: Device, held: Sequence[HeldInputs], times: Array, *, share: float
) -> Trajectory:
    """Return the motion with a width of tanh that is a share of the fast velocity.

    Raises ValueError where there is no steady vibration, besides what `simulate_tanh` raises.
    """
    width = share * equivalent_force(device).velocity_amplitude
    return event_free.simulate_tanh(device, held, times, width=width, rtol=1e-7, atol=1e-9)


def _at(family: str, tolerance: float, simulate: Simulate, *, located: bool = True) -> Peer:
    setting, shooting = f"tol {tolerance:.0e}", max(1e-9, tolerance)
    return _trajectory(
        family, setting, simulate, tolerance=tolerance, shooting=shooting, located=located
    )


def _averaged() -> Peer:
    def follow(device: Device, held: Sequence[HeldInputs], times: Array) -> Solution:
        run = simulate_averaged(device, held, times)
        return Solution(times, run.position, run.velocity, run.mean_velocity)

    missing = {"event_times": "averaged motion has no events", **NOT_SHOT}
    return Peer("averaged equation, scipy", "", None, follow, missing=missing)


def _trajectory(
    family: str,
    setting: str,
    simulate: Simulate,
    *,
    tolerance: float | None = None,
    shooting: float,
    located: bool,
) -> Peer:
    def follow(device: Device, held: Sequence[HeldInputs], times: Array) -> Solution:
        return solution_of(simulate(device, held, times), located=located)

    missing = {} if located else NO_EVENTS
    return Peer(family, setting, tolerance, follow, simulate, shooting, missing=missing)
