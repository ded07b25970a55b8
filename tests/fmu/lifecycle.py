"""How an instance gets into each state of its life."""

from __future__ import annotations

from collections.abc import Callable

from tests.fmu.host import Instance

REACH: dict[str, Callable[[Instance], object]] = {
    "instantiated": lambda i: None,
    "experiment set up": lambda i: i.slave.setupExperiment(startTime=0.0, stopTime=1.0),
    "initializing": lambda i: i.enter_initialization(slider_mass=2.0, phase=0.3),
    "stepping": lambda i: i.initialize().step(1e-3),
    "terminated": lambda i: i.initialize().slave.terminate(),
}
