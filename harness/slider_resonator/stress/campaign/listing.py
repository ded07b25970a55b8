"""The result of campaigns in words and as plain data."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from slider_resonator.output.readable import number_of
from slider_resonator.output.terminal import one_line
from slider_resonator.stress.campaign.campaign_run import Campaign
from slider_resonator.stress.campaign.random_case import RandomCase
from slider_resonator.stress.campaign.verdict import NO_REFERENCE, PASSED


def as_plain(campaigns: Sequence[Campaign]) -> dict[str, object]:
    """Return the results for JSON; of the cases those that did not pass."""
    return {
        "passed": all(campaign.passed for campaign in campaigns),
        "fmus": [
            {
                "fmu": campaign.fmu,
                "passed": campaign.passed,
                "seed": campaign.seed,
                "cases": len(campaign.verdicts),
                "not_run": campaign.not_run,
                "counts": campaign.counts,
                "wall_time": campaign.wall_time,
                "worst": list(campaign.worst.values()),
                "others": [one for one in campaign.verdicts if one.verdict != PASSED],
            }
            for campaign in campaigns
        ],
    }


def sentences(campaign: Campaign, cases: Sequence[RandomCase] = ()) -> str:
    """Return what a campaign found, in lines; of `cases` the values, too."""
    counts = ", ".join(f"{count} {verdict}" for verdict, count in campaign.counts.items())
    lines = [
        f"{one_line(campaign.fmu)}: seed {campaign.seed}, "
        f"{number_of(len(campaign.verdicts), 'case')}: {counts}; {campaign.wall_time:.0f} s"
    ]
    lines += [
        f"  nearest to the bound, {one.model}: {one.found:.2g} of it in {one.signal}, "
        f"case {one.number}"
        for one in campaign.worst.values()
    ]
    lines += [
        f"  {one.verdict}: case {one.number} ({one.model}): {one_line(one.reason)}"
        for one in campaign.verdicts
        if one.verdict not in (PASSED, NO_REFERENCE)
    ]
    return "\n".join([*lines, *map(_values, cases)])


def _values(case: RandomCase) -> str:
    schedule = case.schedule
    inputs = schedule.sampled()
    lines = [f"  case {case.number}, {case.model}:"]
    lines += [f"    {name} = {value!r}" for name, value in case.parameters.items()]
    lines.append(
        f"    {len(schedule.times) - 1} steps of {np.diff(schedule.times).min():.3g} to "
        f"{np.diff(schedule.times).max():.3g} s from {schedule.start_time:g} s on"
    )
    tuned = schedule.tuned()
    for i in (0, *schedule.changes()):
        values = dict(zip(schedule.tuning, tuned[i].tolist(), strict=True))
        phase, load, ratio = inputs[i].tolist()
        now = {"phase": phase, "load": load, "frequency_ratio": ratio} | values
        words = ", ".join(f"{name} = {value!r}" for name, value in now.items())
        lines.append(f"    from {float(schedule.times[i])!r} s on: {words}")
    return "\n".join(lines)
