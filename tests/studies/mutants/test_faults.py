from __future__ import annotations

from slider_resonator.device.interface import INPUTS, INTEGERS, PARAMETERS
from studies.mutants.faults import FAULTS, fault_mutants, missing_names


def test_a_module_that_lacks_a_name_is_told() -> None:
    every_name = " ".join(name for fault in FAULTS for name in fault.needs)
    modules = {fault.file: every_name for fault in FAULTS}
    assert missing_names(modules) == []
    assert missing_names({**modules, "sliding.py": "nothing"}) == ["sliding.py: Stick"]


def test_a_fault_is_appended_and_takes_the_place_of_a_function() -> None:
    text = "def _prepare(values):\n    return values\n"
    scaled = next(m for m in fault_mutants("component.py", "p", text) if m.kind == "parameter")
    assert scaled.new.startswith(text)
    assert scaled.line == 3
    assert scaled.change == "slider_mass acts 1 % too large"
    namespace: dict[str, object] = {}
    exec(scaled.new, namespace)
    prepare = namespace["_prepare"]
    assert callable(prepare)
    assert prepare({"slider_mass": 2.0, "load": 1.0}) == {"slider_mass": 2.02, "load": 1.0}


def test_every_real_parameter_and_input_is_off_by_a_per_cent_once() -> None:
    names = [f.change.split()[0] for f in FAULTS if f.kind == "parameter"]
    assert len(names) == len(set(names))
    assert set(names) == {*PARAMETERS, *INPUTS} - INTEGERS


def test_every_50th_event_is_passed_over() -> None:
    text = "def first_zero(watch, limit, start=0.0):\n    return watch\n"
    dropped = next(m for m in fault_mutants("events.py", "p", text) if "50th" in m.change)
    namespace: dict[str, object] = {}
    exec(dropped.new, namespace)
    first_zero = namespace["first_zero"]
    assert callable(first_zero)
    found = [first_zero(0.25, 1.0) for _ in range(100)]
    assert [i for i, zero in enumerate(found, 1) if zero is None] == [50, 100]
