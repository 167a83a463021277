"""The build backend of pyproject.toml (PEP 517): CMake builds the module, zipfile makes the wheel of it.

It needs nothing but Python, CMake, Ninja and what the build needs anyhow, so that `pip install --no-index .` works.
Options of `--config-settings`: build-dir=FOLDER, where CMake builds [build/wheel-TAG]; cmake-args=ARGUMENTS.
"""
import base64
import hashlib
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import sysconfig
import tarfile
import tempfile
import tomllib
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
OLDEST = (1980, 1, 1, 0, 0, 0)  # that a zip archive can tell: the same files make the same wheel


def get_requires_for_build_wheel(config_settings=None):
    return []


def get_requires_for_build_sdist(config_settings=None):
    return []


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    folder = pathlib.Path(metadata_directory, f'vorpipe-{version()}.dist-info')
    folder.mkdir()
    for name, text in metadata_files().items():
        (folder / name).write_bytes(text)
    return folder.name


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    with tempfile.TemporaryDirectory() as folder:
        install(pathlib.Path(folder), config_settings or {})
        return write_wheel(wheel_directory, files_of(folder), metadata_files(), tag())


def files_of(folder):
    return {str(file.relative_to(folder)): file.read_bytes()
            for file in sorted(pathlib.Path(folder).rglob('*')) if file.is_file()}


def write_wheel(wheel_directory, files, about, tag):
    """Writes a wheel of files by their names in it, and of those about it by their names in its .dist-info."""
    info = f'vorpipe-{version()}.dist-info'
    files = files | {f'{info}/{name}': text for name, text in about.items()}
    files[f'{info}/RECORD'] = record(files, f'{info}/RECORD')
    wheel = f'vorpipe-{version()}-{tag}.whl'
    with zipfile.ZipFile(pathlib.Path(wheel_directory, wheel), 'w', zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():
            entry = zipfile.ZipInfo(name, OLDEST)
            entry.external_attr = (0o755 if '.so' in name else 0o644) << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, content)
    return wheel


def build_sdist(sdist_directory, config_settings=None):
    name = f'vorpipe-{version()}'
    with tarfile.open(pathlib.Path(sdist_directory, f'{name}.tar.gz'), 'w:gz', format=tarfile.PAX_FORMAT) as archive:
        for file in sources():
            archive.add(ROOT / file, f'{name}/{file}', recursive=False)
        with tempfile.NamedTemporaryFile() as info:
            info.write(metadata())
            info.flush()
            archive.add(info.name, f'{name}/PKG-INFO')
    return f'{name}.tar.gz'


def version():
    text = (ROOT / 'CMakeLists.txt').read_text()
    return re.search(r'^project\(vorpipe VERSION ([0-9.]+)', text, re.MULTILINE)[1]


def tag():
    python = f'cp{sys.version_info.major}{sys.version_info.minor}'
    return f'{python}-{python}-{re.sub("[-.]", "_", sysconfig.get_platform())}'


def project():
    return tomllib.loads((ROOT / 'pyproject.toml').read_text())['project']


def metadata(dependencies=None):
    """The project's table of pyproject.toml in the form of METADATA and PKG-INFO; `dependencies` instead of its own."""
    table = project()
    lines = ['Metadata-Version: 2.1', f'Name: {table["name"]}', f'Version: {version()}',
             f'Summary: {table["description"]}', f'Keywords: {",".join(table["keywords"])}', f'License: {table["license"]}',
             f'Requires-Python: {table["requires-python"]}']
    lines += [f'Classifier: {classifier}' for classifier in table['classifiers']]
    lines += [f'Requires-Dist: {dependency}'
              for dependency in (table['dependencies'] if dependencies is None else dependencies)]
    lines += ['Description-Content-Type: text/markdown', '', (ROOT / table['readme']).read_text()]
    return '\n'.join(lines).encode()


def metadata_files(dependencies=None, of=None):
    wheel = f'Wheel-Version: 1.0\nGenerator: wheel_of_cmake\nRoot-Is-Purelib: false\nTag: {of or tag()}\n'
    return {'METADATA': metadata(dependencies), 'WHEEL': wheel.encode(), 'LICENSE': (ROOT / 'LICENSE').read_bytes()}


def record(files, itself):
    lines = []
    for name, content in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b'=').decode()
        lines.append(f'{name},sha256={digest},{len(content)}\n')
    return (''.join(lines) + f'{itself},,\n').encode()


def install(folder, settings):
    """Builds the package and installs it into a folder."""
    build = settings.get('build-dir') or str(ROOT / 'build' / f'wheel-{tag()}')
    run('cmake', '-S', str(ROOT), '-B', build, '-G', 'Ninja', '-DCMAKE_BUILD_TYPE=Release', '-DVORPIPE_TESTS=OFF',
        '-DVORPIPE_PYTHON=ON', f'-DVORPIPE_PYTHON_EXECUTABLE={sys.executable}', '-DVORPIPE_PYTHON_DIR=.',
        *shlex.split(settings.get('cmake-args', '')))
    run('cmake', '--build', build, '--target', '_vorpipe')
    run('cmake', '--install', build, '--component', 'python', '--strip', '--prefix', str(folder))


def run(*command):
    try:
        subprocess.run(command, check=True)
    except FileNotFoundError:
        sys.exit(f'vorpipe: {command[0]} is missing; third_party/README.md lists what a build needs')
    except subprocess.CalledProcessError as error:
        sys.exit(f'vorpipe: failed: {shlex.join(error.cmd)}')


def sources():
    """Every file of the tree that belongs to it: what git knows, else all but what is built."""
    if shutil.which('git'):
        known = subprocess.run(['git', 'ls-files', '-z'], cwd=ROOT, capture_output=True, text=True)
        if known.returncode == 0 and known.stdout:
            return sorted(name for name in known.stdout.split('\0') if name and os.path.isfile(ROOT / name))
    files = (file.relative_to(ROOT) for file in ROOT.rglob('*') if file.is_file())
    return sorted(str(file) for file in files
                  if file.parts[0] not in ('build', '.git', 'PKG-INFO') and '__pycache__' not in file.parts)
