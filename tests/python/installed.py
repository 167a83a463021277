"""What an installed vorpipe must do: installed.py [BACKEND...] computes and draws with each as by cpu.

Says where vorpipe and NumPy were found, and which libraries beyond Python's are loaded before drivers are.
"""
import bz2  # noqa: F401
import ctypes  # noqa: F401
import hashlib  # noqa: F401
import json
import lzma  # noqa: F401
import sys
import zlib  # noqa: F401


def loaded():
    with open('/proc/self/maps') as maps:
        return {line.split()[-1] for line in maps if '.so' in line}


of_python = loaded()
import vorpipe  # noqa: E402: brings NumPy, where there is none
import numpy  # noqa: E402

points = numpy.random.default_rng(5).random((500, 2))
domain = (0, 0, 1, 1)
cells = vorpipe.cells(points, domain=domain, backend='cpu', check=True)
picture = vorpipe.render(points, domain=domain, backend='cpu', size=(120, 90), color='area', check=True)
libraries = loaded() - of_python
for backend in sys.argv[1:]:
    same = vorpipe.cells(points, domain=domain, backend=backend, check=True)
    assert same.report.backend == backend and vorpipe.compare(cells, same).agree, same
    drawn = vorpipe.render(points, domain=domain, backend=backend, size=(120, 90), color='area', check=True)
    assert drawn.report.backend == backend and vorpipe.compare(picture, drawn).agree, drawn
print(json.dumps({'vorpipe': vorpipe.__file__, 'numpy': numpy.__file__, 'libraries': sorted(libraries)}))
