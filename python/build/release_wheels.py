#!/usr/bin/env python3
"""Makes wheels for a release, which need nothing of the system but glibc, the compiler's runtime and drivers.

release_wheels.py [-o FOLDER] [--build FOLDER] [PYTHON...]; without a Python: for each that has headers here, of the
system, on PATH, of pyenv and of /opt/python. Libraries of the system lie in the wheel under names of their own, so that
no other package's are taken for them, and so do licenses. The tag says which glibc is new enough, by the symbols.
"""
import argparse
import glob
import hashlib
import os
import pathlib
import platform
import re
import shlex
import shutil
import subprocess
import sys
import tempfile

import wheel_of_cmake as wheel

# What every Linux has that PEP 600 speaks of. Drivers are loaded into the same process and want the system's libstdc++.
OF_THE_SYSTEM = re.compile(r'ld-linux.*|linux-vdso.*|lib(c|m|dl|rt|pthread|stdc\+\+|gcc_s)\.so\..*')
# The first glibc with which distributions have a libstdc++ that is so new, as auditwheel's policies have it.
GLIBC_OF_LIBSTDCXX = {29: 34, 30: 35, 31: 38, 32: 38, 33: 39}
PYBIND11_OF_PYTHON = {12: (2, 11), 13: (2, 13), 14: (3, 0)}  # the first that knows this Python 3
PYBIND11_OF_NUMPY_2 = (2, 12)
QUESTION = '''import os, sys, sysconfig
print(*sys.version_info[:2], os.path.exists(os.path.join(sysconfig.get_path("include"), "Python.h")))'''
# Of NumPy, what only its tests, compilers and those who build with it use; numpy.testing takes one module of tests.
NOT_COPIED = re.compile(r'(.*/)?(distutils|doc|array_api|_pyinstaller)/.*|(.*/)?tests/(?!_natype).*|'
                        r'(.*/)?(setup|conftest)\.py|.*/(_(?!multiarray)\w*_tests|_simd)\.\w.*\.so')


def output(*command):
    try:
        return subprocess.run(command, check=True, capture_output=True, text=True).stdout
    except FileNotFoundError:
        sys.exit(f'release_wheels: {command[0]} is missing; third_party/README.md lists what packages are made with')
    except subprocess.CalledProcessError as error:
        sys.exit(f'release_wheels: failed: {shlex.join(error.cmd)}\n{error.stderr}')


def pythons():
    """By version, the first Python here that has headers and is not too old."""
    oldest = tuple(map(int, re.search(r'>=(\d+)\.(\d+)', wheel.project()['requires-python']).groups()))
    places = ['/usr/bin/python3', shutil.which('python3')]
    for pattern in ('/usr/bin/python3.[0-9]*', '/usr/local/bin/python3.[0-9]*', '/opt/python/cp3*/bin/python3',
                    os.environ.get('PYENV_ROOT', os.path.expanduser('~/.pyenv')) + '/versions/3*/bin/python3'):
        places += sorted(place for place in glob.glob(pattern) if not place.endswith('-config'))
    found = {}
    for place in filter(None, places):
        if not os.access(place, os.X_OK):
            continue
        major, minor, has_headers = output(place, '-c', QUESTION).split()
        version = (int(major), int(minor))
        if has_headers == 'True' and version >= oldest:
            found.setdefault(version, place)
    return found


def version_of_pybind11(build):
    cache = (build / 'CMakeCache.txt').read_text()
    folder = re.search(r'^PYBIND11_INCLUDE_DIR:PATH=(.*)$', cache, re.MULTILINE)[1]
    header = pathlib.Path(folder, 'pybind11/detail/common.h').read_text()
    return tuple(int(re.search(rf'define PYBIND11_VERSION_{part} (\d+)', header)[1]) for part in ('MAJOR', 'MINOR'))


def copy_numpy(python, package):
    """Puts a Python's NumPy into the package; returns where it was, None where it is of no package of Debian."""
    told = subprocess.run([python, '-I', '-c', 'import numpy; print(numpy.__file__)'], capture_output=True, text=True)
    place = pathlib.Path(told.stdout.strip())
    if told.returncode or subprocess.run(['dpkg-query', '-S', place], capture_output=True).returncode:
        return None
    for file in [*place.parent.rglob('*.py'), *place.parent.rglob('*.so')]:
        name = file.relative_to(place.parent)
        if not NOT_COPIED.fullmatch(str(name)):
            to = package / 'vorpipe/_copies/numpy' / name
            to.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(file, to)
    return place


def dependencies(pybind11):
    """What a wheel without NumPy depends on: one as new as this pybind11 knows it."""
    return [of + ',<2' if of.startswith('numpy') and pybind11 < PYBIND11_OF_NUMPY_2 else of
            for of in wheel.project()['dependencies']]


def libraries_of(module):
    """The libraries that a module takes, by name, but for what every system has."""
    found = {}
    for line in output('ldd', module).splitlines():
        name, _, path = line.strip().partition(' => ')
        if not path or OF_THE_SYSTEM.fullmatch(name):
            continue
        if path == 'not found':
            sys.exit(f'release_wheels: {module}: {name} is not found')
        found[name] = pathlib.Path(path.rsplit(' (', 1)[0])
    return found


def bundle(package):
    """Puts what its modules need into the package; returns the libraries as the system has them, by name."""
    modules = sorted(package.rglob('*.so'))
    libraries = {name: path for module in modules for name, path in libraries_of(module).items()}
    folder = package / 'vorpipe.libs'
    folder.mkdir()
    own = {}
    for name, path in libraries.items():
        stem, dot, rest = name.partition('.so')
        own[name] = f'{stem}-{hashlib.sha256(path.read_bytes()).hexdigest()[:8]}{dot}{rest}'
        shutil.copy(path, folder / own[name])
        (folder / own[name]).chmod(0o755)
    for file in [*modules, *(folder / name for name in own.values())]:
        # One change at a time: patchelf 0.14 loses some of several.
        needed = [name for name in output('patchelf', '--print-needed', file).split() if name in own]
        for name in needed:
            output('patchelf', '--replace-needed', name, own[name], file)
        if file.parent == folder:
            output('patchelf', '--set-soname', file.name, file)
        if needed:
            output('patchelf', '--set-rpath', f'$ORIGIN/{os.path.relpath(folder, file.parent)}', file)
    return libraries


def glibc_of(files):
    """The minor version of the first glibc 2 that has what these files need."""
    newest = 0
    for file in files:
        for library, symbol in re.findall(r'Name: (GLIBC|GLIBCXX)_(\S+)', output('readelf', '-VW', file)):
            numbers = re.fullmatch(r'2\.(\d+)(\.\d+)?' if library == 'GLIBC' else r'3\.4(?:\.(\d+))?', symbol)
            minor = numbers and int(numbers[1] or 0)
            if library == 'GLIBCXX' and numbers:
                minor = 0 if minor < min(GLIBC_OF_LIBSTDCXX) else GLIBC_OF_LIBSTDCXX.get(minor)
            if minor is None:
                sys.exit(f'release_wheels: {file}: no tag is known for what needs {library}_{symbol}')
            newest = max(newest, minor)
    return newest


def licenses(files):
    """What the licenses of files of Debian, and of libraries whose headers are compiled in, are called in a wheel."""
    packages = {output('dpkg-query', '-S', file).split(':')[0] for file in files}
    for row in (wheel.ROOT / 'third_party/README.md').read_text().splitlines():
        cells = [cell.strip() for cell in row.strip('|').split('|')]
        if len(cells) == 9 and cells[1] in ('build', 'python'):
            packages |= set(cells[5].split())
    texts = {}
    for name in sorted(packages):
        file = pathlib.Path('/usr/share/doc', name, 'copyright')
        if not file.is_file():
            sys.exit(f'release_wheels: {file} is missing, which a wheel must hold')
        texts[f'licenses/{name}.copyright'] = file.read_bytes()
        for common in re.findall(r'/usr/share/common-licenses/([\w.-]*\w)', file.read_text()):
            texts[f'licenses/{common}'] = pathlib.Path('/usr/share/common-licenses', common).read_bytes()
    return texts


def make(package, python, pybind11, into):
    """Makes a wheel of an installed package, whose folder gets the libraries and NumPy; returns the wheel's name."""
    version = ''.join(output(python, '-c', QUESTION).split()[:2])
    numpy = copy_numpy(python, package)
    if not numpy:
        print(f'release_wheels: {python} has no NumPy of Debian; its wheel asks for {", ".join(dependencies(pybind11))}')
    libraries = bundle(package)
    glibc = glibc_of(package.rglob('*.so*'))
    tag = f'cp{version}-cp{version}-manylinux_2_{glibc}_{platform.machine()}'
    files = [f'*/{path.resolve().name}' for path in libraries.values()] + ([numpy] if numpy else [])
    about = wheel.metadata_files([] if numpy else dependencies(pybind11), tag) | licenses(files)
    return wheel.write_wheel(into, wheel.files_of(package), about, tag)


def build(python, version, folder, into):
    """Builds the module for a Python, in a folder that has all else from the one before; returns the wheel's name."""
    wheel.run('cmake', '-S', str(wheel.ROOT), '-B', str(folder), '-G', 'Ninja', '-U', '*Python3_*',
              '-DCMAKE_BUILD_TYPE=Release', '-DVORPIPE_TESTS=OFF', '-DVORPIPE_PYTHON=ON', '-DVORPIPE_PYTHON_DIR=.',
              f'-DVORPIPE_PYTHON_EXECUTABLE={python}')
    pybind11 = version_of_pybind11(folder)
    if pybind11 < PYBIND11_OF_PYTHON.get(version[1], (2, 10)):
        return None
    wheel.run('cmake', '--build', str(folder), '--target', '_vorpipe')
    with tempfile.TemporaryDirectory() as installed:
        wheel.run('cmake', '--install', str(folder), '--component', 'python', '--strip', '--prefix', installed)
        return make(pathlib.Path(installed), python, pybind11, into)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('-o', default=str(wheel.ROOT / 'build/packages'), metavar='FOLDER', help='where wheels go')
    parser.add_argument('--build', default=str(wheel.ROOT / 'build/wheels'), metavar='FOLDER',
                        help='where CMake builds')
    parser.add_argument('python', nargs='*', metavar='PYTHON')
    given = parser.parse_args()
    named = {tuple(map(int, output(python, '-c', QUESTION).split()[:2])): python for python in given.python}
    os.makedirs(given.o, exist_ok=True)
    made = []
    for version, python in sorted((named or pythons()).items()):
        name = build(python, version, pathlib.Path(given.build), given.o)
        made += [name] if name else []
        if not name:
            print(f'release_wheels: none for {python}: this pybind11 is too old for Python {version[0]}.{version[1]}')
    if not made:
        sys.exit('release_wheels: no Python with headers is here')
    print(*made, sep='\n')


if __name__ == '__main__':
    main()
