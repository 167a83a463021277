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

import numpy
import pytest

import vorpipe

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(vorpipe.__file__).parents[2]
INSTALLED = ROOT / 'tests/python/installed.py'
OF_THE_SYSTEM = r'(ld-linux|lib(c|m|dl|rt|pthread|stdc\+\+|gcc_s)\.so)'  # of PEP 600's list, what is in use here


@pytest.fixture
def backend(monkeypatch):
    monkeypatch.syspath_prepend(ROOT / 'python/build')
    import wheel_of_cmake
    return wheel_of_cmake


@pytest.fixture(scope='module')
def release():
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(ROOT / 'python/build')
        import release_wheels
    return release_wheels


@pytest.fixture(scope='module')
def release_wheel(release, tmp_path_factory):
    """A wheel as of a release, of the module that is tested."""
    for program in ('patchelf', 'readelf'):
        if not shutil.which(program):
            pytest.skip(f'there is no {program}')
    installed, into = tmp_path_factory.mktemp('installed'), tmp_path_factory.mktemp('wheels')
    subprocess.run(['cmake', '--install', BUILD, '--component', 'python', '--strip', '--prefix', installed],
                   check=True, capture_output=True)
    module, = installed.rglob('_vorpipe*.so')
    return into / release.make(module.parents[1], sys.executable, release.version_of_pybind11(BUILD), into)


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
    assert {'LGPL-2.1', 'pybind11-dev.copyright', 'python3-numpy.copyright', 'liblapack3.copyright'} <= licenses
    assert any(re.match(r'libgeos\d.*\.copyright', name) for name in licenses)
    assert 'Requires-Dist' not in next(tmp_path.glob('*.dist-info/METADATA')).read_text()
    assert not {name for name in ('test_*.py', 'distutils', 'include') if any(tmp_path.rglob(name))}


@pytest.fixture(scope='module')
def environment(release_wheel, tmp_path_factory):
    """A virtual environment of Python alone, into which the wheel was installed, without an index."""
    home = tmp_path_factory.mktemp('venv')
    python = home / 'bin/python'
    made = subprocess.run([sys.executable, '-m', 'venv', '--without-pip', home])
    pip = [sys.executable, '-m', 'pip', '--python', python]
    if made.returncode or subprocess.run([*pip, '--version'], capture_output=True).returncode:
        pytest.skip('there is no venv, or no pip')
    subprocess.run([*pip, 'install', '--no-index', '-q', release_wheel], check=True)
    return home


def told_by(environment, *arguments):
    variables = {name: value for name, value in os.environ.items() if not name.startswith('PYTHON')}
    return subprocess.run([environment / 'bin/python', *arguments], capture_output=True, text=True, env=variables,
                          cwd=environment)


def test_a_wheel_of_a_release_computes_in_a_new_environment(environment):
    """Of the system nothing is asked but Python and drivers. What is loaded is the wheel's and the C library's."""
    with_driver = {info.backend for info in vorpipe.devices() if info.usable} & {'vulkan-compute', 'vulkan-geometry'}
    told = told_by(environment, INSTALLED, *sorted(with_driver))
    assert told.returncode == 0, told.stderr
    found, home = json.loads(told.stdout), str(environment)
    assert found['vorpipe'].startswith(home)
    assert '/vorpipe/_copies/numpy/' in found['numpy']
    assert any('vorpipe.libs' in library for library in found['libraries'])
    outside = [library for library in found['libraries'] if not library.startswith(home)]
    assert not [library for library in outside
                if not re.search(f'/({OF_THE_SYSTEM}|.*python3[.]\\d+/lib-dynload/)', library)]


def test_all_of_the_copy_of_numpy_is_there(environment):
    told = told_by(environment, '-c', 'import vorpipe, numpy.testing\nfrom numpy import *\nprint(linalg.det(eye(3)))')
    assert told.stdout == '1.0\n', told.stderr


def test_numpy_that_is_installed_later_is_the_one_in_use(environment):
    packages, = environment.glob('lib/python3*/site-packages')
    installed = packages / 'numpy'
    installed.symlink_to(pathlib.Path(numpy.__file__).parent)
    told = told_by(environment, INSTALLED)
    installed.unlink()
    assert told.returncode == 0, told.stderr
    assert pathlib.Path(json.loads(told.stdout)['numpy']).parent == installed


def test_numpy_that_the_module_does_not_know_is_refused_in_a_line(environment, release):
    if release.version_of_pybind11(BUILD) >= release.PYBIND11_OF_NUMPY_2:
        pytest.skip('this pybind11 knows NumPy 2')
    packages, = environment.glob('lib/python3*/site-packages')
    (packages / 'numpy').mkdir()
    (packages / 'numpy/__init__.py').write_text('__version__ = "2.1.0"\n')
    told = told_by(environment, '-c', 'import vorpipe')
    shutil.rmtree(packages / 'numpy')
    assert told.stderr.splitlines()[-1] == (
        f'ImportError: NumPy 2.1.0 of {packages / "numpy"} is too new for this vorpipe, which takes NumPy before 2: '
        'pip install "numpy<2"')
