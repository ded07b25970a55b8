"""Our FMUs as methods: every fidelity, friction law, communication step and tolerance."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from math import ceil
from operator import attrgetter
from time import process_time

import numpy as np

from slider_resonator.device.model import LUGRE, Model
from slider_resonator.device.schedule import Schedule
from slider_resonator.fmu.instance import Instance
from slider_resonator.fmu.isolation.process import IsolatedFmu
from slider_resonator.fmu.run import Record, run
from slider_resonator.steady.searches import SEARCHES, SteadyAnswer
from slider_resonator.trading.problem import Method, Problem, Solution, SteadyMethod
from slider_resonator.trading.result import AVERAGED, RESOLVED, Row

STEPS = (0.01, 0.1, 1.0, 10.0, 100.0, 1000.0)
"""Communication steps in drive periods."""
USUAL_STEP = 10.0
"""The step for other tolerances and for the other friction law."""
TOLERANCES = (1e-4, 1e-6, 1e-10, 1e-12)
"""Of LuGre friction, besides the one that the FMU starts with."""
USUAL_TOLERANCE = 1e-8
LEAP_TOLERANCES = (1e-5, 1e-6, 1e-7)
"""Of motion that leaps, besides the usual one."""
OUTPUTS = ("position", "velocity", "mean_velocity")


class FmuMethods:
    """The methods of an FMU on a problem; `build` is its name, such as `native`."""

    def __init__(self, problem: Problem, build: str, fmu: IsolatedFmu) -> None:
        self.problem = problem
        self.build = build
        self.fmu = fmu
        self.interpolates: bool = fmu.run(attrgetter("fmu.interpolates"))
        has_orders = fmu.run(attrgetter("fmu.has_orders"))
        self.orders: tuple[int | None, ...] = (2, 1) if has_orders else (None,)
        own = problem.device.friction_law
        self.models = [Model(2, own), Model(1, own), *(Model(0, own, n) for n in self.orders)]

    def _run(
        self, values: Mapping[str, float], schedule: Schedule, outputs: Sequence[str] = OUTPUTS
    ) -> Record:
        task = partial(run, parameters=values, schedule=schedule, outputs=outputs)
        record: Record = self.fmu.run(task)
        return record

    def check_runs(self) -> None:
        """Raise what the FMU raises in a drive period of the scene, at the model it starts with."""
        period = self.problem.schedule(1, self.problem.period, interpolates=self.interpolates)
        self._run(self.problem.parameters, period)

    def methods(self) -> Iterator[Method]:
        """Yield every setting; the other friction law as a model of the same device."""
        own = self.problem.device.friction_law
        for model in self.models:
            for step in STEPS:
                yield self._method(model, step, USUAL_TOLERANCE)
            yield self._method(replace(model, friction_law=1 - own), USUAL_STEP, USUAL_TOLERANCE)
            for tolerance in TOLERANCES if own == LUGRE and model.fidelity else ():
                yield self._method(model, USUAL_STEP, tolerance)
            for tolerance in LEAP_TOLERANCES if model.leaps else ():
                yield self._method(model, 1000.0, tolerance)

    def answers(self) -> Iterator[SteadyMethod]:
        """Yield the searches for steady motion and blocking force, and the outputs of theory."""
        for quantity in SEARCHES:
            for model in self.models:
                yield self._search(quantity, model)
            for order in self.orders:
                yield self._prediction(quantity, order)

    def _values(self, model: Model, tolerance: float) -> dict[str, float]:
        return {**self.problem.parameters, **model.parameters, "tolerance": tolerance}

    def _row(self, model: Model, tolerance: float, step: float | None) -> Row:
        family = f"{self.build} FMU, {model.resolution}"
        if model.friction_law != self.problem.device.friction_law:
            family += f", {model.law} instead"
        name = family
        if step is not None:
            name += f", steps of {step:g} period{'s' if step != 1.0 else ''}"
        used = tolerance if model.friction_law == LUGRE or model.leaps else None
        if used not in (None, USUAL_TOLERANCE):
            name += f", tol {used:.0e}"
        kind = RESOLVED if model.fidelity else AVERAGED
        about = (model.friction_law, model.fidelity, step, used, model.averaging_order)
        return Row(kind, family, name, *about)

    def _method(self, model: Model, step: float, tolerance: float) -> Method:
        values, resolved = self._values(model, tolerance), model.fidelity > 0
        size = step * self.problem.period

        def follow(periods: int) -> tuple[float, Solution]:
            own = self.problem.schedule(periods, size, interpolates=self.interpolates)
            closest = 1e-9 * min(size, self.problem.period)
            schedule = own.read_at(self.problem.readings(periods), closest)
            record = self._run(values, schedule, (*OUTPUTS, "last_event_time", "reversals"))
            at = np.searchsorted(record.times, own.times)
            return record.start_cpu + record.step_cpu, Solution(
                times=record.times,
                position=record["position"],
                velocity=record["velocity"],
                mean_velocity=record["mean_velocity"],
                last_event=record["last_event_time"] if resolved else None,
                history=(own.times, record["mean_velocity"][at]),
                steps=len(own.times) - 1,
                events=round(record.final("reversals")) if resolved else None,
                start_cpu=record.start_cpu,
            )

        def seconds(periods: int) -> float:
            schedule = self.problem.schedule(periods, size, interpolates=self.interpolates)
            taken: list[float] = []
            while not taken or (sum(taken) < 2e-3 and len(taken) < 20):  # short runs scatter
                taken.append(self._run(values, schedule).step_cpu)
            return sum(taken) / len(taken)

        missing = {} if resolved else {"event_times": "averages and leaps locate no events"}
        row = self._row(model, tolerance, step)
        return Method(row, follow, seconds, min_periods=ceil(step), missing=missing)

    def _search(self, quantity: str, model: Model) -> SteadyMethod:
        row = replace(self._row(model, USUAL_TOLERANCE, None), answer=quantity)
        return self._steady(row, model, _searched)

    def _prediction(self, quantity: str, order: int | None) -> SteadyMethod:
        """Return the value of an output that predicts, at the start of a run at fidelity 2."""
        model = replace(self.models[0], averaging_order=order)
        family = f"{self.build} FMU, output {quantity}" + (f", order {order}" if order else "")
        law = model.friction_law
        row = Row(AVERAGED, family, family, law, averaging_order=order, answer=quantity)
        return self._steady(row, model, _predicted)

    def _steady(self, row: Row, model: Model, find: Callable[..., SteadyAnswer]) -> SteadyMethod:
        values = {**self._values(model, USUAL_TOLERANCE), **self.problem.inputs}
        task = partial(find, values=values, quantity=row.answer)
        return SteadyMethod(row, lambda _: self.fmu.run(task))


def _searched(instance: Instance, values: Mapping[str, float], quantity: str) -> SteadyAnswer:
    began = process_time()
    found = SEARCHES[quantity](instance, values)
    return SteadyAnswer(process_time() - began, found.value, found.reason, found.periods)


def _predicted(instance: Instance, values: Mapping[str, float], quantity: str) -> SteadyAnswer:
    began = process_time()
    instance.start(values)
    value = instance.value(quantity)
    return SteadyAnswer(process_time() - began, value)
