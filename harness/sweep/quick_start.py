"""An instance that is started hundreds of thousands of times with the same names."""

from __future__ import annotations

from collections.abc import Mapping

from harness.drive import Block, Instance
from harness.errors import FmuError
from harness.interface import INTEGERS
from harness.values import check_integer


class QuickStart(Instance):
    """Sets all Reals of a start in one call, and looks names up once.

    Shooting starts an instance some twenty times a point, with four to thirty values, and each
    call through fmpy costs more than a drive period. `of` must stay open meanwhile: it is the
    owner of the instance, which this only drives.
    """

    def __init__(self, of: Instance) -> None:
        super().__init__(of.fmu, of.slave, of.messages)
        self._plans: dict[tuple[str, ...], Block] = {}

    def start(
        self,
        values: Mapping[str, float],
        stop_time: float | None = None,
        *,
        start_time: float = 0.0,
    ) -> None:
        """Initialise as `Instance.start` does, with the same errors."""
        names = tuple(values)
        block = self._plans.get(names)
        if block is None:
            reals = [name for name in names if name not in INTEGERS]
            references = [self.fmu.settable(name).valueReference for name in reals]
            block = self._plans[names] = Block(self.slave, references)
        self.time = start_time
        slave = self.slave
        with self.explained():
            if self._used:
                slave.fmi2Reset(slave.component)
            self._used = True
            slave.fmi2SetupExperiment(
                slave.component, False, 0.0, start_time, stop_time is not None, stop_time or 0.0
            )
            for name in filter(INTEGERS.__contains__, names):
                self._set_integer(name, values[name])
            block.write([value for name, value in values.items() if name not in INTEGERS])
            slave.fmi2EnterInitializationMode(slave.component)
            slave.fmi2ExitInitializationMode(slave.component)

    def _set_integer(self, name: str, value: float) -> None:
        try:
            check_integer(name, value)
        except ValueError as error:
            raise FmuError(str(error)) from error
        self.slave.setInteger([self.fmu.settable(name).valueReference], [int(value)])
