"""Typical mistakes in a scene file: each is one line with the file, the key and a remedy."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import pytest

from tests.harness.calling import refused

HEAD = 'name = "mine"\ntitle = "Mine"\n'
RUN = "[run]\nstop_time = 0.1\nstep_size = 0.01\n"


def expect(*lines: str) -> str:
    return HEAD + RUN + "\n".join(["[[expect]]", 'why = "test"', *lines, ""])


@dataclass(frozen=True)
class Mistake:
    text: str
    key: str
    remedy: str


MISTAKES = {
    "no name": Mistake('title = "Mine"\n', "name", 'add name = "my_step"'),
    "no title": Mistake('name = "mine"\n', "title", 'add title = "'),
    "blank in the name": Mistake('name = "my scene"\ntitle = "x"\n', "name", "letters, digits"),
    "no quotes": Mistake('name = mine\ntitle = "x"\n', "line 1", "a text needs quotes"),
    "colon": Mistake('name: "mine"\ntitle = "x"\n', "line 1", "key = value"),
    "open list": Mistake(
        HEAD + "[sweep]\nvariable = 'load'\nvalues = [0, 1\n", "values", "close the bracket"
    ),
    "open text": Mistake('name = "mine\ntitle = "x"\n', "line 1", "close the quotes"),
    "open heading": Mistake(HEAD + "[run\nstop_time = 1\n", "line 3", "close the bracket"),
    "decimal comma": Mistake(HEAD + "[inputs]\nphase = 0,4\n", "phase", "write 0.4"),
    "key given twice": Mistake(
        HEAD + "[run]\nstop_time = 1\nstop_time = 2\nstep_size = 0.1\n",
        "stop_time",
        "must be there once",
    ),
    "table given twice": Mistake(HEAD + RUN + RUN, "[run]", "must be there once"),
    "not text": Mistake("\x00\x01\x02", "line 1", "key = value"),
    "unknown key": Mistake(
        HEAD + "[run]\nstop_tme = 1\nstep_size = 0.1\n", "run.stop_tme", "did you mean 'stop_time'"
    ),
    "unknown table": Mistake(HEAD + "[input]\nphase = 1\n", "input", "did you mean 'inputs'"),
    "unknown parameter": Mistake(
        HEAD + "[device]\nslider_mas = 1\n", "device", "did you mean 'slider_mass'"
    ),
    "unknown input": Mistake(HEAD + "[inputs]\nlod = 1\n", "inputs.lod", "did you mean 'load'"),
    "number in quotes": Mistake(
        HEAD + '[device]\nslider_mass = "1.0"\n', "device.slider_mass", "must be a number"
    ),
    "unit in a text": Mistake(
        HEAD + '[run]\nstop_time = "100 ms"\nstep_size = 0.1\n',
        "run.stop_time = '100 ms'",
        "must be a number, in s",
    ),
    "not a number": Mistake(HEAD + "[device]\nslider_mass = nan\n", "device.slider_mass", "finite"),
    "fraction for an integer": Mistake(
        HEAD + "[device]\nfidelity = 1.5\n", "fidelity", "must be an integer"
    ),
    "negative step": Mistake(
        HEAD + "[run]\nstop_time = 0.1\nstep_size = -0.01\n",
        "run.step_size = -0.01",
        "must be a number above 0, in s",
    ),
    "no length": Mistake(
        HEAD + "[run]\nstep_size = 0.1\n", "run", "exactly one of stop_time or drive_periods"
    ),
    "two lengths": Mistake(
        HEAD + RUN + "drive_periods = 3\n", "run", "exactly one of stop_time or drive_periods"
    ),
    "step in ms": Mistake(
        HEAD + "[run]\nstop_time = 1000\nstep_size = 1e-6\n", "run", "must be at most 3000000"
    ),
    "no run": Mistake(
        HEAD + '[[expect]]\nquantity = "reversals"\nvalue = 0\nwhy = "x"\n',
        "expect[0]",
        "[run] is missing",
    ),
    "no such CSV": Mistake(
        HEAD + RUN + '[inputs]\nload = { csv = "no.csv" }\n', "inputs.load", "No such file"
    ),
    "short CSV": Mistake(
        HEAD + RUN + '[inputs]\nload = { csv = "short.csv" }\n',
        "inputs.load",
        "must have them from 0 s to 0.1 s",
    ),
    "no column": Mistake(
        HEAD + RUN + '[inputs]\nload = { csv = "short.csv", column = "lod" }\n',
        "inputs.load",
        "no column 'lod'",
    ),
    "times not in order": Mistake(
        HEAD + RUN + "[inputs]\nload = { steps = [[0.05, 0], [0.0, 1]] }\n",
        "inputs.load",
        "times must increase",
    ),
    "a point without a value": Mistake(
        HEAD + RUN + "[inputs]\nload = { steps = [[0.05]] }\n",
        "inputs.load.steps[0]",
        "[time (s), value]",
    ),
    "two kinds of input": Mistake(
        HEAD + RUN + "[inputs]\nload = { constant = 1, ramp = [[0, 1]] }\n",
        "inputs.load",
        "exactly one of",
    ),
    "not tunable": Mistake(
        HEAD + RUN + "[tuning]\nslider_mass = 1\n", "tuning.slider_mass", "must be one of"
    ),
    "tuned and fixed": Mistake(
        HEAD + RUN + "[device]\nnormal_preload = 1\n[tuning]\nnormal_preload = 2\n",
        "normal_preload",
        "must be in one of them",
    ),
    "single brackets": Mistake(
        HEAD + '[expect]\nquantity = "position"\n', "expect", "headed [[expect]]"
    ),
    "unknown quantity": Mistake(
        expect('quantity = "positon"', 'reference = "taylor"', "relative = 1e-6"),
        "expect[0].quantity",
        "did you mean 'position'",
    ),
    "unknown reference": Mistake(
        expect('quantity = "position"', 'reference = "tailor"', "relative = 1e-6"),
        "expect[0]",
        "did you mean 'taylor'",
    ),
    "reference of another quantity": Mistake(
        expect('quantity = "position"', 'reference = "closed_form"', "relative = 1e-6"),
        "expect[0]",
        "must be one of averaged, bristle_state, held_orbits, located_events, taylor",
    ),
    "no tolerance": Mistake(
        expect('quantity = "position"', 'reference = "taylor"'), "expect[0]", "needs a tolerance"
    ),
    "negative tolerance": Mistake(
        expect('quantity = "position"', 'reference = "taylor"', "relative = -1e-6"),
        "expect[0].relative",
        "must be a number not below 0",
    ),
    "no reason": Mistake(
        HEAD + RUN + '[[expect]]\nquantity = "reversals"\nvalue = 0\n',
        "expect[0].why",
        'add why = "',
    ),
    "nothing expected": Mistake(
        expect('quantity = "mean_velocity"'), "expect[0]", "exactly one of reference, value"
    ),
    "a bound of a signal": Mistake(
        expect('quantity = "position"', "at_most = 1.0"), "expect[0]", "needs a reference"
    ),
    "unknown sweep": Mistake(
        HEAD + '[sweep]\nvariable = "lode"\nvalues = [1]\n', "sweep.variable", "mean 'load'"
    ),
    "values not in a list": Mistake(
        HEAD + '[sweep]\nvariable = "load"\nvalues = 1\n', "sweep.values", "a list in brackets"
    ),
    "a need without a tolerance": Mistake(
        HEAD + RUN + "[need]\nposition = 1e-3\n", "need.position", "such as { rel = 0.01 }"
    ),
}


@pytest.mark.parametrize("name", MISTAKES)
def test_a_mistake_is_one_line_with_file_key_and_remedy(name: str, tmp_path: Path) -> None:
    mistake = MISTAKES[name]
    (tmp_path / "short.csv").write_text("time,load\n0,0\n0.05,1\n")
    path = tmp_path / "mine.toml"
    path.write_text(mistake.text)
    message = refused("scenes", "--check", path)
    (line,) = message.splitlines()
    assert line.startswith(f"error: {path}: "), line
    said = line.removeprefix(f"error: {path}: ")
    assert mistake.key in said
    assert mistake.remedy in said


def test_there_are_thirty() -> None:
    assert len(MISTAKES) >= 30
