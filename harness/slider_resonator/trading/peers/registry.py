"""The peers: methods that a user might take instead of the FMU, setting by setting."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial

from scipy.integrate import DOP853

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
SHOOTING = 1e-6
"""Accuracy of shooting, in units of the state, with methods that lose their order at reversals."""


def peers(problem: Problem) -> list[Peer]:
    """Return the peers for the friction law of a problem."""
    exact = _peer("Taylor series in Python", "", simulate_series, shooting=1e-9, located=True)
    own = _lugre() if problem.device.friction_law == 1 else _coulomb()
    missing = {"event_times": "averaged motion has no events", **NOT_SHOT}
    averaged = Peer("averaged equation, scipy", "", None, _averaged, missing=missing)
    return [exact, *own, averaged]


def _coulomb() -> Iterator[Peer]:
    for tolerance in (1e-3, 1e-6, 1e-9, 1e-12):
        yield heyoka_in_one_call("heyoka at its fastest", tolerance)
    for tolerance in (1e-3, 1e-5, 1e-8, 1e-11):
        located = partial(
            located_scipy.simulate, rtol=tolerance, atol=1e-2 * tolerance, steps_per_period=4
        )
        family, setting = "DOP853 with located events", f"tol {tolerance:.0e}"
        yield _peer(family, setting, located, tolerance, max(1e-9, tolerance), located=True)
    for atol in (1e-4, 1e-6, 1e-8, 1e-10):
        sgn = partial(
            event_free.simulate,
            method=DOP853,
            rtol=1e-6,
            atol=atol,
            max_evaluations=MAX_EVALUATIONS,
        )
        yield _peer("DOP853 on sgn (the paper)", f"rtol 1e-06, atol {atol:.0e}", sgn, atol)
    for count in (16, 64, 256, 1024):
        stepping = partial(moreau_jean.simulate, steps_per_period=count)
        yield _peer("Moreau-Jean", f"{count} steps a period", stepping)
    for share in (1e-1, 1e-2, 1e-3, 1e-4):
        setting = f"width {share:g} of the fast velocity"
        yield _peer("tanh, LSODA", setting, partial(_regularised, share=share))


def _lugre() -> Iterator[Peer]:
    for tolerance in (1e-3, 1e-6, 1e-9, 1e-12):
        yield heyoka_in_one_call("heyoka at its fastest, bristle from path", tolerance)
    for tolerance in (1e-4, 1e-6, 1e-8, 1e-10):
        bristle = partial(event_free.simulate, rtol=tolerance, atol=1e-2 * tolerance)
        family, setting = "LSODA, bristle as state", f"tol {tolerance:.0e}"
        yield _peer(family, setting, bristle, tolerance, max(1e-9, tolerance))


def _peer(
    family: str,
    setting: str,
    simulate: Simulate,
    tolerance: float | None = None,
    shooting: float = SHOOTING,
    *,
    located: bool = False,
) -> Peer:
    def follow(device: Device, held: Sequence[HeldInputs], times: Array) -> Solution:
        return solution_of(simulate(device, held, times), located=located)

    missing = {} if located else NO_EVENTS
    return Peer(family, setting, tolerance, follow, simulate, shooting, missing=missing)


def _regularised(
    device: Device, held: Sequence[HeldInputs], times: Array, *, share: float
) -> Trajectory:
    """Return the motion with a width of tanh that is a share of the fast velocity.

    Raises ValueError where there is no steady vibration, besides what `simulate` raises.
    """
    width = share * equivalent_force(device).velocity_amplitude
    return event_free.simulate(device, held, times, width=width, rtol=1e-7, atol=1e-9)


def _averaged(device: Device, held: Sequence[HeldInputs], times: Array) -> Solution:
    run = simulate_averaged(device, held, times)
    return Solution(times, run.position, run.velocity, run.mean_velocity)
