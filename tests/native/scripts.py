"""Scripts for the C driver: ordinary devices and extreme ones."""

from collections.abc import Mapping

from fmu_src.python.slider_component.variables import VALUE_REFERENCE, VARIABLES
from slider_resonator.device.interface import INPUTS
from slider_resonator.stressing.axes import axis_cases
from slider_resonator.stressing.case import Case
from tests.problems import PROBLEMS

GET = " ".join(["get", *(str(VALUE_REFERENCE[v.name]) for v in VARIABLES if v.start is None)])
CHOICES = [(law, fidelity) for law in (0, 1) for fidelity in (2, 1, 0)]
STEPS = ((1e-3, 10), (7.3e-5, 30), (0.01, 1), (1e-12, 3))
"""Size [s] and number."""


def devices() -> dict[str, dict[str, float]]:
    """Start values by the name of what they try; those that `stress` tries are among them."""
    named = {name: problem.start_values for name, problem in PROBLEMS.items()}
    for case in axis_cases():
        if case.model.fidelity == 2:
            inputs = dict(zip(INPUTS, case.holds[0].inputs, strict=True))
            named[f"{case.axis}: {case.value}"] = {**case.parameters, **inputs}
    return named


def setting(values: Mapping[str, float]) -> list[str]:
    """Lines that set variables by name."""
    types = {variable.name: variable.type.lower() for variable in VARIABLES}
    return [f"{types[name]} {VALUE_REFERENCE[name]} {value!r}" for name, value in values.items()]


def case_script(case: Case) -> str:
    """A run of the driver through a case of `stress`."""
    lines = [*setting(case.parameters), *setting(case.model.parameters)]
    for number, hold in enumerate(case.holds):
        lines += setting(dict(zip(INPUTS, hold.inputs, strict=True)))
        lines += setting(dict(hold.tuned)) if number else ["initialize"]
        lines += [f"step {hold.size!r} {hold.count}", GET]
    return "\n".join(lines) + "\n"


def script(values: Mapping[str, float], law: int, fidelity: int) -> str:
    """A run of the driver with steps of several sizes, in which the inputs change."""
    lines = [*setting({**values, "friction_law": law, "fidelity": fidelity}), "initialize"]
    for number, (size, count) in enumerate(STEPS):
        lines += [f"step {size!r} {count}", GET]
        if number == 1:
            lines += setting({"phase": 1.2, "load": 0.03})
    return "\n".join(lines) + "\n"
