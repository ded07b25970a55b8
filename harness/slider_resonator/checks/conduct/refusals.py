"""Values and calls that an FMU must refuse, by name and without a trace in its run."""

import math
import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from functools import partial

from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Slave, fmi2Discard, fmi2Fatal

from slider_resonator.arrays import is_same
from slider_resonator.checks.conduct.findings import SMOOTH, UNKNOWN, is_refused, other_value
from slider_resonator.checks.conduct.output_derivatives import status_faults
from slider_resonator.checks.conduct.replays import Replay, Rows
from slider_resonator.checks.fmu_side import FmuSide
from slider_resonator.device.interface import VARIABLES
from slider_resonator.device.variable import Variable
from slider_resonator.fmu.instance import Instance, SavedState
from slider_resonator.fmu.run import Running

STEP = 1.7e-3
"""Size of a good step, s."""

_LIFECYCLE: Mapping[str, Callable[[Instance], object]] = {
    "fmi2SetupExperiment": lambda i: i.call("fmi2SetupExperiment", False, 0.0, 0.0, False, 0.0),
    "fmi2EnterInitializationMode": lambda i: i.call("fmi2EnterInitializationMode"),
    "fmi2ExitInitializationMode": lambda i: i.call("fmi2ExitInitializationMode"),
    "fmi2DoStep": lambda i: i.call("fmi2DoStep", i.time, STEP, True),
    "fmi2Terminate": lambda i: i.call("fmi2Terminate"),
    "setting load": lambda i: i.set({"load": 0.1}),
    "reading position": lambda i: i.value("position"),
}
"""Calls that belong to some state of an instance."""

OUT_OF_ORDER: Mapping[str, tuple[str, ...]] = {
    "before a run": ("fmi2ExitInitializationMode", "fmi2DoStep", "reading position"),
    "in initialisation mode": ("fmi2SetupExperiment", "fmi2EnterInitializationMode", "fmi2DoStep"),
    "in a run": (
        "fmi2SetupExperiment",
        "fmi2EnterInitializationMode",
        "fmi2ExitInitializationMode",
    ),
    "after a run": tuple(name for name in _LIFECYCLE if name != "reading position"),
}
"""Calls that must be refused, by the state of the instance."""

EXPERIMENTS: Mapping[str, tuple[object, ...]] = {
    **{f"a start time of {bad}": (False, 0.0, bad, False, 0.0) for bad in (math.nan, math.inf)},
    **{f"a stop time of {bad}": (False, 0.0, 5.0, True, bad) for bad in (math.nan, 4.0)},
    **{f"a tolerance of {bad}": (True, bad, 5.0, False, 0.0) for bad in (math.nan, 0.0, -1e-6)},
}
"""Experiments, as arguments of fmi2SetupExperiment, that must be refused."""

NOT_FINITE = (math.nan, math.inf, -math.inf)
ENDING = {fmi2Discard: "Discard", fmi2Fatal: "Fatal"}
"""Statuses of a refusal that end more than a call; the same numbers in each version of FMI."""
_NUMBER = re.compile(r"[-+]?(?:\bnan\b|\binf\b|\d+\.?\d*(?:e[-+]?\d+)?)", re.IGNORECASE)


class Trial:
    """Calls that must be refused, and the `faults` that were found.

    No call may change the variables that are `watched`.
    """

    def __init__(self, instance: Instance) -> None:
        self.instance = instance
        self.faults: list[str] = []
        self.watched: Sequence[str] = ()
        variables = instance.fmu.variables
        self.present = [v for name, v in VARIABLES.items() if name in variables]
        self.settable = [v for v in self.present if v.causality != "output"]

    def watch(self, *outputs: str) -> None:
        """Watch what can be set, and these outputs."""
        self.watched = [*(v.name for v in self.settable), *outputs]

    def refuses(
        self,
        what: str,
        attempt: Callable[[], object],
        names: Sequence[str] = (),
        values: Sequence[float] = (),
    ) -> None:
        """Make a call; it must fail and change nothing.

        The log must have one of the `names` and all `values`.
        """
        before = self._values()
        # pythonfmu makes each refusal Fatal.
        ending = ENDING if self.instance.fmu.runs_without_python else (fmi2Discard,)
        del self.instance.messages[:]
        try:
            attempt()
        except FMICallException as error:
            if error.status in ending:
                status = f"{str(error.function)[: len('fmi2')]}{ENDING[error.status]}"
                self.faults.append(f"{what} gives {status}, at which hosts end a run")
            log = " ".join(self.instance.messages)
            if "\ufffd" in log:
                self.faults.append(f"{what} is refused with a message that is not UTF-8")
            if names and not any(name in log for name in names):
                self.faults.append(f"{what} is refused without naming {' or '.join(names)}")
            self.faults += [
                f"{what} is refused without a message that has {value!r}"
                for value in values
                if not shows(log, value)
            ]
            after = self._values()
            changed = {n for n, value in after.items() if value != before[n]}
            if changed:
                self.faults.append(f"{what} is refused but changes {', '.join(sorted(changed))}")
        else:
            self.faults.append(f"{what} is accepted")

    def _values(self) -> Mapping[str, float]:
        return self.instance.read(self.watched) if self.watched else {}

    def _refuses_value(
        self, when: str, variable: Variable, value: float, told: Sequence[float] = ()
    ) -> None:
        """Set a variable; the log must have its name, and the value with what else is told."""
        what = f"{variable.name} = {value!r} {when}"
        # An FMU may make a tolerance smaller for itself, so that a message has another value.
        values = [] if variable.name == "tolerance" else [value, *told]
        self.refuses(what, partial(self._set, {variable: value}), [variable.name], values)

    def refuses_values(self, when: str, variables: Sequence[Variable]) -> None:
        """Set what lies outside the bounds of variables, alone and after a good value."""
        for variable in variables:
            bounds = [b for b in (variable.minimum, variable.maximum) if b is not None]
            for bad in bad_values(variable):
                nearest = sorted(bounds, key=lambda bound: abs(bound - bad))[:1]
                self._refuses_value(when, variable, bad, nearest if math.isfinite(bad) else ())
        for kind in ("Real", "Integer"):
            alike = [v for v in variables if v.kind == kind]
            for some in (alike[:2], alike):
                if len(some) > 1:
                    self._refuses_the_last(when, some)

    def _refuses_the_last(self, when: str, variables: Sequence[Variable]) -> None:
        """Set good values in one call, of which the last is bad or for no variable to be set."""
        *others, last = variables
        good = {v: other_value(v.name) for v in others}
        bad = bad_values(last)[0]
        for where, both in (("after", {**good, last: bad}), ("before", {last: bad, **good})):
            what = f"{last.name} = {bad!r} {where} {len(others)} good values {when}"
            self.refuses(what, partial(self._set, both), [last.name])
        references = [self.instance.fmu.reference(v.name) for v in others]
        wrongs = {"an unknown variable": UNKNOWN}
        if last.kind == "Real":
            wrongs["an output"] = self.instance.fmu.reference("position")
        for name, wrong in wrongs.items():
            what = f"{name} after {len(others)} good values {when}"
            values = [*good.values(), 0.5]
            self.refuses(what, partial(self._write, last.kind, [*references, wrong], values))

    def refuses_all(self, when: str, variables: Iterable[Variable]) -> None:
        """Set variables, which must not be set at all, to other values."""
        for variable in variables:
            value = 0.5 if variable.start is None else other_value(variable.name)
            self._refuses_value(when, variable, value)

    def refuses_calls(self, when: str) -> None:
        """Make the calls that are out of order."""
        version = self.instance.fmu.version
        for name in OUT_OF_ORDER[when]:
            # Experiments of FMI 3.0 begin with initialisation mode, without a call before.
            if version == "2.0" or name != "fmi2SetupExperiment":
                what = f"{name.replace('fmi2', f'fmi{version[0]}')} {when}"
                self.refuses(what, partial(_LIFECYCLE[name], self.instance))

    def refuses_derivatives(self) -> None:
        """Set derivatives that are not finite, of another order or of what is no input."""
        derive = self.instance.slave.setRealInputDerivatives
        for variable in self.present:
            if variable.kind != "Real":
                continue
            name, reference = variable.name, self.instance.fmu.reference(variable.name)
            if variable.causality != "input":
                one = partial(derive, [reference], [1], [0.1])
                self.refuses(f"a derivative of {name}", one, [name])
                continue
            wrong = [(f"= {bad!r}", 1, bad, bad) for bad in NOT_FINITE]
            wrong += [(f"of order {order}", order, 0.1, order) for order in (0, 2, -1)]
            for what, order, value, told in wrong:
                one = partial(derive, [reference], [order], [value])
                self.refuses(f"a derivative of {name} {what}", one, [name], [told])
        load, phase = (self.instance.fmu.reference(name) for name in ("load", "phase"))
        for what, second, order, value in (
            ("phase = nan", phase, 1, math.nan),
            ("phase of order 2", phase, 2, 0.1),
            ("an unknown variable", UNKNOWN, 1, 0.1),
        ):
            both = partial(derive, [load, second], [1, order], [7.0, value])
            self.refuses(f"a derivative of {what} after one of load", both)

    def refuses_types(self) -> None:
        """Read and set variables, of which one is unknown, by the functions of other types."""
        slave = self.instance.slave
        good: dict[str, float | str] = {"Real": 0.5, "Integer": 1}
        if isinstance(slave, FMU2Slave):
            good |= {"Boolean": True, "String": "1"}
        references = {v.name: self.instance.fmu.reference(v.name) for v in self.present}
        # A reference belongs to one variable of each type.
        valid = {(v.kind, references[v.name]) for v in self.present}
        last = max(variable.valueReference for variable in self.instance.fmu.variables.values())
        unknown = {"the reference after the last": last + 1, "an unknown reference": UNKNOWN}
        explained = self.instance.fmu.log_categories
        for kind, value in good.items():
            read, write = getattr(slave, f"get{kind}"), getattr(slave, f"set{kind}")
            for what, reference in {**references, **unknown}.items():
                if (kind, reference) not in valid:
                    told = (reference,) if explained and what in unknown else ()
                    attempt = partial(write, [reference], [value])
                    self.refuses(f"reading {what} as {kind}", partial(read, [reference]), (), told)
                    self.refuses(f"setting {what} as {kind}", attempt, (), told)
        around = (references["load"], UNKNOWN, references["load"])
        self.refuses("reading an unknown reference among others", partial(slave.getReal, around))

    def accepts_bounds(self, when: str, variables: Sequence[Variable]) -> None:
        """Set variables to their bounds, or far without one, and back; they can have these."""
        kept = self._values()
        for variable in variables:
            far = 1e7 * (variable.nominal or 1.0)
            for bound in (variable.minimum, far if variable.maximum is None else variable.maximum):
                if bound is None:
                    continue
                what = f"{variable.name} = {bound!r} {when}"
                try:
                    self._set({variable: bound})
                except FMICallException:
                    self.faults.append(f"{what} is refused, which is within its bounds")
                    continue
                if kept:
                    found = self._values()[variable.name]
                    if not is_same(found, bound):
                        self.faults.append(f"{what} is read as {found!r}")
                    self._set({variable: kept[variable.name]})

    def refuses_step(self, what: str, time: float, size: float, names: Sequence[str] = ()) -> None:
        """Make a step from a time (s); the log must have one of the `names`, and the size then."""
        step = partial(self.instance.call, "fmi2DoStep", time, size, True)
        self.refuses(what, step, names, [size] if names else ())

    def refuses_jumps(self) -> None:
        """Make steps that begin at another time than the present one."""
        for jump in (-STEP, -1e-7, 1e-7, 1e-5, STEP, 1e9, math.nan, math.inf):
            what = f"a step {jump!r} s away from the present time"
            self.refuses_step(what, self.instance.time + jump, STEP)

    def _set(self, values: Mapping[Variable, float]) -> None:
        """Set variables of one type in one call."""
        references = [self.instance.fmu.reference(variable.name) for variable in values]
        self._write(next(iter(values)).kind, references, list(values.values()))

    def _write(self, kind: str, references: Sequence[int], values: Sequence[float]) -> None:
        if kind == "Integer":
            self.instance.slave.setInteger(references, [int(value) for value in values])
        else:
            self.instance.slave.setReal(references, values)


def shows(log: str, value: float) -> bool:
    """Return whether a number in a text is a value, as far as messages round it."""
    numbers = [float(text) for text in _NUMBER.findall(log)]
    if math.isnan(value):
        return any(map(math.isnan, numbers))
    return any(math.isclose(n, value, rel_tol=1e-5, abs_tol=1e-300) for n in numbers)


def bad_values(variable: Variable) -> list[float]:
    """Return values that are not finite, and the nearest beyond the bounds of a variable."""
    low, high = variable.minimum, variable.maximum
    below = [] if low is None else [math.nextafter(low, -math.inf), low - 1.0]
    below += [0.0] if low is not None and low > 0.0 else []
    above = [] if high is None else [math.nextafter(high, math.inf), high + 1.0]
    if variable.kind == "Integer":
        return [below[-1], above[-1]]
    return [*NOT_FINITE, *below, *above]


def refusal_faults(fmu: FmuSide) -> Iterator[str]:
    """Try what must be refused before, in and after the run of the scene; the run goes on."""
    plain, trial = Replay.of(fmu), Trial(fmu.instance)
    try:
        rows = _tried(trial, plain)
    finally:
        yield from trial.faults
    yield from plain.differences("a run with refused calls", rows)


def _tried(trial: Trial, plain: Replay) -> Rows:
    """Return the rows of a run around and in which calls are refused."""
    instance, running = trial.instance, Running(trial.instance, plain.schedule)
    _before_the_run(trial)
    instance.initialise({**plain.parameters, **running.first}, **running.span)
    trial.watch(*SMOOTH)
    trial.refuses_values("in initialisation mode", trial.settable)
    trial.refuses_calls("in initialisation mode")
    instance.begin()
    running.read()
    trial.refuses_jumps()
    for step in range(running.steps):
        tried = step in (1, running.steps // 2 + 1)
        # After derivatives of inputs are set, which a refused call must not drop.
        trying = partial(_in_the_run, trial, restores=step > 1)
        running.advance(step, trying if tried else None)
    beyond = STEP + 1e-3 * abs(running.span["stop_time"])
    trial.refuses_step("a step beyond the stop", instance.time, beyond)
    instance.terminate()
    trial.refuses_calls("after a run")
    return running.rows


def _before_the_run(trial: Trial) -> None:
    instance = trial.instance
    instance.set_up(start_time=5.0)
    instance.call("fmi2Reset")
    instance.time = 0.0
    if not is_refused(instance.value, "load"):  # which may be, before initialization mode
        trial.watch()

    def set_up(arguments: tuple[object, ...]) -> None:
        instance.call("fmi2SetupExperiment", *arguments)
        if instance.fmu.version != "2.0":  # FMI 3.0 takes it with initialisation mode
            instance.call("fmi2EnterInitializationMode")

    for what, arguments in EXPERIMENTS.items():
        trial.refuses(what, partial(set_up, arguments))
    with suppress(FMICallException):  # an FMU may ask for another experiment first
        instance.call("fmi2EnterInitializationMode")
        if not is_same(instance.value("last_event_time"), instance.time):
            trial.faults.append("a reset or an experiment that is refused changes the start time")
        instance.call("fmi2Reset")
    trial.refuses_values("before a run", trial.settable)
    trial.refuses_calls("before a run")
    trial.accepts_bounds("before a run", trial.settable)


def _in_the_run(trial: Trial, *, restores: bool) -> None:
    """Try what must be refused in a run; go back to a state from before where `restores` says so.

    That would hide what refused calls change in a state, and must still be possible after them.
    """
    instance, present = trial.instance, trial.present
    anytime = [v for v in present if v.causality == "input" or v.variability == "tunable"]
    fixed = [v for v in present if v.causality == "parameter" and v.variability == "fixed"]
    trial.refuses_values("in a run", anytime)
    trial.refuses_types()
    trial.refuses_all("in a run", fixed)
    trial.refuses_all("from outside", (v for v in present if v.causality == "output"))
    trial.refuses_calls("in a run")
    if instance.fmu.interpolates:
        trial.refuses_derivatives()
    restores = restores and bool(instance.fmu.offers.canGetAndSetFMUstate)
    state = SavedState.of(instance) if restores else None
    names = ["communicationStepSize"] if instance.fmu.log_categories else []
    for size in (0.0, -0.0, -1e-3, *NOT_FINITE):
        trial.refuses_step(f"a step of {size!r} s", instance.time, size, names)
    beyond = 1e3 * (instance.time + STEP)  # parts of it are beyond the stop, too
    trial.refuses_step("a step far beyond the stop", instance.time, beyond)
    trial.refuses_jumps()
    trial.faults += status_faults(instance, refused=True)
    trial.accepts_bounds("in a run", anytime)
    if state is not None:
        if instance.fmu.offers.canSerializeFMUstate:
            state.transfer(instance)
        else:
            state.restore()
        state.free()
        what = "a step far beyond the stop after a state is restored"
        trial.refuses_step(what, instance.time, beyond)
