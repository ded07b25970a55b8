"""Judge the variants of an FMU, each in a process of its own, some at a time."""

import hashlib
import pickle
import threading
from collections import Counter
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from contextlib import ExitStack
from dataclasses import astuple
from pathlib import Path

from slider_resonator.output.files import temporary_folder
from slider_resonator.output.journal import Journal
from slider_resonator.output.progress import counted
from studies.mutants.bench import Judging, bench_of
from studies.mutants.trial import BenchPoint, point_name, trial
from studies.mutants.verdict import EQUIVALENT, REJECTED, STATUSES, SURVIVED, Variant, Verdict


def judge_variants(
    original: Path,
    variants: Sequence[Variant],
    write: Callable[[Variant, Path], None],
    judging: Judging,
) -> tuple[Verdict[Variant], ...]:
    """Return the verdict on each variant of the FMU `original`; `write` makes its file.

    Scenes that have rejected variants of the same file come first, then the cheapest. Verdicts that
    the journal holds from an earlier run are taken from there. Raises HarnessError as `Journal`
    does, otherwise as `bench_of` and `write` do.
    """
    rejecting: Counter[tuple[str, str]] = Counter()
    stopped = threading.Event()
    with ExitStack() as resources:
        folder = resources.enter_context(temporary_folder())
        bench = bench_of(original, judging)
        journal = _journal(judging.journal or folder / "kept", original, bench)
        kept_in = resources.enter_context(journal)
        kept = {mark: parts for mark, *parts in kept_in.entries}

        def judged(variant: Variant) -> Verdict[Variant]:
            if _mark(variant) in kept:
                return Verdict(variant, *kept[_mark(variant)])
            first = sorted(bench, key=lambda p: (-rejecting[variant.file, point_name(p)], p.cost))
            fmu = folder / f"{_mark(variant)}.fmu"
            write(variant, fmu)
            tried = trial(fmu, first, judging.time_limit, stopped)
            fmu.unlink()
            if tried.rejection is None:
                status = SURVIVED if tried.worse else EQUIVALENT
                reason = ": ".join(filter(None, (STATUSES[status], tried.worse)))
                return Verdict(variant, status, reason=reason)
            rejecting[variant.file, tried.rejection.scene] += 1
            return Verdict(variant, REJECTED, *astuple(tried.rejection))

        verdicts: dict[str, Verdict[Variant]] = {}
        with ThreadPoolExecutor(judging.jobs) as pool:
            try:
                for future in as_completed([pool.submit(judged, one) for one in variants]):
                    one = future.result()
                    mark = _mark(one.variant)
                    verdicts[mark] = one
                    if mark not in kept:
                        kept_in.add([[mark, one.status, one.scene, one.quantity, one.reason]])
                    done, total = len(verdicts), len(variants)
                    label = f"{one.status}: {one.variant.name}"
                    judging.progress(counted(label, done - 1, total), done / total)
            finally:
                stopped.set()
                pool.shutdown(cancel_futures=True)
    return tuple(verdicts[_mark(variant)] for variant in variants)


def _journal(path: Path, fmu: Path, bench: Sequence[BenchPoint]) -> Journal:
    """Open the journal of runs on an FMU at these points."""
    content = hashlib.sha256(fmu.read_bytes())
    for point in bench:
        content.update(repr((point_name(point), vars(point.scene))).encode())
        content.update(pickle.dumps(point.expected))
    remedy = "move the file away or name another one"
    return Journal(path, "mutation run", content.hexdigest(), remedy)


def _mark(variant: Variant) -> str:
    """Return what a variant is known by in a journal."""
    text = "\n".join([variant.name, variant.file, variant.old, variant.new])
    return hashlib.sha256(text.encode()).hexdigest()
