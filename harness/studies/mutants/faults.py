"""Typical faults of events and inputs, as code appended to a module.

What is appended takes the place of a function or method of the module when it is loaded, so these
mutants hang on a few names and not on how things are done.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from slider_resonator.device.interface import INPUTS, INTEGERS, PARAMETERS
from studies.mutants.mutant import Mutant


@dataclass(frozen=True)
class Fault:
    """Code that makes the module `file` faulty; `needs` are the names that it must have."""

    file: str
    kind: str
    change: str
    needs: tuple[str, ...]
    code: str


_EVERY_50TH = """
_found, _events = first_zero, [0]


def first_zero(*arguments):
    zero = _found(*arguments)
    _events[0] += zero is not None
    return zero if _events[0] % 50 else None
"""

_LATE = """
_found = first_zero


def first_zero(*arguments):
    zero = _found(*arguments)
    return zero if zero is None else 1.000001 * zero
"""

_HELD_FOR_EVER = "\nStick.watches = lambda self, horizon: ()\n"
_NOT_NOTICED = "\nWindow.time_to_switch = lambda *arguments: inf\n"
_GROUNDED = "\nWindow.is_lifted = lambda *arguments: False\n"
_UNCOUNTED = """

def _turn_uncounted(self, direction):
    self.sliding, self.event_age = direction, 0.0


Moment.turn = _turn_uncounted
"""
_STICKS = "\n_mode_in_contact = lambda system, now: STICK\n"

_AFTER_SET = """
_set = Component.set


def _set_and_jump(self, new):
    before = dict(self._values)
    _set(self, new)
    moment = self._moment
    if moment is not None and self._values[{name!r}] != before[{name!r}]:
        self._moment = replace(moment, {jump})


Component.set = _set_and_jump
"""

_JUMPS = (
    ("phase", "psi=moment.psi + 0.01", "the normal phase jumps by 0.01 rad when phase changes"),
    ("load", "theta=moment.theta + 0.01", "the drive phase jumps by 0.01 rad when load changes"),
    (
        "frequency_ratio",
        "psi=self._values['frequency_ratio'] * moment.theta",
        "the normal phase becomes ratio times drive phase when frequency_ratio changes",
    ),
    (
        "frequency_ratio",
        "psi=moment.psi + 0.01",
        "the normal phase jumps by 0.01 rad when frequency_ratio changes",
    ),
)

_STEP_LATE = """
_set, _step, _waiting = Component.set, Component.step, {}


def _set_later(self, new):
    if self._moment is None:
        _set(self, new)
    else:
        _waiting.update(new)


def _step_and_set(self, time, step_size):
    _step(self, time, step_size)
    _set(self, _waiting)
    _waiting.clear()


Component.set, Component.step = _set_later, _step_and_set
"""

_IGNORED = """
_set = Component.set


def _set_others(self, new):
    kept = {{}} if self._moment is None else {{{name!r}: self._values[{name!r}]}}
    _set(self, {{**new, **{{n: v for n, v in kept.items() if n in new}}}})


Component.set = _set_others
"""

_SCALED = """
_exact = _prepare


def _prepare(values):
    return _exact({{**values, {name!r}: 1.01 * values[{name!r}]}})
"""

_REPLACE = "from dataclasses import replace\n"


def _events() -> Iterator[Fault]:
    every = "each 50th stop or release is skipped"
    late = "each stop or release is late by a millionth of the time to it"
    switch = "lift-off and touchdown happen at the next step only"
    for file, change, needs, code in (
        ("events.py", every, ("first_zero",), _EVERY_50TH),
        ("events.py", late, ("first_zero",), _LATE),
        ("sliding.py", "a stick is never released", ("Stick",), _HELD_FOR_EVER),
        ("contact.py", switch, ("Window", "time_to_switch", "inf"), _NOT_NOTICED),
        ("contact.py", "the contact never lifts", ("Window", "is_lifted"), _GROUNDED),
        ("moment.py", "reversals are not counted", ("Moment", "turn"), _UNCOUNTED),
        ("coulomb.py", "the slider sticks at each stop", ("_mode_in_contact", "STICK"), _STICKS),
    ):
        yield Fault(file, "event", change, needs, code)


def _inputs() -> Iterator[Fault]:
    needs = ("Component",)
    for name, jump, change in _JUMPS:
        code = "\n" + _REPLACE + _AFTER_SET.format(name=name, jump=jump)
        yield Fault("component.py", "input", change, needs, code)
    change = "changed inputs act one communication step late"
    yield Fault("component.py", "input", change, needs, _STEP_LATE)
    for name in INPUTS:
        change = f"{name} is ignored after the start"
        yield Fault("component.py", "input", change, needs, _IGNORED.format(name=name))


def _parameters() -> Iterator[Fault]:
    for name in (*PARAMETERS, *INPUTS):
        if name not in INTEGERS:
            change = f"{name} acts 1 % too large"
            code = _SCALED.format(name=name)
            yield Fault("component.py", "parameter", change, ("_prepare",), code)


FAULTS: tuple[Fault, ...] = (*_events(), *_inputs(), *_parameters())


def fault_mutants(file: str, path: str, text: str) -> list[Mutant]:
    """Return the mutants that append a fault to the module `file` with source `text`."""
    end = text.count("\n") + 1
    return [
        Mutant(file, path, end, 1, f.kind, f.change, None, text, text + "\n" + f.code)
        for f in FAULTS
        if f.file == file
    ]


def missing_names(modules: Mapping[str, str]) -> list[str]:
    """Return, as file and name, what the faults need and the modules do not have."""
    return [
        f"{fault.file}: {name}"
        for fault in FAULTS
        for name in fault.needs
        if name not in modules.get(fault.file, "")
    ]
