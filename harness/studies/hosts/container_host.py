"""fmu_manipulation_toolbox: two FMUs coupled in a container FMU, which runs in fmpy.

The `partner` of a job leads: its blocking force is the load of the job's FMU. Parameters and the
other inputs are the same for both.
"""

import json
import shutil
import subprocess
import sys
import tempfile
from dataclasses import replace
from pathlib import Path

from studies.hosts import fmpy_host
from studies.hosts.job import Job, Rows, serve

LEADER, FOLLOWER, PAIR = "leader.fmu", "follower.fmu", "pair.fmu"


def run(job: Job) -> Rows:
    """Build the container and step it."""
    if job.partner is None:
        raise ValueError("partner = None refused: must be an FMU to couple with")
    with tempfile.TemporaryDirectory(prefix="slider-resonator-") as name:
        folder = Path(name)
        shutil.copy(job.partner, folder / LEADER)
        shutil.copy(job.fmu, folder / FOLLOWER)
        (folder / "pair.json").write_text(json.dumps(assembly(job)), encoding="utf-8")
        command = [sys.executable, "-m", "fmu_manipulation_toolbox.cli.fmucontainer"]
        command += ["-container", "pair.json", "-fmu-directory", "."]
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
        if not (folder / PAIR).is_file():
            raise RuntimeError(f"fmucontainer made no container: {done.stderr or done.stdout}")
        return fmpy_host.run(replace(job, fmu=str(folder / PAIR), start={}, partner=None))


def assembly(job: Job) -> dict[str, object]:
    """Return the description of the container."""
    both = (LEADER, FOLLOWER)
    shared = [[name, fmu, name] for name in job.inputs if name != "load" for fmu in both]
    return {
        "name": PAIR,
        "step_size": job.step,
        "sequential": True,
        "auto_input": False,
        "auto_output": False,
        "auto_link": False,
        "fmu": list(both),
        "start": [[fmu, name, value] for fmu in both for name, value in job.start.items()],
        "input": [["load", LEADER, "load"], *shared],
        "link": [[LEADER, "blocking_force", FOLLOWER, "load"]],
        "output": [[FOLLOWER, name, name] for name in job.outputs],
    }


if __name__ == "__main__":
    serve(run)
