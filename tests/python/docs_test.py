"""The programs of README.md, docs/python.md, docs/globe.md and docs/space.md: each block fenced with ```python runs, in order, in one
session; a block fenced with ```text right behind one is what it prints, where ... stands for anything. A block that
imports what is not here is skipped."""
import contextlib
import importlib.util
import io
import pathlib
import re
import traceback

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGES = [ROOT / 'README.md', ROOT / 'docs/python.md', ROOT / 'docs/globe.md', ROOT / 'docs/space.md']


def blocks(page):
    """(line, program, what it prints or None)."""
    found = []
    for match in re.finditer(r'^```python\n(.*?)^```\n(?:\n```text\n(.*?)^```\n)?', page.read_text(),
                             re.MULTILINE | re.DOTALL):
        line = page.read_text()[:match.start()].count('\n') + 2
        found.append((line, match[1], match[2]))
    return found


def imported(program):
    return [name for name in re.findall(r'^(?:import|from) ([a-z_]+)', program, re.MULTILINE)
            if name not in ('numpy', 'vorpipe')]


@pytest.mark.parametrize('page', PAGES, ids=lambda page: page.name)
def test_the_page_runs(page, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / 'docs').symlink_to(ROOT / 'docs')
    found = blocks(page)
    assert found
    names = {'__name__': '__main__'}
    for line, program, expected in found:
        if any(importlib.util.find_spec(name) is None for name in imported(program)):
            continue
        printed = io.StringIO()
        try:
            with contextlib.redirect_stdout(printed):
                exec(compile('\n' * (line - 1) + program, str(page), 'exec'), names)
        except Exception:
            pytest.fail(f'{page.name}:{line}:\n{traceback.format_exc(limit=-1)}')
        if expected is not None:
            pattern = re.escape(expected).replace(r'\.\.\.', '.*')
            assert re.fullmatch(pattern, printed.getvalue()), f'{page.name}:{line} prints\n{printed.getvalue()}'


@pytest.mark.parametrize('name', sorted({name for page in PAGES for _, program, _ in blocks(page)
                                         for name in imported(program)}))
def test_what_the_page_imports_is_here(name):
    if importlib.util.find_spec(name) is None:
        pytest.skip(f'there is no {name}')
