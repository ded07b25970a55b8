from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import pytest

from slider_resonator.errors import SceneError
from tests.harness.scene_text import read_scene, scene_file

STEPS = "[inputs]\nload = { steps = [[0, 0], [1, 1]] }\n"
STEADY = 'quantity = "steady_velocity"\nvalue = 0.1\nrelative = 1e-6\nwhy = "test"\n'
RUN = "[run]\ndrive_periods = 10\nsteps_per_period = 4\n"

NEEDS = {
    "": ["need: needs at least one of", "steady_velocity", "event_times"],
    "friction_law = 'free'": ["need: needs at least one of"],
    "positon = { rel = 0.1 }": ["need.positon", "did you mean 'position'?"],
    "position = {}": ["need.position", "needs a tolerance: abs, rel or both"],
    "position = 0.1": ["need.position = 0.1", "such as { rel = 0.01 }"],
    "position = { rel = 0.0 }": ["need.position.rel = 0.0", "must be a number above 0"],
    "position = { abs = -1e-6 }": ["need.position.abs = -1e-06", "a number above 0"],
    "position = { rel = nan }": ["need.position.rel = nan", "a finite number"],
    "position = { relative = 0.1 }": ["need.position.relative", "did you mean 'rel'?"],
    "friction_law = 'any'": ["need.friction_law = 'any'", "'free'"],
}
"""Needs that cannot be judged, and what is said of them."""


def assert_refused(folder: Path, text: str, parts: Sequence[str]) -> str:
    path = scene_file(folder, text)
    with pytest.raises(SceneError) as caught:
        read_scene(path)
    message = str(caught.value)
    for part in (str(path), *parts):
        assert part in message, f"{part!r} is missing in: {message}"
    return message


CSV = '{ csv = "x.csv" }\n'
RECORDED = {
    f"[inputs]\nload = {CSV}": "inputs.load",
    f"[tuning]\nnormal_preload = {CSV}": "tuning.normal_preload",
    f"[beside.inputs]\nphase = {CSV}": "beside.inputs.phase",
}
"""Tables that take the values of a CSV file, and the key that does."""


@pytest.mark.parametrize("text", RECORDED)
def test_a_csv_that_a_run_goes_beyond_is_refused(tmp_path: Path, text: str) -> None:
    (tmp_path / "x.csv").write_text("time,value\n0.01,1\n0.05,2\n")
    run = "[run]\nstop_time = {}\nstep_size = 0.01\n"
    span = "from 0.01 s to 0.05 s, must have them from 0 s to 0.05 s"
    assert_refused(tmp_path, run.format(0.05) + text, [RECORDED[text], "x.csv", span])
    (tmp_path / "x.csv").write_text("time,value\n-1,1\n0.05,2\n")
    path = scene_file(tmp_path, run.format(0.05) + text)
    assert read_scene(path).schedule().times[-1] == 0.05
    message = assert_refused(tmp_path, run.format(0.06) + text, [RECORDED[text]])
    assert "must have them from 0 s to 0.06 s, the end of the run" in message


@pytest.mark.parametrize(
    ("text", "parts"),
    [
        ("[device]\nslider_mass = true\n", ["device.slider_mass", "True", "must be a number"]),
        ("[inputs]\nphase = { step = [[0, 0]] }\n", ["inputs.phase.step", "'steps'"]),
        ("[inputs]\nphase = {}\n", ["inputs.phase", "exactly one"]),
        ("[run]\nstop_time = 1.0\n", ["run", "step_size or steps_per_period"]),
        ('[sweep]\nvariable = "load"\nvalues = []\n', ["sweep.values", "at least one"]),
        ('[sweep]\nvariable = "fidelity"\nvalues = [1.5]\n', ["sweep", "1.5", "an integer"]),
        ("[run]\nstop_time = 1\nsteps_per_period = 1e308\n", ["run", "communication steps"]),
        ("device = 3\n", ["device = 3", "a table"]),
        ("[run]\nstop_time = 1\nstep_sizes = []\n", ["run.step_sizes", "at least 1 number"]),
        ("[run]\nstop_time = 1\nstep_sizes = [0.1, 0]\n", ["run.step_sizes[2]", "above 0"]),
        (
            "[run]\nstop_time = 1\nstep_size = 1\nstep_sizes = [1]\n",
            ["run", "step_size or steps_per_period or step_sizes"],
        ),
        (RUN + "start_time = inf\n", ["run.start_time = inf", "must be a finite number"]),
        (RUN + "read_twice = 1\n", ["run.read_twice = 1", "must be true or false"]),
        (RUN + "[tuning]\nnormal_prelod = 1\n", ["tuning", "did you mean 'normal_preload'?"]),
        (RUN + "[tuning]\nnormal_preload = {}\n", ["tuning.normal_preload", "exactly one"]),
        ("[tuning]\nnormal_preload = 1\n", ["tuning.normal_preload", "[run] is missing"]),
        ("[beside.device]\nslider_mas = 1\n", ["beside.device", "'slider_mass'"]),
        ("[beside.inputs]\nphse = 1\n", ["beside.inputs.phse", "'phase'"]),
        (
            RUN + '[[expect]]\nquantity = "beside_differences"\nvalue = 0\nwhy = "x"\n',
            ["beside_differences needs a second instance", "[beside] is missing"],
        ),
        (
            RUN
            + "[tuning]\nnormal_preload = { steps = [[0, 1], [0.1, 2]] }\n[[expect]]\n"
            + 'quantity = "steady_status"\nvalue = "steady"\nwhy = "x"\n',
            ["steady_status needs constant inputs and parameters"],
        ),
        ("run = 3\n", ["run = 3", "a table"]),
        ("expect = 3\n", ["expect = 3", "headed [[expect]]"]),
        ("[inputs]\nphase = { steps = 3 }\n", ["inputs.phase.steps = 3", "a list"]),
        ("[inputs]\nphase = { csv = 3 }\n", ["inputs.phase.csv = 3", "a text in quotes"]),
        (
            '[inputs]\nphase = { csv = "a.csv", between = "x" }\n',
            ["inputs.phase.between = 'x'", "'linear' or 'hold'"],
        ),
        ("[inputs]\nphse = 1.0\nlod = 2.0\n", ["inputs.phse", "inputs.lod"]),
        (f"{STEPS}[[expect]]\n{STEADY}", ["needs constant inputs"]),
        *((f"{RUN}[need]\n{need}\n", parts) for need, parts in NEEDS.items()),
        (
            "[need]\nbeat = { rel = 0.1 }\n",
            ["need.beat is measured in a run: [run] is missing"],
        ),
        (
            f"{STEPS}[need]\nblocking_force = {{ rel = 0.1 }}\n",
            ["need.blocking_force needs constant inputs"],
        ),
    ],
)
def test_a_mistake_is_named_with_key_value_and_requirement(
    tmp_path: Path, text: str, parts: list[str]
) -> None:
    message = assert_refused(tmp_path, text, parts)
    for jargon in ("Input should", "valid", "pattern", "Tuple", "dictionary", "validation"):
        assert jargon not in message, f"{jargon!r} is the schema's word: {message}"


@pytest.mark.parametrize(
    ("expect", "parts"),
    [
        ('quantity = "velocity"\nvalue = 1.0', ["signal", "needs a reference"]),
        (
            'quantity = "event_times"\nreference = "located_events"\nrelative = 1e-6',
            ["event_times needs a tube"],
        ),
        (
            'quantity = "position"\nreference = "averaged"\nrelative = 1e-6\ntube = 0.01',
            ["tube = 0.01", "located_events or bristle_state"],
        ),
        (
            'quantity = "position"\nreference = "located_events"\nrelative = 1e-6\ntube = 0.5',
            ["tube", "0.5", "0.25"],
        ),
        ('quantity = "steady_velocity"\nvalue = 1.0\nat_most = 2.0', ["exactly one"]),
        ('quantity = "steady_velocity"\nvalue = "fast"', ["number", "'fast'"]),
        (
            'quantity = "steady_velocity"\nvalue = true',
            ["[steady_velocity].value = True", "finite"],
        ),
        (
            'quantity = "steady_velocity"\nvalue = nan',
            ["[steady_velocity].value = nan", "finite"],
        ),
        ('quantity = "steady_velocity"\nvalue = 0.1', ["steady_velocity", "needs a tolerance"]),
        (
            'quantity = "velocity"\nreference = "located_events"',
            ["velocity", "a share of the peak"],
        ),
        (
            'quantity = "velocity"\nreference = "located_events"\nabsolute = 1e-6',
            ["velocity is a signal", "relative, not absolute"],
        ),
        ('quantity = "steady_status"\nat_most = 1.0', ["cannot have a bound"]),
    ],
)
def test_an_expectation_that_cannot_be_judged_is_refused(
    tmp_path: Path, expect: str, parts: list[str]
) -> None:
    assert_refused(tmp_path, f'[[expect]]\n{expect}\nwhy = "test"\n', parts)


@pytest.mark.parametrize(
    "expect",
    [
        'quantity = "reversals"\nvalue = 3',
        'quantity = "steady_status"\nvalue = "stuck"',
        'quantity = "contact_mode"\nreference = "located_events"',
        'quantity = "steady_velocity"\nat_most = 1.0',
        'quantity = "steady_velocity"\nvalue = 0.0\nabsolute = 0.0',
    ],
)
def test_counts_words_and_bounds_need_no_tolerance_and_0_is_one(
    tmp_path: Path, expect: str
) -> None:
    scene = read_scene(scene_file(tmp_path, RUN + f'[[expect]]\n{expect}\nwhy = "test"\n'))
    assert len(scene.expect) == 1
