"""Runs of vorpipe that are killed, asked to stop, or have no more room at random moments.

    campaign.py VORPIPE [--moments N] [--only cells,fluid] [--kinds kill,disk] [--scale S] [--seed S]

Every named file is the old one or the whole new one afterwards, or, where a run keeps what it has reached, whole;
no file is left over but by SIGKILL; the exit code and the one line on standard error are right; and a checkpoint
goes on to the bytes of a run that nothing disturbed. Exits with 1 where one of that is not so.
"""
import argparse
import fcntl
import os
import random
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

from commands import commands, contents, is_whole, left_over, number_in, without_times

OLD = b"an older file\n"
SIGNALS = {"kill": signal.SIGKILL, "int": signal.SIGINT, "term": signal.SIGTERM, "hup": signal.SIGHUP,
           "xcpu": signal.SIGXCPU, "twice": signal.SIGINT}
KINDS = [*SIGNALS, "limit", "disk", "pipe"]


class Fault(Exception):
    pass


def expect(truth, what):
    if not truth:
        raise Fault(what)


def lines_of(process, errors):
    """The lines of standard error that are no notes."""
    lines = [line for line in errors.decode().splitlines() if not line.startswith("vorpipe: note: ")]
    expect(all(line.startswith("vorpipe: ") for line in lines), f"standard error: {errors.decode()!r}")
    return lines


class Trial:
    """One command with its undisturbed run, in a folder of its own."""

    def __init__(self, vorpipe, command, folder, can_mount):
        self.vorpipe, self.command, self.folder, self.can_mount = vorpipe, command, Path(folder), can_mount
        self.whole = self.folder / "whole"
        self.whole.mkdir(parents=True)
        began = time.monotonic()
        done = subprocess.run(command.line(vorpipe), cwd=self.whole, capture_output=True)
        self.seconds = time.monotonic() - began
        expect(done.returncode == 0 and not done.stderr, f"the whole run: {done.returncode} {done.stderr.decode()}")
        self.expected = contents(self.whole)
        self.bytes = sum(map(len, self.expected.values()))
        self.largest = max(map(len, self.expected.values()))
        self.outcomes = Counter()

    def disturb(self, kind, random_source):
        """Once, at a moment from the source of random numbers; what came of it, in a word."""
        place = self.folder / "now"
        place.mkdir()
        size = int(self.bytes * random_source.random()) + (1 << 16)
        mounted = kind == "disk" and self.can_mount
        if mounted:
            subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size}", "none", place], check=True)
        try:
            return self.run_in(place, kind, random_source)
        finally:
            if mounted:
                subprocess.run(["umount", place], check=True)
            shutil.rmtree(place)

    def run_in(self, place, kind, random_source):
        for name in self.command.files:
            (place / name).write_bytes(OLD)
        limit = int(self.largest * random_source.random() ** 2)

        def prepare():
            # nohup ignores it, and so would the run.
            signal.signal(signal.SIGHUP, signal.SIG_DFL)
            if kind == "limit":
                resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))

        line = self.command.line(self.vorpipe, self.piped_to(place) if kind == "pipe" else None)
        began = time.monotonic()
        process = subprocess.Popen(line, cwd=place, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                   preexec_fn=prepare)
        moment = random_source.random() * 1.1 * self.seconds
        if kind in SIGNALS:
            time.sleep(max(0, moment - (time.monotonic() - began)))
            process.send_signal(SIGNALS[kind])
            if kind == "twice":
                time.sleep(0.03 * random_source.random())
                process.send_signal(signal.SIGINT)
        if kind == "pipe":
            self.close_pipe(place, process, random_source)
            errors = process.stderr.read()
            process.wait()
        else:
            _, errors = process.communicate()
        return self.judge(place, kind, process, errors)

    def piped_to(self, place):
        """What stands for the end of a pipe: a fluid has no option for standard output."""
        if "{}" not in self.command.piped:
            return "-"
        os.mkfifo(place / "pipe.csv")
        return "pipe.csv"

    def close_pipe(self, place, process, random_source):
        """Reads a part of what comes, and closes. A pipe that holds little shows it soon."""
        part = int(20000 * random_source.random())
        pipe = place / "pipe.csv"
        source = open(pipe, "rb") if pipe.exists() else process.stdout
        if hasattr(fcntl, "F_SETPIPE_SZ"):
            fcntl.fcntl(source, fcntl.F_SETPIPE_SZ, 4096)
        source.read(part)
        source.close()
        if pipe.exists():
            pipe.unlink()

    def judge(self, place, kind, process, errors):
        code, lines = process.returncode, lines_of(process, errors)
        found = contents(place)
        names = [name for name in self.command.files]
        left = left_over(place)
        expect(kind == "kill" or not left, f"left over: {left}")
        old = [name for name in names if found[name] == OLD]
        new = [name for name in names if name not in old]
        if code == 0:
            expect(not lines and not old, f"exit code 0: {lines}, old files {old}")
            self.same(found, names)
            return "done before"
        if code < 0 and kind != "kill":
            # Before main there is no handler yet.
            expect(code == -SIGNALS[kind] and len(old) == len(names), f"exit code {code}")
            return "before it began"
        if kind == "kill":
            expect(code == -signal.SIGKILL, f"exit code {code}")
            self.same(found, new)
            end = "old files" if old else "new files"
        else:
            expected = 128 + SIGNALS[kind] if kind in SIGNALS else 3
            expect(code == expected, f"exit code {code}, not {expected}: {lines}")
            expect(len(lines) == 1, f"standard error: {lines}")
            expect(not old or not new, f"old {old} and new {new}")
            kept = bool(new)
            expect(not kept or kind in SIGNALS and self.command.keeps, f"new files {new}")
            for name in new:
                expect(is_whole(name, found[name]), f"{name} is not whole")
            end = "what was reached" if kept else "old files"
        for name, content in found.items():
            if name not in names and not name.startswith("pipe"):
                expect(is_whole(name, content), f"{name} is not whole")
        if self.command.resumes and "checkpoint.npz" in found:
            self.resume(place, found)
            end += ", went on"
        return end

    def same(self, found, names):
        for name in names:
            if without_times(name, found[name]) != without_times(name, self.expected[name]):
                raise Fault(f"{name} is another one than that of an undisturbed run")

    def resume(self, place, found):
        """Goes on with the checkpoint, in the same folders, to the end of the undisturbed run."""
        step = number_in(place / "checkpoint.npz", "step")
        last = number_in(self.whole / "checkpoint.npz", "step")
        line = self.command.line(self.vorpipe)
        begin = line.index("--case")
        line[begin:begin + 2] = ["--resume", "checkpoint.npz"]
        begin = line.index("--particles")
        del line[begin:begin + 2]
        for option in ("--steps", "--time"):
            if option in line:
                begin = line.index(option)
                line[begin:begin + 2] = ["--steps", str(last - step)] if option == "--steps" else []
        if os.path.ismount(place):
            subprocess.run(["mount", "-o", "remount,size=1g", place], check=True)
        done = subprocess.run(line, cwd=place, capture_output=True)
        expect(done.returncode == 0 and not done.stderr, f"going on from {step}: {done.stderr.decode()}")
        now = contents(place)
        now.pop("pipe.csv", None)
        # A step at which a run ended stays in the series.
        extra = {name for name in now if name not in self.expected}
        expect(all(name.startswith("series/step-") for name in extra), f"too many files after {step}: {extra}")
        names = [name for name in self.expected if name not in ("trace.csv", "series/series.pvd")]
        missing = [name for name in names if name not in now]
        expect(not missing, f"after {step}, missing: {missing}")
        self.same(now, names)
        rows = without_times("trace.csv", now["trace.csv"])[2:]
        expected = without_times("trace.csv", self.expected["trace.csv"])
        expect(rows == expected[len(expected) - len(rows):], f"another trace after {step}")


def can_mount(folder):
    """A disk of a few bytes takes root."""
    probe = Path(folder) / "probe"
    probe.mkdir()
    done = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=4096", "none", probe], capture_output=True)
    if done.returncode == 0:
        subprocess.run(["umount", probe], check=True)
    probe.rmdir()
    return done.returncode == 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("vorpipe")
    parser.add_argument("--moments", type=int, default=200, help="of each kind in each command [200]")
    parser.add_argument("--only", default="", help="names of commands, separated by commas [all]")
    parser.add_argument("--kinds", default=",".join(KINDS), help="what happens [%(default)s]")
    parser.add_argument("--scale", type=float, default=1, help="how large the runs are [1]")
    parser.add_argument("--seed", type=int, default=None, help="of the moments [a new one, printed]")
    options = parser.parse_args()
    seed = options.seed if options.seed is not None else random.SystemRandom().randrange(10**9)
    print(f"seed {seed}", flush=True)
    only = options.only.split(",") if options.only else []
    faults = 0
    with tempfile.TemporaryDirectory() as folder:
        mounts = can_mount(folder)
        kinds = [kind for kind in options.kinds.split(",") if kind != "disk" or mounts]
        if len(kinds) < len(options.kinds.split(",")):
            print("disk: left out, since mounting a small disk takes root")
        for command in commands(options.scale):
            if only and command.name not in only:
                continue
            trial = Trial(os.path.abspath(options.vorpipe), command, Path(folder) / command.name, mounts)
            print(f"{command.name}: {trial.seconds:.2f} s, {trial.bytes} bytes", flush=True)
            for kind in kinds:
                ends = Counter()
                for moment in range(options.moments):
                    try:
                        ends[trial.disturb(kind, random.Random(f"{seed} {command.name} {kind} {moment}"))] += 1
                    except Fault as fault:
                        faults += 1
                        print(f"FAULT {command.name} {kind} {moment}: {fault}", flush=True)
                print(f"  {kind:6} " + ", ".join(f"{count} {end}" for end, count in sorted(ends.items())), flush=True)
    print(f"{faults} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
