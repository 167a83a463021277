#!/usr/bin/env python3
"""Runs every command of the documents: commands_test.py VORPIPE [PAGE...]

Commands stand in blocks fenced with ```sh. Those of a page run in order, in one shell, in a folder laid out like a
checkout that is just built: docs/examples, tests/data, and a ./run that starts VORPIPE. A command must end with 0, or
with the code that its line names, as in `# exit code 3`. A block fenced with ```text right behind one of commands is
what they print, but for how many spaces it has; `...` there stands for what differs from machine to machine, on a line
of its own for any number of lines. A block fenced with ```yaml is a workflow of GitHub Actions, whose steps run as well.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

try:
    import yaml
except ImportError:
    yaml = None

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGES = ['README.md', 'CONTRIBUTING.md', 'SECURITY.md', 'tests/data/README.md', 'third_party/README.md']
PAGES += sorted(str(page.relative_to(ROOT)) for page in (ROOT / 'docs').glob('*.md'))

# Commands that cannot run here, with the reason. Each must stand in a document.
BUILDS = 'it builds, or runs what only another preset or target builds'
SELFTEST = 'it takes long on software drivers; the test cli_selftest runs the like of it'
DRIVERS = 'it takes minutes; the tests vulkan and conformance are what it runs'
NUMPY = 'it takes a python3 with NumPy, whose own is not that of every shell'
INSTALLS = 'it installs'
WINDOW = 'it opens a window; the test view plays the like of it'
NOT_RUN = {
    './run fluid --case rayleigh-taylor --frames mushroom-frames --every 4 --antialias 2 --size 200x400':
        'it takes a minute; the test docs_gallery does, with fewer pictures',
    'xvfb-run python3 docs/examples/foam.py foam.vtu foam.png': 'it needs VTK',
    'python3 docs/examples/film.py mushroom-frames mushroom.gif': 'it needs Pillow; docs/gallery.sh does where that is',
    'python3 tests/faults/campaign.py build/dev/src/cli/vorpipe --moments 200': 'it takes an hour; the test faults does',
    'python3 tests/faults/memory.py build/dev/src/cli/vorpipe build/dev/tests/faults/librefusals.so --moments 200':
        'it takes an hour; the test refused_memory does',
    "LVP_POISON_MEMORY=0 VORPIPE_VALIDATION=1 build/dev/tests/conformance/conformance_test --gtest_filter='*vulkan*'":
        DRIVERS,
    "LVP_POISON_MEMORY=1 VORPIPE_VALIDATION=1 build/dev/tests/conformance/conformance_test --gtest_filter='*vulkan*'":
        DRIVERS,
    'VORPIPE_VALIDATION=1 VK_LAYER_ENABLES=VK_VALIDATION_FEATURE_ENABLE_GPU_ASSISTED_EXT \\\n'
    '  build/dev/tests/conformance/conformance_test '
    "--gtest_filter='Backends/Cells*/vulkan*:Backends/Metamorphic.*/vulkan*:Backends/Views.*/vulkan*'": DRIVERS,
    './test': 'it is what runs this',
    './test -R conformance': 'it is what runs this',
    'VORPIPE_TEST_DATA=~/sites ./test -R real': 'it is what runs this',
    'build/dev/tests/fuzz/fuzz_replay build/fuzz/corpus 200 cells': 'the inputs are those that libFuzzer has found',
    'tests/fuzz/run.sh --seconds 3600': 'it takes hours, and a compiler of its own; the test fuzz runs the targets',
    'tests/aarch64/run.sh': 'it takes a quarter of an hour',
    'python3 tests/registers/registers.py build/release/src/cli/vorpipe build/dev/tests/registers':
        'the test registers runs it',
    'python3 tests/bench/kinds.py build/kinds 200000': NUMPY,
    'tests/bench/run.sh --patterns build/kinds/towns.npy,build/kinds/halo.npy --backends cpu --threads 2 --repetitions 3':
        BUILDS,
    'python3 tests/bench/versions.py --last v0.1.0': BUILDS,
    'python3 tests/bench/kinds.py build/kinds 1000': NUMPY,
    './run bench': 'it takes minutes; the test cli_bench runs each table',
    './run bench all --json all.json --plot all.svg': 'it takes an hour; the test cli_bench runs each table',
    './run selftest --quick': SELFTEST,
    './run selftest --quick --backend cpu --json selftest.json': 'it is an example of a man page; the test cli_manual runs it',
    './run selftest --quick --json selftest.json': SELFTEST,
    './run selftest --json report.json': SELFTEST,
    './run selftest --backend vulkan-compute --device 0 --seed 7': SELFTEST,
    './run selftest --quick --limit maxTexelBufferElements=4096': SELFTEST,
    'VK_DRIVER_FILES=build/swiftshader/vk_swiftshader_icd.json ./run selftest --quick --backend vulkan-compute':
        'it takes long on software drivers; the test cli_swiftshader runs it',
    'python3 tests/scale/check_cells.py build/dev/src/cli/vorpipe --sites 1e8 --kind clusters --limit 8GiB':
        'it takes minutes; the tests scale_random and scale_clusters run less of it',
    'docs/gallery.sh': 'the test docs_gallery runs it',
    './run view --sites random:10000 --edges': WINDOW,
    './run view --sites random:2000 --relax': WINDOW,
    './run view --sites random:1000 --script play.txt': WINDOW,
    './run view --sites random:1000 --edges --screenshot window.png': WINDOW,
    './run view --sites random:1000 --relax --frames 50 --screenshot relaxed.png': WINDOW,
    './run view --case dam-break': WINDOW,
    './run view --case rayleigh-taylor --particles 4096 --run': WINDOW,
    './run view --case shear --frames 20 --screenshot shear.png': WINDOW,
    './run view --sites random:500 --script play.txt --record frames': WINDOW,
    './run relax --sites density:20000 --density spheres.png --equal-masses --iterations 100 -o stipple.csv '
    '--cells stipple.npz \\\n  --picture stipple.png --no-fill --show-sites --dot-size 3 --antialias 4 --size 800':
        'it takes long; docs/gallery.sh draws its picture',
    'cmake --preset dev && cmake --build --preset dev --target exact_cells': BUILDS,
    'cmake --preset bench': BUILDS,
    'cmake --build build/bench --target bench_pan': BUILDS,
    'build/bench/tests/bench/bench_pan cpu 50000 1': BUILDS,
    'build/bench/tests/bench/bench_pan vulkan-compute 1000000 0.01': BUILDS,
    'build/dev/tests/conformance/exact_cells all': BUILDS,
    'build/dev/tests/conformance/exact_cells weighted --seed 7': BUILDS,
    'build/dev/tests/conformance/exact_cells random:100000 board:13000 --backends cpu,vulkan-compute': BUILDS,
    'build/dev/tests/conformance/exact_cells FILE.csv --search flann:10 --limit maxTexelBufferElements=65536': BUILDS,
    'build/dev/tests/conformance/hard_inputs --seconds 3600 --write faults': BUILDS,
    "build/dev/tests/conformance/conformance_test --gtest_filter='*vulkancompute'": BUILDS,
    'tests/bench/run.sh': BUILDS,
    'cmake --preset tsan && cmake --build --preset tsan && ctest --preset tsan': BUILDS,
    'tests/coverage.sh': BUILDS,
    'tests/debian.sh': BUILDS,
    'cmake -B build/clang -G Ninja -D CMAKE_CXX_COMPILER=clang++ -D CMAKE_BUILD_TYPE=RelWithDebInfo -D VORPIPE_TESTS=OFF':
        BUILDS,
    'cmake --build build/clang --target vorpipe': BUILDS,
    'tests/determinism/run.sh build/dev/src/cli/vorpipe build/clang/src/cli/vorpipe': BUILDS,
    'tests/bench/run.sh --sites 100000 --patterns random,clusters --backends cpu --threads 1,2 --peers cgal,boost': BUILDS,
    'tests/bench/run.sh --weights 0.5 --json speed.json': BUILDS,
    'git clone --branch dev https://github.com/chr1shr/voro build/voro': 'it takes the network',
    'cmake --preset bench -D VORPIPE_VORO_DEV_SOURCE=$PWD/build/voro': BUILDS,
    'tests/bench/run.sh --space --threads 1,2 --polyhedra': BUILDS,
    'tests/bench/run.sh --space --sites 100000 --patterns random,fcc~1e-5,cubic%1e-6 --peers voro++,voro++-dev': BUILDS,
    'cmake --preset asan && cmake --build --preset asan && ctest --preset asan': BUILDS,
    "cmake --preset asan && cmake --build --preset asan --target vorpipe keep_loaded && ctest --preset asan -R '^view$'": BUILDS,
    'cmake --build build/dev --target update-spv': BUILDS,
    'cmake --preset dev': BUILDS,
    'pip install --no-index .': BUILDS,
    'cmake -B build/python -G Ninja -DCMAKE_BUILD_TYPE=Release -DVORPIPE_TESTS=OFF -DVORPIPE_PYTHON=ON': BUILDS,
    'cmake --build build/python --target _vorpipe': BUILDS,
    'PYTHONPATH=build/python/python VORPIPE_CALL=build/python/tests/bench/bench_call python3 tests/bench/python.py':
        BUILDS,
    'cmake --install build/python --component python --prefix /usr/local': BUILDS,
    'cmake --build --preset dev --target vorpipe': BUILDS,
    'ctest --preset dev -R cli_cells': BUILDS,
    'cmake --preset release && cmake --build --preset release': BUILDS,
    'cmake --install build/release --prefix ~/.local': 'the test library_installed installs',
    'vorpipe/src/package/make deb': BUILDS,
    'sudo apt-get update': INSTALLS,
    'sudo apt-get install -y ./vorpipe/build/packages/vorpipe_*.deb libvulkan1 mesa-vulkan-drivers libegl1 \\\n'
    '  libopengl0 libgl1-mesa-dri': INSTALLS,
    'vorpipe selftest --quick --require vulkan-compute,opengl --json selftest.json': SELFTEST,
    'src/package/make deb archive wheels': BUILDS,
}


class Page:
    """The commands of a page, with what they must print and end with."""

    def __init__(self, name):
        self.name = name
        self.faults = []
        self.blocks = []  # (line, [(line, command, code)], expected output or None)
        self.read((ROOT / name).read_text().splitlines())

    def fault(self, line, text):
        self.faults.append(f'{self.name}:{line}: {text}')

    def read(self, lines):
        at = 0
        fresh = False  # whether a block of commands has just ended
        while at < len(lines):
            fence = re.match(r'\s*```(\S*)', lines[at])
            if not fence:
                if re.match(r'    +(\./|vorpipe |python3 |cmake |ctest |git |export |tests/|build/|docs/)', lines[at]):
                    self.fault(at + 1, 'commands stand in a block that begins with ```sh')
                fresh = fresh and not lines[at].strip()
                at += 1
                continue
            start = at + 1
            end = next((k for k in range(start, len(lines)) if lines[k].strip() == '```'), None)
            if end is None:
                self.fault(at + 1, 'the block has no end')
                return
            inside = lines[start:end]
            if fence[1] == 'sh':
                self.blocks.append([start, list(commands(inside, start + 1)), None])
            elif fence[1] == 'yaml':
                self.read_workflow(start, '\n'.join(inside))
            elif fence[1] == 'text' and fresh:
                self.blocks[-1][2] = inside
            elif fence[1] not in ('text', 'c', 'cpp', 'glsl', 'json', 'csv', 'cmake', 'python'):
                self.fault(at + 1, f'a block of "{fence[1]}": use sh for commands, text for what they print')
            fresh = fence[1] == 'sh'
            at = end + 1

    def read_workflow(self, line, text):
        """Takes the commands of a workflow's steps; what only GitHub can say of it is whether its actions exist."""
        if yaml is None:
            skipped(f'{self.name}:{line}', 'there is no yaml')
            return
        try:
            workflow = yaml.safe_load(text)
            steps = [step for job in workflow['jobs'].values() for step in job['steps']]
        except (yaml.YAMLError, KeyError, TypeError, AttributeError) as error:
            self.fault(line, f'this is no workflow: {error!r}')
            return
        for step in steps:
            if ('run' in step) == ('uses' in step) or not re.fullmatch(r'[\w/-]+@v\d+', step.get('uses', 'a@v1')):
                self.fault(line, f'a step runs commands or uses an action of a version: {step}')
        self.blocks += [[line, list(commands(step['run'].splitlines(), line)), None] for step in steps if 'run' in step]


def commands(lines, number):
    """Yields (line, command, exit code) of a block: a command goes on after a backslash, and up to the end of its
    here-document."""
    at = 0
    while at < len(lines):
        first = at
        text = [lines[at]]
        here = re.search(r"<<'?(\w+)'?", lines[at])
        while (lines[at] != here[1]) if here else lines[at].endswith('\\'):
            at += 1
            text.append(lines[at])
        at += 1
        command = '\n'.join(text)
        if command.strip() and not command.strip().startswith('#'):
            code = re.search(r'#.*exit code (\d+)', text[-1] if not here else text[0])
            yield number + first, command, int(code[1]) if code else 0


def bare(command):
    """A command without its comment."""
    return re.sub(r'\s+# .*', '', command).strip()


def spaced(text):
    return re.sub(' +', ' ', text)


def lay_out(folder, vorpipe):
    """A checkout whose ./run does not build: the lines of the script behind that, with another program."""
    shutil.copytree(ROOT / 'docs/examples', folder / 'docs/examples')
    shutil.copytree(ROOT / 'tests/data', folder / 'tests/data')
    script = (ROOT / 'run').read_text()
    program = '"$root/build/release/src/cli/vorpipe"'
    assert script.count(program) == 1 and script.count('\nunlockBuild\n') == 1, 'run has changed: change lay_out too'
    start = '#!/usr/bin/env bash' + script.split('\nunlockBuild\n')[1].replace(program, f'"{vorpipe}"')
    (folder / 'run').write_text(start.replace('bash', 'bash\n', 1))
    (folder / 'run').chmod(0o755)
    # Pages say python3; the build says which one has the modules.
    (folder / 'bin').mkdir()
    (folder / 'bin/python3').symlink_to(sys.executable)
    (folder / 'bin/vorpipe').symlink_to(vorpipe)


def run(page, vorpipe, folder):
    """Runs the commands of a page in one shell and tells what is wrong with each."""
    lay_out(folder, vorpipe)
    numpy = subprocess.run([sys.executable, '-c', 'import numpy'], capture_output=True).returncode == 0
    script = ['export PATH="$PWD/bin:$PATH"', 'set -o pipefail']
    chosen = []
    missing = False
    for at, (_, found, _) in enumerate(page.blocks):
        for line, command, code in found:
            if bare(command) in NOT_RUN:
                continue
            if 'numpy' in command and not numpy:
                skipped(f'{page.name}:{line}', 'there is no numpy')
                page.blocks[at][2] = None
                missing = True
                continue
            log = folder / f'log.{len(chosen)}'
            chosen.append((at, line, command, code, log))
            script += ['begin=$EPOCHREALTIME', '{', command, f'}} >{log} 2>&1 </dev/null',
                       f'echo $? $begin $EPOCHREALTIME >{log}.code']
    (folder / 'script').write_text('\n'.join(script) + '\n')
    subprocess.run(['bash', 'script'], cwd=folder, env={**os.environ, 'LC_ALL': 'C'})
    printed = {}
    for at, line, command, code, log in chosen:
        said = log.read_text() if log.exists() else ''
        if not (folder / f'{log.name}.code').exists():
            page.fault(line, f'the shell ended: {bare(command)}')
            return len(chosen)
        ended, begin, end = (folder / f'{log.name}.code').read_text().split()
        if os.environ.get('VORPIPE_TEST_TIMES'):
            print(f'{float(end) - float(begin):7.2f} s  {page.name}:{line}: {bare(command)}')
        # Where a backend or numpy is missing, so is what later commands would read.
        lacks = int(ended) == 3 != code and not os.environ.get('VORPIPE_EXPECTED_BACKENDS')
        missing = missing or lacks
        if lacks or (missing and int(ended) != code and 'No such file' in said):
            skipped(f'{page.name}:{line}', said.strip().splitlines()[-1])
            page.blocks[at][2] = None
        elif int(ended) != code:
            page.fault(line, f'exit code {ended}, not {code}: {bare(command)}\n    ' + said.replace('\n', '\n    '))
        printed[at] = printed.get(at, '') + said
    for at, (line, found, expected) in enumerate(page.blocks):
        if expected is None or all(bare(command) in NOT_RUN for _, command, _ in found):
            continue
        parts = [r'(?:.*\n)*?' if text.strip() == '...' else re.escape(spaced(text)).replace(r'\.\.\.', '.*') + '\n'
                 for text in expected]
        if not re.fullmatch(''.join(parts), spaced(printed.get(at, ''))):
            page.fault(line, 'the commands print something else:\n    ' + printed.get(at, '').replace('\n', '\n    '))
    return len(chosen)


def skipped(part, reason):
    print(f'SKIPPED: {part}: {reason}', file=sys.stderr)
    if os.environ.get('VORPIPE_SKIPPED'):
        with open(os.environ['VORPIPE_SKIPPED'], 'a') as report:
            report.write(f'{os.environ.get("VORPIPE_TEST_NAME", "")}\t{part}\t{reason}\n')


def main():
    vorpipe = pathlib.Path(sys.argv[1]).resolve()
    pages = [Page(name) for name in sys.argv[2:] or PAGES]
    count = 0
    begin = time.monotonic()
    for page in pages:
        with tempfile.TemporaryDirectory() as folder:
            count += run(page, vorpipe, pathlib.Path(folder))
    faults = [fault for page in pages for fault in page.faults]
    if not sys.argv[2:]:
        stands = {bare(command) for page in pages for _, found, _ in page.blocks for _, command, _ in found}
        faults += [f'{command}: no document has this command; leave it out of NOT_RUN' for command in NOT_RUN
                   if command not in stands]
    for fault in faults:
        print(f'FAILED: {fault}', file=sys.stderr)
    print(f'{count} commands in {time.monotonic() - begin:.0f} s, {len(faults)} failures')
    sys.exit(1 if faults else 0)


if __name__ == '__main__':
    main()
