"""The closed loop as an SSP 1.0 package: slider, velocity controller, and their connections."""

from functools import partial
from pathlib import Path

from fmu_src.building import controller_fmu, native_fmu
from fmu_src.building.archive import check_folder, write_archive
from fmu_src.building.build_error import BuildError
from fmu_src.controller.variables import VARIABLES as CONTROLLER_VARIABLES
from fmu_src.python.slider_component.variables import VARIABLES as SLIDER_VARIABLES
from fmu_src.system_structure import Connection, ParameterValues, System, parameter_set, structure

MODEL = "ClosedLoop"

SYSTEM = System(
    name=MODEL,
    description="A controller holds the velocity of a slider under a changing load by moving the "
    "phase of the normal load",
    sources={
        "controller": f"resources/{controller_fmu.MODEL}.fmu",
        "slider": f"resources/{native_fmu.MODEL}.fmu",
    },
    variables={"controller": CONTROLLER_VARIABLES, "slider": SLIDER_VARIABLES},
    connections=(
        Connection("velocity_reference", "controller.velocity_reference"),
        Connection("load", "slider.load"),
        Connection("controller.phase", "slider.phase"),
        Connection("slider.mean_velocity", "controller.measured_velocity"),
        Connection("slider.mean_velocity", "mean_velocity"),
        Connection("controller.phase", "phase"),
    ),
    stop_time=8.0,
)

FIDELITIES = {"design": 0, "proof": 2}
"""Parameter set -> fidelity of the slider: averaged motion to design, full device to prove."""

BOUND = "proof"
"""The parameter set of a host that is given no other."""

VELOCITY_REFERENCE = 0.06
"""Velocity (m/s) that is held where a host sets no other."""


def build_closed_loop(dest: Path, slider: Path, controller: Path) -> Path:
    """Write `dest`/ClosedLoop.ssp with the two FMUs and return its path.

    The bytes depend on those of the FMUs only. Raises BuildError if one of them is missing.
    """
    check_folder(dest)
    fmus = {"controller": controller, "slider": slider}
    for fmu in fmus.values():
        if not fmu.is_file():
            raise BuildError(f"{fmu}: no such file; {MODEL}.ssp needs it")
    files = {SYSTEM.sources[name]: fmu.read_bytes() for name, fmu in fmus.items()}
    sets = {name: _parameters(name) for name in FIDELITIES}
    files |= {_resource(name): parameter_set(SYSTEM, values) for name, values in sets.items()}
    bound = partial(structure, SYSTEM, source=_resource(BOUND), parameters=sets[BOUND])
    files["SystemStructure.ssd"] = bound()
    files["WithConnectors.ssd"] = bound(connectors=True)
    return write_archive(dest, MODEL, files, ".ssp")


def _parameters(name: str) -> ParameterValues:
    tuning = {
        f"controller.{v.name}": v.start
        for v in CONTROLLER_VARIABLES
        if v.causality == "parameter" and v.start is not None
    }
    inputs = {"controller.velocity_reference": VELOCITY_REFERENCE}
    return ParameterValues(name, {**inputs, **tuning, "slider.fidelity": FIDELITIES[name]})


def _resource(name: str) -> str:
    return f"resources/{name}.ssv"
