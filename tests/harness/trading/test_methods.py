"""The problem that every method solves, errors of solutions, and methods measured."""

from collections.abc import Callable
from dataclasses import replace
from math import inf, nan, pi

import numpy as np
import pytest

from slider_resonator.fmu.instance import Instance
from slider_resonator.output.progress import no_progress
from slider_resonator.references.resolved.simulate import simulate
from slider_resonator.trading import measure
from slider_resonator.trading.fmu_methods import FmuMethods
from slider_resonator.trading.measure import find_reference, measure_trade
from slider_resonator.trading.peer_methods import shoot
from slider_resonator.trading.problem import MIN_PERIODS, Method, Problem, Solution
from slider_resonator.trading.result import PEER, Row
from tests.harness.in_process import InProcess
from tests.harness.trading.problems import (
    BEAT,
    RAMP,
    SCAN,
    STICKING,
    TABLE_1,
    problem,
    reference_of,
)


def followed(problem: Problem, method: Method) -> dict[str, float]:
    _, solution = method.run(problem.periods)
    return problem.errors(solution, reference_of(problem), problem.periods)


def pick(
    problem: Problem, instance: Instance, fidelity: int, step: float, *, interpolates: bool = True
) -> Method:
    methods = FmuMethods(problem, "native", InProcess(instance))
    methods.interpolates = interpolates
    return next(
        method
        for method in methods.methods()
        if (method.row.fidelity, method.row.step) == (fidelity, step)
        and "instead" not in method.row.method
    )


def test_a_ramp_that_is_passed_on_costs_nothing(instance: Instance) -> None:
    ramp = problem(RAMP)
    found = followed(ramp, pick(ramp, instance, 2, 10.0))
    assert max(found.values()) < 1e-11, f"steps of 10 periods: {found}"


def test_held_ramp_is_of_order_1(instance: Instance) -> None:
    ramp = problem(RAMP)
    steps = np.array([0.01, 0.1, 1.0])
    held = [pick(ramp, instance, 2, step, interpolates=False) for step in steps]
    wrong = [followed(ramp, method)["slow_displacement"] for method in held]
    order = np.polyfit(np.log(steps), np.log(wrong), 1)[0]
    assert order == pytest.approx(1.0, abs=0.15), f"inputs lag half a step: {wrong}"


@pytest.mark.parametrize("law", [0, 1])
def test_a_drive_that_changes_costs_nothing(instance: Instance, law: int) -> None:
    scan = problem(f"{SCAN}[device]\nfriction_law = {law}\nbristle_stiffness = 1e4\n")
    for step in (0.1, 10.0):
        found = followed(scan, pick(scan, instance, 2, step))
        allowed = 1e-7 if law else 1e-10
        assert max(found.values()) < allowed, f"steps of {step:g} periods: {found}"


def test_answers_are_those_of_the_commands(instance: Instance) -> None:
    answers = list(FmuMethods(problem(TABLE_1), "native", InProcess(instance)).answers())
    found = {(a.row.method, a.row.answer): a.find(inf).value for a in answers}
    assert found["native FMU, fidelity 2", "steady_velocity"] == pytest.approx(0.126667, rel=1e-6)
    assert found["native FMU, fidelity 2", "blocking_force"] == pytest.approx(0.0851861, rel=1e-6)
    first, second = (
        found[f"native FMU, output steady_velocity, order {order}", "steady_velocity"]
        for order in (1, 2)
    )
    assert first == pytest.approx(0.126731, rel=1e-5)
    assert second == pytest.approx(0.12666699702, rel=1e-9)


def made_up(
    name: str, follow: Callable[[int], Solution], cost: float = 0.0, **fields: bool
) -> Method:
    def run(periods: int) -> tuple[float, Solution]:
        return cost * periods, follow(periods)

    def seconds(periods: int) -> float:
        run(periods)
        return 1e-3 * periods

    return Method(Row(PEER, name, name, 0), run, seconds, **fields)  # type: ignore[arg-type]


def only(monkeypatch: pytest.MonkeyPatch, *methods: Method) -> None:
    monkeypatch.setattr(measure, "peer_methods", lambda problem: list(methods))


def still(problem: Problem) -> Callable[[int], Solution]:
    def run(periods: int) -> Solution:
        times = problem.readings(periods)
        return Solution(times, 0.0 * times, 0.0 * times)

    return run


def test_a_failing_method_is_omitted_with_the_reason(monkeypatch: pytest.MonkeyPatch) -> None:
    short = problem(TABLE_1, max_periods=4)

    def fails(periods: int) -> Solution:
        raise RuntimeError("the solver gives up")

    only(monkeypatch, made_up("failing", fails), made_up("standing", still(short)))
    trade = measure_trade(short, {}, no_progress, repeats=3)
    (row,) = trade.rows
    assert row.method == "standing"
    assert row.cpu == pytest.approx((1e-3 / short.period,) * 3), "per simulated second"
    assert row.errors["position"] == pytest.approx(1.0), "it misses the whole motion"
    reported = {(o.method, o.quantity): o.reason for o in trade.omissions}
    assert reported["failing", "all"] == "the solver gives up"


def test_a_method_stops_where_its_budget_ends(monkeypatch: pytest.MonkeyPatch) -> None:
    longer = problem(TABLE_1, max_periods=64)
    slow = made_up("slow", still(longer), 0.1)
    only(monkeypatch, slow, made_up("far too slow", still(longer), 10.0))
    trade = measure_trade(longer, {}, no_progress, repeats=5, budget=1.0)
    (row,) = trade.rows
    assert row.periods == 8, "8 periods take 0.8 s, 16 would take 1.6 s of the 1 s"
    assert len(row.cpu) == 1, "nor are there repeats beyond the budget"
    reported = {(o.method, o.quantity): o.reason for o in trade.omissions}
    assert "followed over 8 of 64 drive periods" in reported["slow", "length"]
    assert "more than its budget of 1 s" in reported["far too slow", "all"]


def test_method_that_cannot_stick_is_omitted(monkeypatch: pytest.MonkeyPatch) -> None:
    sticking = problem(STICKING, max_periods=4)
    only(monkeypatch, made_up("sliding", still(sticking), cannot_stick=True))
    trade = measure_trade(sticking, {}, no_progress, repeats=1)
    assert [(o.method, o.quantity) for o in trade.omissions] == [("sliding", "all")]
    assert "sticks" in trade.omissions[0].reason


PERIOD = 2.0 * pi / 3500.0


def test_a_scene_without_a_run_is_as_long_as_the_longest_step() -> None:
    found = problem(TABLE_1)
    assert found.periods == MIN_PERIODS == 1000
    assert found.horizons == (31, 62, 125, 250, 500, 1000)
    assert found.constant
    assert found.steady
    assert found.beat is None


def test_the_full_device_is_the_reference_whatever_the_scene_asks_for() -> None:
    found = problem("[device]\nfidelity = 0\nfriction_law = 1\ntolerance = 1e-3\n")
    assert (found.device.fidelity, found.device.friction_law) == (2, 1)
    assert found.parameters == {}, "fidelity, law and tolerance are for the methods to set"


def test_inputs_that_vary_allow_no_steady_motion() -> None:
    found = problem(RAMP)
    assert not found.constant
    assert not found.steady
    assert found.periods == 16, "the scene sets the duration of its inputs"


def test_a_drive_that_changes_is_held_over_the_steps_of_the_scene() -> None:
    found = problem(SCAN)
    assert not found.constant
    drives = [found.device.tuned(inputs.tuned) for inputs in found.lines(16)]
    assert [drives[i].base_amplitude for i in (0, 10, -1)] == pytest.approx([1e-4, 0.0, 1.5e-4])
    ramp = np.arange(5) * PERIOD / 2.0 / 0.02 * 0.2 - 0.1
    rates = [drive.drive_frequency for drive in drives[:5]]
    assert rates == pytest.approx(3500.0 * (1.0 + ramp)), "whatever the step of a method"


def test_a_window_is_a_period_of_the_drive_as_it_is() -> None:
    found = problem(SCAN)
    assert found.periods == 16
    lines = found.lines(16)
    times = np.array([0.0, *(inputs.stop for inputs in lines)])
    rates = [found.device.tuned(inputs.tuned).drive_frequency / (2.0 * pi) for inputs in lines]
    turned = np.append(0.0, np.cumsum(rates * np.diff(times)))
    ends = np.interp(np.arange(17), turned, times)
    assert found.ends(16) == pytest.approx(ends, rel=1e-12)
    assert found.windows(8)[-1, [0, -1]] == pytest.approx(ends[7:9], rel=1e-12)


def test_table_1_by_a_run_and_by_shooting() -> None:
    reference = find_reference(problem(TABLE_1, max_periods=2))
    assert reference.answers["steady_velocity"] == pytest.approx(0.12666700, rel=1e-7)
    assert reference.answers["blocking_force"] == pytest.approx(0.0851861, rel=1e-6)
    assert not reference.sticks, "reversals follow each other without a stick"


def test_any_integrator_can_be_shot_with() -> None:
    table_1 = problem(TABLE_1)
    found = shoot(table_1, "steady_velocity", simulate, 1e-9, inf)
    assert found.value == pytest.approx(0.12666700, rel=1e-7)
    assert 30 <= found.periods <= 100, "a long run needs thousands"
    with pytest.raises(RuntimeError, match="more than its budget of 0 s"):
        shoot(table_1, "steady_velocity", simulate, 1e-9, 0.0)


@pytest.fixture
def short() -> Problem:
    return problem(TABLE_1, max_periods=4)


def drifting(problem: Problem) -> Solution:
    times = problem.readings(4)
    wave = np.sin(problem.device.drive_frequency * times)
    return Solution(times, 2.0 * times + 1e-6 * wave, 2.0 + 0.5 * wave, last_event=0.9 * times)


def test_each_error_is_a_share_of_the_peak(short: Problem) -> None:
    solution = drifting(short)
    assert solution.last_event is not None
    reference = short.read(solution, 4)
    late = replace(
        solution,
        position=1.01 * solution.position,
        velocity=solution.velocity + 0.025,
        last_event=solution.last_event + 1e-3 * short.period,
    )
    found = short.errors(late, reference, 4)
    for name in ("position", "mean_velocity", "slow_displacement"):
        assert found[name] == pytest.approx(0.01), name
    assert found["velocity"] == pytest.approx(0.01)
    assert found["event_times"] == pytest.approx(1e-3), "in drive periods"


def test_short_runs_and_nan_have_errors(short: Problem) -> None:
    solution = drifting(short)
    early = solution.times <= 2.0001 * short.period
    half = Solution(solution.times[early], solution.position[early], solution.velocity[early])
    found = short.errors(half, short.read(solution, 4), 2)
    assert found["position"] == 0.0
    assert "event_times" not in found, "a method that locates no events has no error of them"
    broken = replace(solution, velocity=np.full_like(solution.velocity, nan))
    assert short.errors(broken, short.read(solution, 4), 4)["velocity"] == inf


@pytest.mark.parametrize(("step", "reported"), [(1, True), (7, True), (10, False), (100, False)])
def test_a_beat_needs_enough_samples(step: int, reported: bool) -> None:
    beating = problem(BEAT)
    assert beating.beat is not None
    ends = beating.ends(1600)[::step]
    history = (ends, np.sin(2.0 * np.pi * 1.001 * beating.beat * ends))
    times = beating.readings(1600)
    solution = Solution(times, times, np.ones_like(times), history=history)
    found = beating.errors(solution, beating.read(solution, 1600), 1600)
    assert ("beat_frequency" in found) == reported, "twenty periods are a beat"
    early = replace(solution, history=(history[0][:1], history[1][:1]))
    assert "beat_frequency" not in beating.errors(early, beating.read(solution, 1600), 1600)
    if reported:
        assert found["beat_frequency"] == pytest.approx(1e-3, rel=1e-3)
