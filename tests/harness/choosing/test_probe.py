"""What the errors of a candidate are measured against, and its cost."""

from math import inf

import pytest

from slider_resonator.choosing import probe as probes
from slider_resonator.choosing.candidate import Candidate
from slider_resonator.choosing.probe import CAUTION, Probe
from slider_resonator.device.model import Model
from slider_resonator.fmu.instance import Instance
from tests.harness.scene_text import scene_of

RUN = "[run]\ndrive_periods = {}\nsteps_per_period = 0.01\n[need]\n{} = {{ rel = {} }}\n"
RESOLVED = Candidate(Model(2, 0), 1e-8, None)
AVERAGED = Candidate(Model(0, 0, 1), 1e-8, None)


@pytest.mark.usefixtures("stated_costs")
def test_partial_probe_confirms_only_the_resolved_model(
    instance: Instance, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(probes, "LONGEST", 1e-3)
    text = f"[inputs]\nfrequency_ratio = 1.01\n{RUN.format(1e5, 'position', 0.1)}"
    probe = Probe(instance, scene_of(text))
    step = probe.scene.step_size
    averaged, _ = probe.measure(Candidate(AVERAGED.model, 1e-8, step))
    resolved, seconds = probe.measure(Candidate(RESOLVED.model, 1e-8, step))
    assert probe.covers == "beginning"
    assert averaged["position"].error == inf
    assert "too long" in averaged["position"].reason
    assert resolved["position"].error > 5.0 * CAUTION * 1e-12 * resolved["position"].magnitude
    assert seconds > 0.01


@pytest.mark.usefixtures("stated_costs")
def test_steps_of_no_effect_are_joined(instance: Instance, monkeypatch: pytest.MonkeyPatch) -> None:
    text = RUN.format(4000, "position", 0.1).replace("0.01", "1")
    found = []
    for steps in (probes.MAX_STEPS, 100):
        monkeypatch.setattr(probes, "MAX_STEPS", steps)
        monkeypatch.setattr(probes, "TIMED_STEPS", steps)
        probe = Probe(instance, scene_of(text))
        found.append(probe.measure(Candidate(AVERAGED.model, 1e-8, probe.scene.step_size)))
    one, joined = (errors["position"].error for errors, _ in found)
    assert joined == pytest.approx(one, rel=0.1)
    assert found[1][1] == pytest.approx(found[0][1], rel=0.1), "all steps cost"
