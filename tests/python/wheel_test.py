"""The build backend: metadata, and that a source distribution has what a build needs. Wheels are built by pip, which
takes as long as a build."""
import importlib.util
import pathlib
import re
import tarfile

import pytest

import vorpipe

ROOT = pathlib.Path(__file__).resolve().parents[2]


@pytest.fixture
def backend():
    spec = importlib.util.spec_from_file_location('wheel_of_cmake', ROOT / 'python/build/wheel_of_cmake.py')
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


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
