"""Mistakes in a scene file, with what is said of them in the file `screens/mistakes.txt`."""

from pathlib import Path

from slider_resonator.scenes.scene import read_scenes
from tests.harness.golden import assert_mistakes_as_before
from tests.harness.scene_text import HEAD, read_scene

RUN = "[run]\nstop_time = 0.1\nstep_size = 0.01\n"
EXPECT = RUN + '[[expect]]\nwhy = "test"\n'
POSITION = EXPECT + 'quantity = "position"\n'
STEADY = '[[expect]]\nwhy = "test"\nquantity = "steady_velocity"\n'
NEED = RUN + "[need]\n"
STEPS = "[inputs]\nload = { steps = [[0, 0], [0.05, 1]] }\n"

IN_THE_HEAD = {
    "no name": 'title = "Mine"\n',
    "no title": 'name = "mine"\n',
    "blank in the name": 'name = "my scene"\ntitle = "x"\n',
    "no quotes": 'name = mine\ntitle = "x"\n',
    "colon": 'name: "mine"\ntitle = "x"\n',
    "open text": 'name = "mine\ntitle = "x"\n',
    "not text": "\x00\x01\x02",
    "curly quotes": "name = “mine”\n",
    "an apostrophe in a text": "name = 'mine'\ntitle = 'It's mine'\n",
    "quotes in a text": 'name = "mine"\ntitle = "the "best" scene"\n',
    "a device file": "[device]\nslider_mass = 1.0\n",
    "a grid file": "[grid]\nphase = [0.0, 1.0]\n",
    "a title below a heading": 'name = "mine"\ntitle = "x"\n' + RUN + 'title = "Mine"\n',
}
"""Texts of scenes by what is wrong with them."""

BELOW_THE_HEAD = {
    "open list": "[sweep]\nvariable = 'load'\nvalues = [0, 1\n",
    "open heading": "[run\nstop_time = 1\n",
    "decimal comma": "[inputs]\nphase = 0,4\n",
    "key given twice": "[run]\nstop_time = 1\nstop_time = 2\nstep_size = 0.1\n",
    "table given twice": RUN + RUN,
    "unknown key": "[run]\nstop_tme = 1\nstep_size = 0.1\n",
    "unknown table": "[input]\nphase = 1\n",
    "unknown parameter": "[device]\nslider_mas = 1\n",
    "two unknown inputs": "[inputs]\nphse = 1.0\nlod = 2.0\n",
    "fraction for an integer": "[device]\nfidelity = 1.5\n",
    "a fidelity that does not exist": "[device]\nfidelity = 3\n",
    "a second instance out of bounds": RUN + "[beside.device]\nfriction_law = 2\n",
    "negative step": "[run]\nstop_time = 0.1\nstep_size = -0.01\n",
    "no length": "[run]\nstep_size = 0.1\n",
    "no step sizes": "[run]\nstop_time = 1\nstep_sizes = []\n",
    "a step size of 0": "[run]\nstop_time = 1\nstep_sizes = [0.1, 0]\n",
    "two kinds of step size": "[run]\nstop_time = 1\nstep_size = 1\nstep_sizes = [1]\n",
    "a point without a value": RUN + "[inputs]\nload = { steps = [[0.05]] }\n",
    "two kinds of input": RUN + "[inputs]\nload = { constant = 1, ramp = [[0, 1]] }\n",
    "a CSV without a name": "[inputs]\nphase = { csv = 3 }\n",
    "another value between": '[inputs]\nphase = { csv = "a.csv", between = "x" }\n',
    "not tunable": RUN + "[tuning]\nslider_mass = 1\n",
    "no table": "run = 3\n",
    "no list of tables": "expect = 3\n",
    "single brackets": '[expect]\nquantity = "position"\n',
    "unknown quantity": EXPECT + 'quantity = "positon"\n',
    "reference of another quantity": POSITION + 'reference = "closed_form"\nrelative = 1e-6\n',
    "no reason": RUN + '[[expect]]\nquantity = "reversals"\nvalue = 0\n',
    "an empty reason": RUN + '[[expect]]\nquantity = "reversals"\nvalue = 0\nwhy = ""\n',
    "nothing expected": EXPECT + 'quantity = "mean_velocity"\n',
    "a value and a bound": STEADY + "value = 1.0\nat_most = 2.0\n",
    "a value that is no number": STEADY + "value = true\n",
    "a wide tube": POSITION + 'reference = "located_events"\nrelative = 1e-6\ntube = 0.5\n',
    "unknown sweep": '[sweep]\nvariable = "lode"\nvalues = [1]\n',
    "values not in a list": '[sweep]\nvariable = "load"\nvalues = 1\n',
    "no values": '[sweep]\nvariable = "load"\nvalues = []\n',
    "unknown need": NEED + "positon = { rel = 0.1 }\n",
    "a need without a tolerance": NEED + "position = 1e-3\n",
    "a need of a share alone": NEED + "mean_velocity = '1 %'\n",
    "a need of no error": NEED + "position = { rel = 0.0 }\n",
    "a need below 0": NEED + "position = { abs = -1e-6 }\n",
    "unknown tolerance of a need": NEED + "position = { relative = 0.1 }\n",
    "a need of any law": NEED + "friction_law = 'any'\n",
    # What other notations allow:
    "comma after a value": "[run]\nstop_time = 0.1,\n",
    "a comment of C": "// a comment\n" + RUN,
    "typographic minus": "[inputs]\nphase = −0.4\n",
    "no digit before the point": "[inputs]\nphase = -.5\n",
    "no digit after the point": "[inputs]\nphase = 5.\n",
    "a number with its unit": "[run]\nstop_time = 1.5e-1 s\n",
    "true in another spelling": RUN + "read_twice = True\n",
    "a number for true": RUN + "read_twice = 1\n",
    "a power": "[run]\nstop_time = 10^-3\n",
    "a key of two words": "[run]\nstop time = 1\n",
    "braces over lines": "[inputs]\nload = {\n steps = [[0, 0]]\n}\n",
    "a path with backslashes": '[inputs]\nload = { csv = "C:\\Users\\me.csv" }\n',
    "one bracket too few": "[[expect]\n",
    "a mark of thousands": "[device]\ndrive_frequency = 3,500\n",
    "an apostrophe of thousands": "[device]\ndrive_frequency = 3'500\n",
    "a leading zero": "[device]\ndrive_frequency = 0350\n",
    "a share in percent": POSITION + "relative = 1%\n",
    "a micrometre": "[device]\nbase_amplitude = 100µm\n",
    "a key without a value": "[inputs]\nload = null\n",
    "a colon in braces": RUN + "[inputs]\nload = { steps: [[0, 1]] }\n",
    "pairs in parentheses": RUN + "[inputs]\nload = { steps = [(0, 1), (1, 2)] }\n",
    "no comma between pairs": RUN + "[inputs]\nload = { steps = [[0, 1] [1, 2]] }\n",
    "open brace": RUN + "[inputs]\nload = { steps = [[0, 1], [1, 2]]\n",
    "two brackets around a table": "[[run]]\nstop_time = 1\nstep_size = 1\n",
    "a file in place of a number": RUN + '[inputs]\nload = "load.csv"\n',
    # A key in the table of another:
    "an input among the parameters": "[device]\nload = 0.1\n",
    "a parameter among the inputs": "[inputs]\nslider_mass = 1\n",
    "an output among the inputs": "[inputs]\nposition = 1\n",
    "an input in the run": RUN + "phase = 1\n",
    "a length above the tables": "stop_time = 1\n",
    # Values:
    "a law by its name": '[device]\nfriction_law = "lugre"\n',
    "a date": "[inputs]\nload = 2020-01-01\n",
    "a bare list of points": RUN + "[inputs]\nload = [[0, 0], [1, 1]]\n",
}
"""The same, with texts that follow on `HEAD`."""

IN_NO_SCHEMA = {
    "unknown device": 'device = "convoyer"\n',
    "a device file that is not there": 'device = "none.toml"\n',
    "unit that does not fit": '[inputs]\nload = { steps = [[0, 0], ["5 mm", "50 mN"]] }\n',
    "unit that does not fit a parameter": "[device]\ndrive_frequency = '20 kg'\n",
    "not a number": "[device]\nslider_mass = nan\n",
    "tuned out of bounds": RUN + "[tuning]\nnormal_preload = { steps = [[0, 1], [0.05, -1]] }\n",
    "swept out of bounds": "[sweep]\nvariable = 'fidelity'\nvalues = [0, 3]\n",
    "step in ms": "[run]\nstop_time = 1000\nstep_size = 1e-6\n",
    "steps without end": "[run]\nstop_time = 1\nsteps_per_period = 1e308\n",
    "an infinite start": RUN + "start_time = inf\n",
    "no run": '[[expect]]\nquantity = "reversals"\nvalue = 0\nwhy = "x"\n',
    "tuning without a run": "[tuning]\nnormal_preload = 1\n",
    "times not in order": RUN + "[inputs]\nload = { steps = [[0.05, 0], [0.0, 1]] }\n",
    "tuned and fixed": RUN + "[device]\nnormal_preload = 1\n[tuning]\nnormal_preload = 2\n",
    "a sweep of what changes": RUN + STEPS + "[sweep]\nvariable = 'load'\nvalues = [0, 1]\n",
    "no tolerance": POSITION + 'reference = "located_events"\n',
    "a number without a tolerance": STEADY + "value = 0.1\n",
    "a value in words": STEADY + 'value = "fast"\n',
    "a value of nan": STEADY + "value = nan\n",
    "a bound of a signal": POSITION + "at_most = 1.0\n",
    "a bound of a word": EXPECT + 'quantity = "steady_status"\nat_most = 1.0\n',
    "a signal within an absolute error": POSITION + 'reference = "averaged"\nabsolute = 1e-6\n',
    "event times without a tube": EXPECT + 'quantity = "event_times"\nreference = "averaged"\n',
    "a tube around averages": POSITION + 'reference = "averaged"\nrelative = 1\ntube = 0.01\n',
    "a tube without a reference for it": EXPECT
    + 'quantity = "ripple_amplitude"\nreference = "closed_form"\nrelative = 1\ntube = 0.1\n',
    "nothing beside": EXPECT + 'quantity = "beside_differences"\nvalue = 0\n',
    "steady motion under inputs that change": RUN + STEPS + STEADY + "value = 0.1\nrelative = 1\n",
    "steady motion of a device that is tuned": EXPECT
    + 'quantity = "steady_status"\nvalue = "steady"\n'
    + "[tuning]\nnormal_preload = { steps = [[0, 1], [0.05, 2]] }\n",
    "no needs": NEED,
    "a need of a law alone": NEED + "friction_law = 'free'\n",
    "a need without any tolerance": NEED + "position = {}\n",
    "a need of nan": NEED + "position = { rel = nan }\n",
    "a need without a run": "[need]\nbeat = { rel = 0.1 }\n",
    "a need under inputs that change": STEPS + "[need]\nblocking_force = { rel = 0.1 }\n",
    "a variant that is no list": "variant = 3\n",
    "a variant without a name": '[[variant]]\ntitle = "x"\n',
    "two variants of one name": '[[variant]]\nname = "a"\n[[variant]]\nname = "a"\n',
    "an unknown key of a variant": '[[variant]]\nname = "a"\ndevise = 1\n',
    **{
        f"a CSV: {what}": RUN + f"[inputs]\nload = {{ csv = {csv} }}\n"
        for what, csv in {
            "none": '"no.csv"',
            "too short": '"short.csv"',
            "another column": '"short.csv", column = "lod"',
            "a column twice": '"twice.csv"',
            "no header": '"bare.csv"',
            "a word": '"words.csv"',
            "another encoding": '"utf16.csv"',
        }.items()
    },
}
"""Mistakes that depend on other tables, files or numbers in a way that a schema cannot say."""

MISTAKES = IN_THE_HEAD | {name: HEAD + text for name, text in BELOW_THE_HEAD.items()}


def test_a_mistake_is_one_line_with_file_key_and_remedy(tmp_path: Path) -> None:
    (tmp_path / "short.csv").write_text("time,load\n0,0\n0.05,1\n")
    (tmp_path / "bare.csv").write_text("0,0\n1,1\n")
    (tmp_path / "words.csv").write_text("time,load\n0,none\n")
    (tmp_path / "twice.csv").write_text("time,load,load\n0,0,1\n0.1,1,2\n")
    (tmp_path / "utf16.csv").write_bytes("time,load\n0,0\n1,1\n".encode("utf-16")[:-1])
    texts = MISTAKES | {name: HEAD + text for name, text in IN_NO_SCHEMA.items()}
    assert_mistakes_as_before("mistakes.txt", tmp_path / "mine.toml", texts, read_scenes)


def test_a_scene_saved_with_a_byte_order_mark_is_read(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(HEAD + RUN, encoding="utf-8-sig")
    assert read_scene(path).name == "mine"
