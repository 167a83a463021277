"""The build backend: metadata, and that a source distribution has what a build needs. Wheels are built by pip, which
takes as long as a build; that of a release is made here of the module that is there."""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tarfile
import zipfile

import pytest

import vorpipe

ROOT = pathlib.Path(__file__).resolve().parents[2]
OF_THE_SYSTEM = r'(ld-linux|lib(c|m|dl|rt|pthread|stdc\+\+|gcc_s)\.so)'  # of PEP 600's list, what is in use here


@pytest.fixture
def backend(monkeypatch):
    monkeypatch.syspath_prepend(ROOT / 'python/build')
    import wheel_of_cmake
    return wheel_of_cmake


@pytest.fixture(scope='module')
def release_wheel(tmp_path_factory):
    """A wheel as of a release, of the module that is tested."""
    for program in ('patchelf', 'readelf'):
        if not shutil.which(program):
            pytest.skip(f'there is no {program}')
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(ROOT / 'python/build')
        import release_wheels
    installed, into = tmp_path_factory.mktemp('installed'), tmp_path_factory.mktemp('wheels')
    build = pathlib.Path(vorpipe.__file__).parents[2]
    subprocess.run(['cmake', '--install', build, '--component', 'python', '--strip', '--prefix', installed],
                   check=True, capture_output=True)
    module, = installed.rglob('_vorpipe*.so')
    version = release_wheels.version_of_pybind11(build)
    return into / release_wheels.make(module.parents[1], sys.version_info[:2], version, into)


def test_the_version_is_that_of_cmake(backend):
    assert backend.version() == vorpipe.__version__


def test_metadata_are_those_of_the_project(backend, tmp_path):
    name = backend.prepare_metadata_for_build_wheel(tmp_path)
    text = (tmp_path / name / 'METADATA').read_text()
    assert 'Name: vorpipe\n' in text and 'Requires-Dist: numpy>=1.24\n' in text
    assert re.fullmatch(r'cp3\d+-cp3\d+-\w+', backend.tag())


def test_nothing_else_is_asked_for(backend):
    assert backend.get_requires_for_build_wheel() == [] and backend.get_requires_for_build_sdist() == []


def test_a_source_distribution_has_what_a_build_needs(backend, tmp_path):
    name = backend.build_sdist(tmp_path)
    with tarfile.open(tmp_path / name) as archive:
        names = set(archive.getnames())
    stem = f'vorpipe-{vorpipe.__version__}'
    for file in ('PKG-INFO', 'CMakeLists.txt', 'pyproject.toml', 'python/vorpipe/__init__.py', 'src/vorpipe.h',
                 'shaders/CMakeLists.txt', 'third_party/dependencies.cmake'):
        assert f'{stem}/{file}' in names, file
    assert not any('/build/dev/' in name or '__pycache__' in name for name in names)


def test_a_wheel_of_a_release_holds_what_it_needs(release_wheel, tmp_path):
    with zipfile.ZipFile(release_wheel) as archive:
        archive.extractall(tmp_path)
    glibc = re.fullmatch(r'vorpipe-[\d.]+-cp3\d+-cp3\d+-manylinux_2_(\d+)_\w+\.whl', release_wheel.name)
    names = {file.name for file in tmp_path.rglob('*.so*')}
    for file in tmp_path.rglob('*.so*'):
        about = subprocess.run(['readelf', '-dVW', file], check=True, capture_output=True, text=True).stdout
        needed = set(re.findall(r'NEEDED.*\[(.*)\]', about))
        beyond = {name for name in needed - names if not re.match(OF_THE_SYSTEM, name)}
        assert not beyond, f'{file}: {beyond}'
        if needed & names:
            assert '$ORIGIN' in re.search(r'R(?:UN)?PATH.*\[(.*)\]', about)[1], file
        if 'vorpipe.libs' in str(file):
            assert re.search(r'SONAME.*\[(.*)\]', about)[1] == file.name
        assert all(int(minor) <= int(glibc[1]) for minor in re.findall(r'Name: GLIBC_2\.(\d+)', about)), file
    licenses = {file.name for file in next(tmp_path.glob('*.dist-info/licenses')).iterdir()}
    assert {'LGPL-2.1', 'pybind11-dev.copyright'} <= licenses
    assert any(re.match(r'libgeos\d.*\.copyright', name) for name in licenses)


def test_a_wheel_of_a_release_computes_in_a_new_environment(release_wheel, tmp_path):
    """Of the system NumPy alone, since no index is asked. What is loaded besides is the wheel's and the C library's."""
    made = subprocess.run([sys.executable, '-m', 'venv', '--system-site-packages', '--without-pip', tmp_path / 'venv'])
    python = tmp_path / 'venv/bin/python'
    pip = subprocess.run([python, '-m', 'pip', '--version'], capture_output=True)
    if made.returncode or pip.returncode:
        pytest.skip('there is no venv, or no pip')
    subprocess.run([python, '-m', 'pip', 'install', '--no-index', '-q', release_wheel], check=True)
    program = '''
import ctypes, json, numpy, numpy.linalg, pathlib
def loaded(): return {line.split()[-1] for line in open("/proc/self/maps") if ".so" in line}
before = loaded()
import vorpipe
points = numpy.random.default_rng(5).random((500, 2))
cells = vorpipe.cells(points, domain=(0, 0, 1, 1), backend="cpu")
vorpipe.check(cells)
libraries = sorted(loaded() - before)
try:
    device = vorpipe.compare(cells, vorpipe.cells(points, domain=(0, 0, 1, 1), backend="vulkan-compute")).agree
except vorpipe.DeviceError as error:
    device = str(error)
print(json.dumps([vorpipe.__file__, libraries, device]))
'''
    environment = {name: value for name, value in os.environ.items() if not name.startswith('PYTHON')}
    told = subprocess.run([python, '-c', program], check=True, capture_output=True, text=True, env=environment,
                          cwd=tmp_path)
    package, libraries, device = json.loads(told.stdout)
    home = str(tmp_path / 'venv')
    assert package.startswith(home)
    assert any('vorpipe.libs' in library for library in libraries)
    outside = [library for library in libraries if not library.startswith(home)]
    assert not [library for library in outside
                if not re.search(f'/({OF_THE_SYSTEM}|.*python3[.]\\d+/lib-dynload/)', library)]
    if any(info.backend == 'vulkan-compute' and info.usable for info in vorpipe.devices()):
        assert device is True
    else:
        assert 'vulkan' in device.lower()
