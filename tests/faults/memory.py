"""Runs of vorpipe that are refused memory, at one allocation or from one on.

    memory.py VORPIPE REFUSALS.so [--moments N | --each] [--only NAME,...] [--seed S]

Each ends with exit code 3 and one line that speaks of memory, and its files are the old ones, or all of them those of
an undisturbed run; or, where a single allocation could be done without, with 0 and those files. Exits with 1 where one of that is not so.
"""
import argparse
import json
import os
import random
import struct
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path

from commands import contents, left_over, without_times

OLD = b"an older file\n"


def write_inputs(folder):
    """Small sites in each kind of file that is read."""
    places = [(0.1 + 0.8 * random.Random(k).random(), 0.1 + 0.8 * random.Random(-k - 1).random()) for k in range(40)]
    rows = [f"{x},{y},name {k}" for k, (x, y) in enumerate(places)]
    (folder / "sites.csv").write_text("x,y,name\n" + "\n".join(rows) + "\n")
    (folder / "sites.xyz").write_text("".join(f"{x} {y}\n" for x, y in places))
    features = [{"type": "Feature", "properties": {"k": k}, "geometry": {"type": "Point", "coordinates": place}}
                for k, place in enumerate(places)]
    (folder / "sites.geojson").write_text(json.dumps({"type": "FeatureCollection", "features": features}))
    (folder / "sites.wkt").write_text("".join(f"POINT ({x} {y})\n" for x, y in places))
    head = "{'descr': '<f8', 'fortran_order': False, 'shape': (%d, 2), }" % len(places)
    head = head.ljust(117) + "\n"
    (folder / "sites.npy").write_bytes(b"\x93NUMPY\x01\x00" + struct.pack("<H", len(head)) + head.encode()
                                       + b"".join(struct.pack("<dd", *place) for place in places))
    (folder / "outline.wkt").write_text("POLYGON ((0 0, 1 0, 1 1, 0.5 0.9, 0 1, 0 0))\n")


def runs():
    """Names, arguments and the files that they write."""
    few = ["--sites", "random:60"]
    cells = [("cells", ["cells", *few], [f"out.{kind}"]) for kind in
             ("npz", "csv", "geojson", "gpkg", "svg", "wkt", "ply", "obj", "vtp", "vtk")]
    read = [("reading", ["cells", "--sites", f"../in/sites.{kind}"], ["out.csv"]) for kind in
            ("csv", "xyz", "geojson", "wkt", "npy")]
    others = [
        ("outline", ["cells", *few, "--domain", "../in/outline.wkt"], ["out.npz"]),
        ("periodic", ["cells", *few, "--periodic", "xy"], ["out.npz"]),
        ("flann", ["cells", *few, "--search", "flann"], ["out.npz"]),
        ("check", ["cells", *few, "--check"], ["out.npz"]),
        ("render", ["render", *few, "--size", "200", "--legend", "--color", "area"], ["out.png"]),
        ("render", ["render", *few, "--size", "60"], ["out.pdf"]),
        ("relax", ["relax", *few, "--iterations", "3"], ["out.csv"]),
        ("transport", ["transport", *few], ["out.csv"]),
        ("surface", ["transport", *few, "--fill", "0.5"], ["out.csv"]),
        ("fluid", ["fluid", "--case", "taylor-green", "--particles", "30", "--steps", "2", "--checkpoint", "on.npz"],
         ["out.csv"]),
        ("free", ["fluid", "--case", "dam-break", "--particles", "30", "--steps", "2", "--series", "series"], ["out.csv"]),
    ]
    return cells + read + others


class Run:
    def __init__(self, vorpipe, refusals, folder, arguments, files):
        self.line = [vorpipe, *arguments, "--backend", "cpu", "--threads", "2", "--quiet"]
        for name in files:
            self.line += ["-o", name]
        self.folder, self.files, self.refusals = folder, files, refusals

    def start(self, settings):
        """What is left by a run with these variables of its environment."""
        with tempfile.TemporaryDirectory(dir=self.folder) as place:
            for name in self.files:
                (Path(place) / name).write_bytes(OLD)
            count = Path(self.folder) / "count"
            environment = {**os.environ, "LD_PRELOAD": self.refusals, "VORPIPE_COUNT_MEMORY": str(count), **settings}
            done = subprocess.run(self.line, cwd=place, env=environment, capture_output=True, timeout=120)
            found = contents(place)
            return done, found, left_over(place), int(count.read_text()) if count.exists() else 0

    def fault(self, nth, everything, whole):
        """What is wrong when an allocation is refused; and how it ended."""
        done, found, left, _ = self.start({"VORPIPE_REFUSE_MEMORY": str(nth),
                                           "VORPIPE_REFUSE_ALL": "1" if everything else "0"})
        lines = [line for line in done.stderr.decode().splitlines() if not line.startswith("vorpipe: note: ")]
        if left:
            return f"left over: {left}", ""
        if done.returncode == 0:
            same = all(without_times(name, found[name]) == without_times(name, whole[name]) for name in self.files)
            return ("" if same and not lines else f"exit code 0, {lines}, files the same: {same}"), "done"
        if done.returncode != 3 or len(lines) != 1 or not lines[0].startswith("vorpipe: "):
            return f"exit code {done.returncode}: {lines}", ""
        if "memory" not in lines[0]:
            return f"a line without memory: {lines}", ""
        # At the very end it is the summary that finds no memory.
        new = [name for name in self.files if found[name] != OLD]
        if new and (new != self.files or
                    any(without_times(name, found[name]) != without_times(name, whole[name]) for name in new)):
            return f"files that are neither old nor whole: {new}", ""
        return "", "refused after all was written" if new else "refused"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("vorpipe")
    parser.add_argument("refusals")
    parser.add_argument("--moments", type=int, default=200, help="of each run, half of them for all that follow [200]")
    parser.add_argument("--each", action="store_true", help="every allocation of each run")
    parser.add_argument("--only", default="", help="names of runs, separated by commas [all]")
    parser.add_argument("--seed", type=int, default=None, help="of the moments [a new one, printed]")
    options = parser.parse_args()
    seed = options.seed if options.seed is not None else random.SystemRandom().randrange(10**9)
    print(f"seed {seed}", flush=True)
    only = options.only.split(",") if options.only else []
    faults = 0
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "in").mkdir()
        write_inputs(Path(folder) / "in")
        for name, arguments, files in runs():
            if only and name not in only:
                continue
            run = Run(os.path.abspath(options.vorpipe), os.path.abspath(options.refusals), folder, arguments, files)
            done, whole, _, count = run.start({})
            if done.returncode != 0 or count == 0:
                sys.exit(f"{name}: the whole run: {done.returncode} {done.stderr.decode()}")
            source = random.Random(f"{seed} {name} {files} {arguments}")
            # Most is taken by options, which come first and are the same for all.
            moments = [(nth, everything) for nth in range(1, count + 1) for everything in (False, True)] \
                if options.each else [(source.randint(1 if k % 4 == 0 else 1 + count * 9 // 10, count), k % 2 == 0)
                                      for k in range(options.moments)]
            ends = Counter()
            for nth, everything in moments:
                fault, end = run.fault(nth, everything, whole)
                ends[end or "FAULT"] += 1
                if fault:
                    faults += 1
                    print(f"FAULT {' '.join(run.line[1:])}: {nth}{' and all that follow' if everything else ''}: {fault}",
                          flush=True)
            print(f"{name} {files[0]}: {count} allocations; "
                  + ", ".join(f"{number} {end}" for end, number in sorted(ends.items())), flush=True)
    print(f"{faults} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
