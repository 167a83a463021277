"""The runs that tests/faults/campaign.py disturbs: what each writes, and how it is known to be whole."""
import io
import json
import struct
import zipfile
from pathlib import Path


def npz_is_whole(content):
    try:
        with zipfile.ZipFile(io.BytesIO(content)) as archive:
            return archive.testzip() is None
    except zipfile.BadZipFile:
        return False


def number_in(npz, name):
    """The one number of an array of eight bytes."""
    with zipfile.ZipFile(npz) as archive:
        content = archive.read(name + ".npy")
    return struct.unpack("<Q", content[-8:])[0]


def is_whole(name, content):
    """Whether the bytes end as files of this kind do."""
    if name.endswith(".npz"):
        return npz_is_whole(content)
    if name.endswith(".png"):
        return content.startswith(b"\x89PNG") and content[-8:-4] == b"IEND"
    if name.endswith(".json"):
        return json.loads(content)["command"] != ""
    if name.endswith((".vtp", ".pvd")):
        return content.endswith(b"</VTKFile>\n")
    return content.endswith(b"\n") and content.count(b"\n") > 1


def without_times(name, content):
    """What every run has alike: clocks are in --stats, and in a column of traces."""
    if name.endswith(".json"):
        return json.loads(content)["command"]
    if name == "trace.csv":
        rows = [line.split(",") for line in content.decode().splitlines()]
        seconds = rows[0].index("seconds")
        return [row[:seconds] + row[seconds + 1:] for row in rows]
    return content


class Command:
    """A run of vorpipe: its arguments, the files that it puts in place together at the end, and folders,
    checkpoints and traces that it writes on the way."""

    def __init__(self, name, arguments, files, options, piped=None, keeps=False, resumes=False):
        self.name, self.arguments, self.files, self.options = name, arguments, files, options
        self.piped = piped  # what a closed pipe is tried with: options, of which {} is standard output or a pipe
        self.keeps = keeps  # a run that a signal ends writes what it has reached
        self.resumes = resumes

    def line(self, vorpipe, piped=None):
        words = [vorpipe, *self.arguments]
        for option, name in zip(self.options, self.files):
            words += [option, name]
        if piped:
            words += [word.format(piped) for word in self.piped]
        return words


def commands(scale):
    """One of each, `scale` times as large as they are usually."""
    cpu = ["--backend", "cpu", "--quiet"]
    sites = lambda count: ["--sites", f"random:{int(count * scale)}"]
    fluid = ["fluid", *cpu, "--every", "4", "--checkpoint", "checkpoint.npz", "--frames", "frames", "--size", "120",
             "--series", "series", "--trace", "trace.csv"]
    last, last_options = ["sites.csv", "cells.npz", "stats.json"], ["-o", "--cells", "--stats"]
    ends = ["sites.csv", "cells.npz", "trace.csv", "stats.json"]
    options = ["-o", "--cells", "--trace", "--stats"]
    pipe = ["-o", "-", "--format", "csv"]
    return [
        Command("cells", ["cells", *cpu, *sites(40000)], ["a.npz", "a.csv", "a.vtp", "stats.json"],
                ["-o", "-o", "-o", "--stats"], pipe),
        Command("transport", ["transport", *cpu, *sites(3000), "--size", "200"],
                ["sites.csv", "cells.npz", "trace.csv", "stats.json", "a.png"], [*options, "--picture"], pipe, keeps=True),
        Command("fluid", [*fluid, "--case", "taylor-green", "--particles", str(int(400 * scale)), "--steps", "70"],
                last, last_options, ["-o", "{}"], keeps=True, resumes=True),
        Command("free", [*fluid, "--case", "dam-break", "--particles", str(int(200 * scale)), "--time", "0.15"],
                last, last_options, ["-o", "{}"], keeps=True, resumes=True),
        Command("projection", [*fluid, "--case", "shear", "--particles", str(int(200 * scale)), "--steps", "40",
                               "--scheme", "projection"], last, last_options, ["-o", "{}"], keeps=True, resumes=True),
        Command("relax", ["relax", *cpu, *sites(6000), "--iterations", "20"], ends, options, pipe, keeps=True),
        Command("render", ["render", *cpu, *sites(20000), "--color", "area"], ["a.png", "a.svg", "ids.npy", "stats.json"],
                ["-o", "-o", "--ids", "--stats"], ["-o", "-", "--format", "png"]),
    ]


def contents(folder):
    """All files in a folder, but for those that a killed run may leave, by name."""
    return {str(path.relative_to(folder)): path.read_bytes() for path in sorted(Path(folder).rglob("*"))
            if path.is_file() and not path.name.startswith(".vorpipe-")}


def left_over(folder):
    return [path.name for path in Path(folder).rglob(".vorpipe-*")]
