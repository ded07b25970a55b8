"""Typical mistakes in a scene file: each is one line with the file, the key and a remedy."""

from pathlib import Path
from typing import NamedTuple

import pytest

from tests.harness.calling import refused
from tests.harness.scene_text import HEAD, read_scene

RUN = "[run]\nstop_time = 0.1\nstep_size = 0.01\n"


def expect(*lines: str) -> str:
    return RUN + "\n".join(["[[expect]]", 'why = "test"', *lines, ""])


class Mistake(NamedTuple):
    text: str
    key: str
    remedy: str


IN_THE_HEAD = {
    "no name": Mistake('title = "Mine"\n', "name", 'add name = "my_step"'),
    "no title": Mistake('name = "mine"\n', "title", 'add title = "'),
    "blank in the name": Mistake('name = "my scene"\ntitle = "x"\n', "name", "letters, digits"),
    "no quotes": Mistake('name = mine\ntitle = "x"\n', "line 1", "a text needs quotes"),
    "colon": Mistake('name: "mine"\ntitle = "x"\n', "line 1", "key = value"),
    "open text": Mistake('name = "mine\ntitle = "x"\n', "line 1", "close the quotes"),
    "not text": Mistake("\x00\x01\x02", "line 1", "key = value"),
    "curly quotes": Mistake("name = “mine”\n", "line 1", "straight"),
    "an apostrophe in a text": Mistake(
        "name = 'mine'\ntitle = 'It's mine'\n", "title", "the other kind around it"
    ),
    "quotes in a text": Mistake(
        'name = "mine"\ntitle = "the "best" scene"\n', "title", "the other kind around it"
    ),
    "a title below a heading": Mistake(
        'name = "mine"\ntitle = "x"\n' + RUN + 'title = "Mine"\n', "run.title", "above the first"
    ),
}
"""Mistakes by name: the text of a scene, the key that is named and the remedy."""

BELOW_THE_HEAD = {
    "open list": Mistake(
        "[sweep]\nvariable = 'load'\nvalues = [0, 1\n", "values", "close the bracket"
    ),
    "open heading": Mistake("[run\nstop_time = 1\n", "line 3", "close the bracket"),
    "decimal comma": Mistake("[inputs]\nphase = 0,4\n", "phase", "write 0.4"),
    "key given twice": Mistake(
        "[run]\nstop_time = 1\nstop_time = 2\nstep_size = 0.1\n", "stop_time", "must be there once"
    ),
    "table given twice": Mistake(RUN + RUN, "[run]", "must be there once"),
    "unknown key": Mistake(
        "[run]\nstop_tme = 1\nstep_size = 0.1\n", "run.stop_tme", "did you mean 'stop_time'"
    ),
    "unknown table": Mistake("[input]\nphase = 1\n", "input", "did you mean 'inputs'"),
    "unknown parameter": Mistake(
        "[device]\nslider_mas = 1\n", "device", "did you mean 'slider_mass'"
    ),
    "unknown input": Mistake("[inputs]\nlod = 1\n", "inputs.lod", "did you mean 'load'"),
    "unit that does not fit": Mistake(
        '[inputs]\nload = { steps = [[0, 0], ["5 mm", "50 mN"]] }\n',
        "inputs.load.steps[2][1] = '5 mm'",
        "must be a number in s, or a text with a unit such as '5 ms'",
    ),
    "not a number": Mistake("[device]\nslider_mass = nan\n", "device.slider_mass", "finite"),
    "fraction for an integer": Mistake(
        "[device]\nfidelity = 1.5\n", "fidelity", "must be an integer"
    ),
    "a fidelity that does not exist": Mistake(
        "[device]\nfidelity = 3\n", "device.fidelity = 3", "an integer from 0 to 2 (0 slow motion"
    ),
    "a second instance out of bounds": Mistake(
        RUN + "[beside.device]\nfriction_law = 2\n",
        "beside.device.friction_law = 2",
        "must be an integer from 0 to 1 (0 Coulomb, 1 LuGre)",
    ),
    "tuned out of bounds": Mistake(
        RUN + "[tuning]\nnormal_preload = { steps = [[0, 1], [0.05, -1]] }\n",
        "tuning.normal_preload: normal_preload = -1.0",
        "at least 0 N",
    ),
    "swept out of bounds": Mistake(
        "[sweep]\nvariable = 'fidelity'\nvalues = [0, 3]\n", "sweep: fidelity = 3", "from 0 to 2"
    ),
    "negative step": Mistake(
        "[run]\nstop_time = 0.1\nstep_size = -0.01\n",
        "run.step_size = -0.01",
        "must be a number above 0, in s",
    ),
    "no length": Mistake(
        "[run]\nstep_size = 0.1\n", "run", "exactly one of stop_time or drive_periods"
    ),
    "step in ms": Mistake(
        "[run]\nstop_time = 1000\nstep_size = 1e-6\n", "run", "must be at most 3000000"
    ),
    "no run": Mistake(
        '[[expect]]\nquantity = "reversals"\nvalue = 0\nwhy = "x"\n',
        "expect: reversals",
        "[run] is missing",
    ),
    "no such CSV": Mistake(
        RUN + '[inputs]\nload = { csv = "no.csv" }\n', "inputs.load", "No such file"
    ),
    "short CSV": Mistake(
        RUN + '[inputs]\nload = { csv = "short.csv" }\n',
        "inputs.load",
        "must have them from 0 s to 0.1 s",
    ),
    "no column": Mistake(
        RUN + '[inputs]\nload = { csv = "short.csv", column = "lod" }\n',
        "inputs.load",
        "no column 'lod'",
    ),
    "times not in order": Mistake(
        RUN + "[inputs]\nload = { steps = [[0.05, 0], [0.0, 1]] }\n",
        "inputs.load",
        "times must increase",
    ),
    "a point without a value": Mistake(
        RUN + "[inputs]\nload = { steps = [[0.05]] }\n", "inputs.load.steps[1]", "[time (s), value]"
    ),
    "two kinds of input": Mistake(
        RUN + "[inputs]\nload = { constant = 1, ramp = [[0, 1]] }\n",
        "inputs.load",
        "exactly one of",
    ),
    "not tunable": Mistake(
        RUN + "[tuning]\nslider_mass = 1\n", "tuning.slider_mass", "must be in [device]"
    ),
    "tuned and fixed": Mistake(
        RUN + "[device]\nnormal_preload = 1\n[tuning]\nnormal_preload = 2\n",
        "normal_preload",
        "must be in one of them",
    ),
    "single brackets": Mistake('[expect]\nquantity = "position"\n', "expect", "headed [[expect]]"),
    "unknown quantity": Mistake(
        expect('quantity = "positon"', 'reference = "located_events"', "relative = 1e-6"),
        "expect[positon, located_events].quantity",
        "did you mean 'position'",
    ),
    "reference of another quantity": Mistake(
        expect('quantity = "position"', 'reference = "closed_form"', "relative = 1e-6"),
        "expect[position, closed_form]",
        "must be one of averaged, bristle_state, located_events",
    ),
    "no tolerance": Mistake(
        expect('quantity = "position"', 'reference = "located_events"'),
        "expect[position, located_events]",
        "needs a tolerance",
    ),
    "no reason": Mistake(
        RUN + '[[expect]]\nquantity = "reversals"\nvalue = 0\n',
        "expect[reversals].why",
        'add why = "',
    ),
    "nothing expected": Mistake(
        expect('quantity = "mean_velocity"'),
        "expect[mean_velocity]",
        "exactly one of reference, value",
    ),
    "a bound of a signal": Mistake(
        expect('quantity = "position"', "at_most = 1.0"), "expect[position]", "needs a reference"
    ),
    "unknown sweep": Mistake(
        '[sweep]\nvariable = "lode"\nvalues = [1]\n', "sweep.variable", "mean 'load'"
    ),
    "values not in a list": Mistake(
        '[sweep]\nvariable = "load"\nvalues = 1\n', "sweep.values", "a list in brackets"
    ),
    "a need without a tolerance": Mistake(
        RUN + "[need]\nposition = 1e-3\n", "need.position", "such as { rel = 0.01 }"
    ),
    # What other notations allow:
    "comma after a value": Mistake("[run]\nstop_time = 0.1,\n", "stop_time", "delete the ,"),
    "a comment of C": Mistake("// a comment\n" + RUN, "line 3", "begins with #"),
    "typographic minus": Mistake("[inputs]\nphase = −0.4\n", "phase", "a minus sign is -"),
    "no digit before the point": Mistake("[inputs]\nphase = -.5\n", "phase", "write -0.5"),
    "no digit after the point": Mistake("[inputs]\nphase = 5.\n", "phase", "write 5.0"),
    "a number with its unit": Mistake(
        "[run]\nstop_time = 1.5e-1 s\n", "stop_time", 'write "1.5e-1 s"'
    ),
    "true in another spelling": Mistake(RUN + "read_twice = True\n", "read_twice", "write true"),
    "a power": Mistake("[run]\nstop_time = 10^-3\n", "stop_time", "nothing is computed"),
    "a key of two words": Mistake("[run]\nstop time = 1\n", "stop time", "did you mean stop_time"),
    "braces over lines": Mistake(
        "[inputs]\nload = {\n steps = [[0, 0]]\n}\n", "load", "on one line"
    ),
    "a path with backslashes": Mistake(
        '[inputs]\nload = { csv = "C:\\Users\\me.csv" }\n', "load", "written with /"
    ),
    "one bracket too few": Mistake("[[expect]\n", "line 3", "or [[expect]]"),
    "a mark of thousands": Mistake(
        "[device]\ndrive_frequency = 3,500\n", "drive_frequency", "write 3500 or 3.500"
    ),
    "an apostrophe of thousands": Mistake(
        "[device]\ndrive_frequency = 3'500\n", "drive_frequency", "write 3500"
    ),
    "a leading zero": Mistake("[device]\ndrive_frequency = 0350\n", "drive_frequency", "write 350"),
    "a share in percent": Mistake(
        expect('quantity = "position"', 'reference = "located_events"', "relative = 1%"),
        "relative",
        "write 1e-2",
    ),
    "a micrometre": Mistake(
        "[device]\nbase_amplitude = 100µm\n", "base_amplitude", 'in quotes: write "100µm"'
    ),
    "a key without a value": Mistake("[inputs]\nload = null\n", "load", "delete the line"),
    "a colon in braces": Mistake(
        RUN + "[inputs]\nload = { steps: [[0, 1]] }\n", "load", "write { steps = ... }"
    ),
    "pairs in parentheses": Mistake(
        RUN + "[inputs]\nload = { steps = [(0, 1), (1, 2)] }\n", "load", "square brackets"
    ),
    "no comma between pairs": Mistake(
        RUN + "[inputs]\nload = { steps = [[0, 1] [1, 2]] }\n", "load", "a comma must be"
    ),
    "open brace": Mistake(
        RUN + "[inputs]\nload = { steps = [[0, 1], [1, 2]]\n", "load", "close the brace"
    ),
    "two brackets around a table": Mistake(
        "[[run]]\nstop_time = 1\nstep_size = 1\n", "run", "headed [run]"
    ),
    "a file in place of a number": Mistake(
        RUN + '[inputs]\nload = "load.csv"\n', "inputs.load", '{ csv = "load.csv" }'
    ),
    "CSV with a column twice": Mistake(
        RUN + '[inputs]\nload = { csv = "twice.csv" }\n', "inputs.load", "must be one"
    ),
    # A key in the table of another:
    "an input among the parameters": Mistake(
        "[device]\nload = 0.1\n", "device.load", "must be in [inputs]"
    ),
    "a parameter among the inputs": Mistake(
        "[inputs]\nslider_mass = 1\n", "inputs.slider_mass", "must be in [device]"
    ),
    "an output among the inputs": Mistake(
        "[inputs]\nposition = 1\n", "inputs.position", "an output cannot be set"
    ),
    "an input in the run": Mistake(RUN + "phase = 1\n", "run.phase", "must be in [inputs]"),
    "a length above the tables": Mistake("stop_time = 1\n", "stop_time", "must be in [run]"),
    # Values:
    "a law by its name": Mistake(
        '[device]\nfriction_law = "lugre"\n', "device.friction_law", "0 Coulomb, 1 LuGre"
    ),
    "a date": Mistake("[inputs]\nload = 2020-01-01\n", "load = 2020-01-01", "a number"),
    "a bare list of points": Mistake(
        RUN + "[inputs]\nload = [[0, 0], [1, 1]]\n", "inputs.load", "such as { steps ="
    ),
    "a sweep of what changes": Mistake(
        RUN
        + "[inputs]\nload = { ramp = [[0, 0], [1, 1]] }\n"
        + "[sweep]\nvariable = 'load'\nvalues = [0, 1]\n",
        "sweep.variable",
        "must be one whose value is constant",
    ),
    "an empty reason": Mistake(
        RUN + '[[expect]]\nquantity = "reversals"\nvalue = 0\nwhy = ""\n',
        "expect[reversals].why",
        "not empty",
    ),
    "a tube without a reference for it": Mistake(
        expect(
            'quantity = "ripple_amplitude"',
            'reference = "closed_form"',
            "relative = 1e-3",
            "tube = 0.1",
        ),
        "tube",
        "delete the key",
    ),
    # CSV files:
    "CSV without a header": Mistake(
        RUN + '[inputs]\nload = { csv = "bare.csv" }\n', "inputs.load", "begin with 'time'"
    ),
    "CSV with a word": Mistake(
        RUN + '[inputs]\nload = { csv = "words.csv" }\n',
        "words.csv line 2: load = 'none'",
        "a finite number",
    ),
    "CSV of another encoding": Mistake(
        RUN + '[inputs]\nload = { csv = "utf16.csv" }\n', "utf16.csv", "UTF-8"
    ),
}
"""The same, with texts that follow on `HEAD`."""

MISTAKES = IN_THE_HEAD | {
    name: one._replace(text=HEAD + one.text) for name, one in BELOW_THE_HEAD.items()
}


@pytest.mark.parametrize("name", MISTAKES)
def test_a_mistake_is_one_line_with_file_key_and_remedy(name: str, tmp_path: Path) -> None:
    text, key, remedy = MISTAKES[name]
    (tmp_path / "short.csv").write_text("time,load\n0,0\n0.05,1\n")
    (tmp_path / "bare.csv").write_text("0,0\n1,1\n")
    (tmp_path / "words.csv").write_text("time,load\n0,none\n")
    (tmp_path / "twice.csv").write_text("time,load,load\n0,0,1\n0.1,1,2\n")
    (tmp_path / "utf16.csv").write_bytes("time,load\n0,0\n1,1\n".encode("utf-16")[:-1])
    path = tmp_path / "mine.toml"
    path.write_text(text)
    message = refused("scenes", "--check", path)
    (line,) = message.splitlines()
    assert line.startswith(f"error: {path}: "), line
    said = line.removeprefix(f"error: {path}: ")
    assert key in said
    assert remedy in said
    for jargon in ("Input should", "pattern", "Tuple", "dictionary", "validation"):
        assert jargon not in said, f"{jargon!r} is the word of a library: {said}"


def test_a_scene_saved_with_a_byte_order_mark_is_read(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(HEAD + RUN, encoding="utf-8-sig")
    assert read_scene(path).name == "mine"
