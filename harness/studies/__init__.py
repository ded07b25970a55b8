"""What proves the FMUs rather than uses them: run from a checkout, not installed."""

from collections.abc import Mapping

COMMANDS: Mapping[str, str] = {
    "bench": "Measure what a step costs in a C host.",
    "build": "Build the FMUs from the sources of a checkout.",
    "closed-loop": "Hold the slider's velocity with a controller.",
    "hosts": "Run table 1 in other simulators; compare with fmpy.",
    "mutants": "Make faulty FMUs and count those that validate rejects.",
    "paper": "Reproduce the figures and statements of the paper.",
}
"""Name to summary of what `python -m harness` adds to the commands that are installed."""
