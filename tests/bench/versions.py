#!/usr/bin/env python3
"""This version against the last: versions.py [--last REF] [--count N] [--rounds N] [--threads N] [--jobs NAME,...]

Builds the preset release of this tree and of REF, by default the last tag, in build/last; makes sites of each kind by
kinds.py; and runs both versions in turn. Prints a table in Markdown: the processor seconds of whole processes, their
memory at the peak, and this version's share of the last one's, medians of all rounds. A part of the steps to a release.
"""
import argparse
import importlib.util
import os
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

if not importlib.util.find_spec("numpy"):
    sys.exit("versions.py: this Python has no NumPy, which kinds.py needs (Debian: python3-numpy, /usr/bin/python3)")

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = "build/release/src/cli/vorpipe"


def shell(*command, **how):
    """The output of a command that must succeed."""
    return subprocess.run(command, check=True, text=True, stdout=subprocess.PIPE, **how).stdout.strip()


def build_last(ref):
    """The program of REF, built beside; trees of two versions share no files."""
    tree = ROOT / "build/last"
    commit = shell("git", "-C", ROOT, "rev-parse", "--verify", ref + "^{commit}")
    if not tree.exists():
        shell("git", "-C", ROOT, "worktree", "prune")
        shell("git", "-C", ROOT, "worktree", "add", "--detach", tree, commit)
    shell("git", "-C", tree, "checkout", "--detach", commit, stderr=subprocess.DEVNULL)
    for step in (["cmake", "--preset", "release"], ["cmake", "--build", "--preset", "release", "--target", "vorpipe"]):
        shell(*step, cwd=tree)
    return tree / PROGRAM


def measure(command):
    """Processor seconds, seconds on the clock and memory at the peak, in MB, of one process."""
    begun = time.perf_counter()
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    message = process.stderr.read().decode()
    _, status, used = os.wait4(process.pid, 0)
    clock = time.perf_counter() - begun
    if os.waitstatus_to_exitcode(status) != 0:
        sys.exit(f"versions.py: {' '.join(map(str, command))}: {message}")
    return used.ru_utime + used.ru_stime, clock, used.ru_maxrss / 1000


def jobs_of(kinds, folder):
    """What is run, by name: arguments of the program."""
    jobs = {f"cells, {path.stem}": ["cells", "--sites", path, "--stats", folder / "stats.json"] for path in kinds}
    random, clusters = (next(path for path in kinds if path.stem == stem) for stem in ("random", "clusters"))
    jobs["random, .npz"] = ["cells", "--sites", random, "-o", folder / "cells.npz"]
    jobs["random, .geojson"] = ["cells", "--sites", random, "-o", folder / "cells.geojson"]
    jobs["clusters, picture"] = ["render", "--sites", clusters, "--size", "1000x1000", "-o", folder / "clusters.png"]
    jobs["clusters, picture by area"] = [*jobs["clusters, picture"][:-2], "--color", "area", "-o", folder / "areas.png"]
    return jobs


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--last", metavar="REF", help="the version to compare with; by default the last tag")
    arguments.add_argument("--count", type=int, default=1_000_000, help="how many sites, 1000000 by default")
    arguments.add_argument("--rounds", type=int, default=5)
    arguments.add_argument("--threads", type=int, default=2)
    arguments.add_argument("--backend", default="cpu")
    arguments.add_argument("--jobs", default="", help="parts of the names of jobs, with commas between: these alone")
    given = arguments.parse_args()
    last = given.last
    if not last:
        try:
            last = shell("git", "-C", ROOT, "describe", "--tags", "--abbrev=0", stderr=subprocess.DEVNULL)
        except subprocess.CalledProcessError:
            sys.exit("versions.py: --last: name the version to compare with, as there is no tag")
    shell(ROOT / "run", "--version")
    programs = [build_last(last), ROOT / PROGRAM]
    with tempfile.TemporaryDirectory() as made:
        folder = Path(made)
        shell(sys.executable, ROOT / "tests/bench/kinds.py", folder / "kinds", str(given.count))
        jobs = jobs_of(sorted((folder / "kinds").glob("*.npy")), folder)
        wanted = [part for part in given.jobs.split(",") if part]
        print(f"{given.count} sites, {given.backend}, {given.threads} threads, medians of {given.rounds}; "
              f"{last} is {shell('git', '-C', ROOT, 'rev-parse', '--short', last)}, "
              f"this is {shell('git', '-C', ROOT, 'describe', '--always', '--dirty')}\n")
        print(f"| | {last}, s | this, s | share | on the clock | {last}, MB | this, MB |\n|---|--:|--:|--:|--:|--:|--:|")
        for name, job in jobs.items():
            if wanted and not any(part in name for part in wanted): continue
            common = ["--backend", given.backend, "--threads", str(given.threads)]
            runs = [[measure([program, *job, *common]) for program in programs] for _ in range(given.rounds)]
            before, after = ([statistics.median(run[side][k] for run in runs) for k in range(3)] for side in (0, 1))
            print(f"| {name} | {before[0]:.3f} | {after[0]:.3f} | {after[0] / before[0]:.2f} | "
                  f"{after[1] / before[1]:.2f} | {before[2]:.0f} | {after[2]:.0f} |", flush=True)
    return 0


sys.exit(main())
