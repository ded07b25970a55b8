"""Inputs from a CSV file in fmpy's slave, held over each step and with their derivatives."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave
from fmpy.util import read_csv

from slider_resonator.arrays import Array
from slider_resonator.device.device import Device
from slider_resonator.device.schedule import schedule
from slider_resonator.device.signal import ramp
from slider_resonator.references.resolved.simulate import simulate

pytestmark = pytest.mark.interop

STOP, STEP = 0.2, 0.01
NAMES = ("phase", "load", "frequency_ratio")
ROWS = ((0.0, 0.0, 0.0, 1.0), (0.1, 0.2, 0.012, 1.2), (0.2, 0.4, 0.0, 1.4))
TIMES = np.linspace(0.0, STOP, round(STOP / STEP) + 1)


def positions(fmu: Path, folder: Path, csv: Path, *, derivatives: bool) -> Array:
    """Step through a CSV file as a script with fmpy does, and return all positions (m)."""
    description = read_model_description(str(fmu))
    references = {v.name: v.valueReference for v in description.modelVariables}
    slave = FMU2Slave(
        guid=description.guid,
        unzipDirectory=extract(str(fmu), str(folder)),
        modelIdentifier=description.coSimulation.modelIdentifier,
        instanceName="slider",
    )
    slave.instantiate()
    slave.setupExperiment(startTime=0.0, stopTime=STOP)
    slave.enterInitializationMode()
    slave.exitInitializationMode()
    table = read_csv(csv)
    values = np.array([np.interp(TIMES, table["time"], table[name]) for name in NAMES]).T
    rates = np.diff(values, axis=0) / STEP
    inputs, found = [references[name] for name in NAMES], [0.0]
    for step, (time, rate) in enumerate(zip(TIMES, rates, strict=False)):
        slave.setReal(inputs, values[step].tolist())
        if derivatives:
            slave.setRealInputDerivatives(inputs, [1] * len(inputs), rate.tolist())
        slave.doStep(time, STEP)
        found += slave.getReal([references["position"]])
    slave.terminate()
    slave.freeInstance()
    return np.array(found)


def test_lines_of_a_csv_are_exact_in_long_steps(native_fmu: Path, tmp_path: Path) -> None:
    csv = tmp_path / "inputs.csv"
    header = ",".join(f'"{name}"' for name in ("time", *NAMES))
    csv.write_text("\n".join([header, *(",".join(map(repr, row)) for row in ROWS), ""]))
    times, *columns = zip(*ROWS, strict=True)
    signals = {
        name: ramp(list(zip(times, column, strict=True)))
        for name, column in zip(NAMES, columns, strict=True)
    }
    held = schedule(STOP, STOP, None, True, **signals).held()
    exact = simulate(Device(), held, TIMES).position
    peak = np.abs(exact).max()
    off = {
        on: np.abs(positions(native_fmu, tmp_path / str(on), csv, derivatives=on) - exact).max()
        for on in (True, False)
    }
    assert off[True] < 1e-11 * peak
    assert off[False] > 1e-3 * peak, "what it costs to hold them"
