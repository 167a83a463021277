"""The programs of docs/python.md: each block fenced with ```python runs, in order, in one session; a block fenced with
```text right behind one is what it prints, where ... stands for anything. A block that imports what is not here is
skipped."""
import contextlib
import importlib.util
import io
import pathlib
import re
import traceback

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = ROOT / 'docs/python.md'


def blocks():
    """(line, program, what it prints or None)."""
    found = []
    for match in re.finditer(r'^```python\n(.*?)^```\n(?:\n```text\n(.*?)^```\n)?', PAGE.read_text(),
                             re.MULTILINE | re.DOTALL):
        line = PAGE.read_text()[:match.start()].count('\n') + 2
        found.append((line, match[1], match[2]))
    return found


def imported(program):
    return [name for name in re.findall(r'^(?:import|from) ([a-z_]+)', program, re.MULTILINE)
            if name not in ('numpy', 'vorpipe')]


def test_the_page_runs(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / 'docs').symlink_to(ROOT / 'docs')
    found = blocks()
    assert len(found) > 5
    names = {'__name__': '__main__'}
    for line, program, expected in found:
        if any(importlib.util.find_spec(name) is None for name in imported(program)):
            continue
        printed = io.StringIO()
        try:
            with contextlib.redirect_stdout(printed):
                exec(compile('\n' * (line - 1) + program, str(PAGE), 'exec'), names)
        except Exception:
            pytest.fail(f'{PAGE.name}:{line}:\n{traceback.format_exc(limit=-1)}')
        if expected is not None:
            pattern = re.escape(expected).replace(r'\.\.\.', '.*')
            assert re.fullmatch(pattern, printed.getvalue()), f'{PAGE.name}:{line} prints\n{printed.getvalue()}'


@pytest.mark.parametrize('name', sorted({name for _, program, _ in blocks() for name in imported(program)}))
def test_what_the_page_imports_is_here(name):
    if importlib.util.find_spec(name) is None:
        pytest.skip(f'there is no {name}')
