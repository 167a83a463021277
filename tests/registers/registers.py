#!/usr/bin/env python3
"""What AMD's compiler makes of the kernels, on a machine without a card: registers.py VORPIPE NULL_CARD [--hold TABLE]

Prints, for each card and kernel, vector registers, what is spilled or in scratch memory, how many waves run side by side
on a SIMD, and instructions. NULL_CARD is the folder of libvulkan.so.1 that null_card.cpp becomes. --hold compares with
a table: a kernel that is in it has at least as many waves as there; all that were compiled spill nothing and have no
scratch memory. Cards that this Mesa does not know are left out. Exit code 77 where its driver RADV is missing.
"""
import argparse
import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

CARDS = {"NAVI31": "RDNA 3", "NAVI21": "RDNA 2", "NAVI10": "RDNA 1", "VEGA10": "GCN 5", "POLARIS10": "GCN 4"}
DRIVERS = [path for folder in ("/usr/share", "/usr/local/share", "/etc")
           for path in Path(folder, "vulkan/icd.d").glob("radeon_icd*.json")]
PROPERTIES = {"registers": "VGPRs", "spilled": "Spilled VGPRs", "scratch": "Scratch size",
              "waves": "Subgroups per SIMD", "instructions": "Instructions"}
LINE = "{card:<10} {kernel:<28} {registers:>9} {spilled:>7} {scratch:>7} {waves:>5} {instructions:>12}"


def compiled(vorpipe, null_card, card, sites):
    """The compute kernels of a run for these sites, by name, each with its properties; none where the card is unknown."""
    with tempfile.TemporaryDirectory() as folder:
        stats = Path(folder, "stats.json")
        environment = dict(os.environ, LD_LIBRARY_PATH=null_card, VK_DRIVER_FILES=str(DRIVERS[0]), RADV_FORCE_FAMILY=card,
                           VK_ICD_FILENAMES=str(DRIVERS[0]), RADV_DEBUG="shaderstats", MESA_SHADER_CACHE_DISABLE="1")
        environment.pop("VORPIPE_VALIDATION", None)
        run = subprocess.run([vorpipe, "cells", "--backend", "vulkan-compute", "--sites", sites, "--stats", stats],
                             env=environment, capture_output=True, text=True)
        if "Unknown family" in run.stderr: return {}
        if run.returncode != 0: sys.exit(f"registers.py: {card}: {run.stderr}")
        names = [pipeline["name"] for pipeline in json.loads(stats.read_text())["pipelines"]]
    # The driver prints each pipeline's shaders when it is made. Those that draw have a vertex shader and a pixel shader.
    printed = re.findall(r"^(\w+) Shader.*?SHADER STATS[^\n]*\n(.*?)^\*{20}", run.stderr + run.stdout, re.M | re.S)
    kernels = [text for stage, text in printed if stage == "Compute"]
    names = [name for name in names if not name.endswith("_vert")]
    if len(kernels) != len(names):
        sys.exit(f"registers.py: {card}: {len(kernels)} compute shaders were printed for {len(names)} pipelines: {names}")
    return {name: {key: int(re.search(rf"^{word}: (\d+)", text, re.M)[1]) for key, word in PROPERTIES.items()}
            for name, text in zip(names, kernels)}


def written_down(table):
    """The waves of each card's kernels in a table that was printed."""
    lines = [line.split() for line in Path(table).read_text().splitlines() if line and not line.startswith("#")]
    return {(card, kernel): int(waves) for card, kernel, _, _, _, waves, _ in lines[1:]}


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("vorpipe")
    arguments.add_argument("null_card")
    arguments.add_argument("--hold", metavar="TABLE")
    arguments.add_argument("--cards", default=",".join(CARDS), help="of " + ", ".join(CARDS))
    given = arguments.parse_args()
    if not DRIVERS:
        reason = "there is no driver RADV (Debian: mesa-vulkan-drivers)"
        print("SKIPPED:", reason)
        if path := os.environ.get("VORPIPE_SKIPPED"):
            with open(path, "a") as report:
                report.write(f"{os.environ.get('VORPIPE_TEST_NAME', 'registers')}\t\t{reason}\n")
        return 77
    least = written_down(given.hold) if given.hold else {}
    faults = []
    print(LINE.format(card="card", kernel="kernel", **{key: key for key in PROPERTIES}))
    with tempfile.TemporaryDirectory() as folder:
        weighted = Path(folder, "weighted.csv")
        weighted.write_text("x,y,weight\n" + "".join(f"{k * 0.618034 % 1},{k / 1000},{k % 7 * 1e-4}\n" for k in range(1000)))
        for card in given.cards.split(","):
            kernels = {}
            for sites in ("random:1000", str(weighted)):
                kernels |= compiled(given.vorpipe, given.null_card, card, sites)
            for kernel, values in kernels.items():
                print(LINE.format(card=card, kernel=kernel, **values), flush=True)
                if values["spilled"] or values["scratch"]: faults.append(f"{card}: {kernel} spills registers")
                if values["waves"] < least.get((card, kernel), 0):
                    faults.append(f"{card}: {kernel} has {values['waves']} waves a SIMD in place of {least[card, kernel]}")
            missing = [kernel for (of, kernel) in least if of == card and kernel not in kernels]
            if kernels and missing: faults.append(f"{card}: not compiled: {', '.join(missing)}")
    for fault in faults: print(fault)
    return 1 if faults else 0


sys.exit(main())
