"""Peers as methods on a task: their runs, what these take, and their searches by shooting."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from time import process_time

import numpy as np

from slider_resonator.studies.trade.method import Answer, Label, Method
from slider_resonator.studies.trade.motion import Motion
from slider_resonator.studies.trade.peers.peer import Peer
from slider_resonator.studies.trade.peers.registry import peers
from slider_resonator.studies.trade.result import PEER
from slider_resonator.studies.trade.shooting import shoot
from slider_resonator.studies.trade.task import Task


def peer_methods(task: Task) -> Iterator[Method]:
    """Yield the peers as methods."""
    for peer in peers(task):
        yield Method(
            _label(task, peer),
            partial(_run, task, peer),
            partial(_seconds, task, peer),
            sticks_not=peer.sticks_not,
            missing=peer.missing,
        )


def peer_answers(task: Task) -> Iterator[Answer]:
    """Yield the searches for steady motion and blocking force by those peers that can be shot."""
    for quantity in ("steady_velocity", "blocking_force"):
        for peer in peers(task):
            if peer.simulate is not None:
                find = partial(shoot, task, quantity, peer.simulate, peer.shooting)
                yield Answer(_label(task, peer), quantity, find)


def _label(task: Task, peer: Peer) -> Label:
    name = f"{peer.family}, {peer.setting}" if peer.setting else peer.family
    return Label(PEER, peer.family, name, task.device.friction_law, tolerance=peer.tolerance)


def _run(task: Task, peer: Peer, periods: int) -> Motion:
    times = task.readings(periods)
    if task.beat is not None:
        times = np.union1d(times, task.ends(periods))
    motion = peer.follow(task.device, task.held(periods), times)
    if task.beat is None:
        return motion
    ends = task.ends(periods)
    position = motion.position[np.searchsorted(times, ends)]
    return replace(motion, course=(ends[1:], np.diff(position) / task.period))


def _seconds(task: Task, peer: Peer, periods: int) -> float:
    began = process_time()
    motion = _run(task, peer, periods)
    return process_time() - began - (motion.start_cpu or 0.0)
