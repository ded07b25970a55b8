"""Commands that cannot run: what they say is in the file `screens/refused_commands.txt`."""

import re
import shlex
from pathlib import Path

import pytest

from tests.harness.calling import call
from tests.harness.golden import assert_as_before, without_long_lists

FILES = {
    "mine.toml": "[device]\nslider_mass = 2\n",
    "grid.toml": "[grid]\nphase = [1]\n",
    "fase.toml": "[grid]\nfase = [1]\n",
    "three.toml": "[grid]\nphase = [1]\nload = [0]\nfidelity = [2]\n",
}
COMMANDS = """
stedy
validate no.fmu
validate no.fmu --scene tabel_1
validate --scene /
validate --fmu no.fmu --scene table_1
validate no.fmu --own --scene table_1
steady /
steady --fmu no.fmu
steady no.fmu --fmu no.fmu
steady no.fmu --set phse=1
steady no.fmu --set phase=1 load=x
steady no.fmu --set phase=1 phase=2
steady no.fmu --set --max-denominator
steady no.fmu --set
steady --phase 0.4
blocking no.fmu
choose nope
scenes --check mine.tml
scenes --show tabel_1
scenes --template --schema
run no.fmu table_1
run --fmu no.fmu table_1
run no.fmu no.toml
run no.fmu /
run folder/mine
run --initial-velocity=1
run no.fmu lift_off --out /dev/full
run no.fmu lift_off --out ''
run no.fmu lift_off --out /
run no.fmu lift_off --out /no/such/out.csv
run no.fmu lift_off --plot p.txt
run no.fmu lift_off --set load=nan
run no.fmu lift_off --set drive_frequency=0
run no.fmu lift_off --set load=1 --set load=2
run no.fmu lift_off --set phase=30 deg
run no.fmu lift_off --set 'phase=30 Grad'
run no.fmu lift_off --window 1
run no.fmu lift_off --window a:b
run no.fmu lift_off --window 0:0.1
run no.fmu lift_off --signals load
run no.fmu lift_off --plot a.png --window 1:2
run no.fmu lift_off --plot a.png --window 0.1:0.1
run no.fmu lift_off --plot a.png --window 0.1:0.05
run no.fmu lift_off --plot a.png --window -0.1:0.1
run no.fmu lift_off --plot a.png --window nan:0.1
run no.fmu lift_off --plot a.png --signals velocty
run no.fmu lift_off --plot a.png --signals tolerance
run no.fmu lift_off --plot a.png --signals load,load
run no.fmu lift_off --plot a.png --overlay fidelty=1
run no.fmu lift_off --plot a.png --overlay fidelity=x
run no.fmu lift_off --time '-1 ms'
run no.fmu lift_off --time '1e4 s'
run no.fmu lift_off --step '1 ms' --auto
sweep --out a.csv
sweep grid.toml --out a.csv --over phase=0:1:3
sweep grid.toml --out a.csv --measure blocking_force
sweep --out a.csv --over phase=0:1
sweep --out a.csv --over phse=0:1:3
sweep --out a.csv --over phase=0:1:1
sweep --out a.csv --over phase=1:1:5
sweep --out a.csv --over 'phase=0 kg:1:3'
sweep --out a.csv --over phase=0:1:3 --over phase=0:2:3
sweep fase.toml --out a.csv
sweep grid.toml --out a.csv --workers 0
sweep grid.toml --out a.txt
sweep grid.toml --out a.csv --fmu none.fmu
sweep three.toml --out a.csv --plot a.png
sweep table_1 --out a.csv
steady mine.toml
blocking mine.toml
validate mine.toml
stress mine.toml
choose feed_forward --fmu mine.toml
trade --out out --fmu mine.toml
sweep grid.toml --out a.csv --fmu mine.toml
fit --velocity 1 --free slider_mass --fmu mine.toml
baseline check mine.toml --dir .
device grid.toml
device --ssv a.ssv
steady no.fmu --device stick_slp
trade tabel_1 --out out
trade table_1 --out out --fmu missing.fmu
trade --out . --page index.html
stress missing.fmu --out out
stress --seed 7
stress --case 'random device: seed 1, case 10' --first 5 --seed 7
stress --case 'random device: seed 1, case 10' --random 10
stress --long --random 10
stress --device conveyor --random 3
fit --free slider_mass
fit --free load --velocity-at 3
fit --free slider_mass --velocity '3 N'
fit mine.toml --free slider_mass
fit data.csv --free slider_mass --bounds 3
"""


def test_refused_commands_write_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name, text in FILES.items():
        (tmp_path / name).write_text(text)
    monkeypatch.chdir(tmp_path)
    said = []
    for command in COMMANDS.strip().splitlines():
        result = call(*shlex.split(command))
        assert (result.exit_code, result.stdout) == (2, ""), command
        reason = re.sub(r"(?s)^Usage:.*(?=Error: )", "", result.stderr)
        said.append(f"$ slider-resonator {command}\n{without_long_lists(reason)}")
    assert {path.name for path in tmp_path.iterdir()} == FILES.keys()
    assert_as_before("refused_commands.txt", "".join(said))
