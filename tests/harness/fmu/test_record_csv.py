from __future__ import annotations

import csv
from pathlib import Path

import numpy as np

from slider_resonator.fmu.record import Record, write_csv


def test_every_digit_is_written_under_quoted_names(tmp_path: Path) -> None:
    record = Record(
        times=np.array([0.0, 0.1]),
        inputs=np.array([[0.4, 0.0, 1.0], [0.4, 0.0, 1.0]]),
        outputs={"position": np.array([0.0, 1.0 / 3.0])},
        wall_time=1.0,
        start_cpu=0.4,
        step_cpu=0.6,
    )
    path = tmp_path / "run.csv"
    write_csv(record, path)
    text = path.read_text()
    assert text.splitlines()[0] == '"time","phase","load","frequency_ratio","position"'
    rows = list(csv.DictReader(text.splitlines()))
    assert float(rows[1]["position"]) == 1.0 / 3.0
    assert float(rows[1]["time"]) == 0.1
