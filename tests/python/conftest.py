"""What is skipped is reported as other tests do, see tests/skip.sh; random numbers print their seed."""
import os

import numpy as np
import pytest

import vorpipe


def pytest_runtest_logreport(report):
    if report.skipped and not hasattr(report, 'wasxfail') and os.environ.get('VORPIPE_SKIPPED'):
        reason = str(report.longrepr[2]).replace('Skipped: ', '').replace('\n', ' ')
        with open(os.environ['VORPIPE_SKIPPED'], 'a') as skipped:
            skipped.write(f'{os.environ.get("VORPIPE_TEST_NAME", "")}\t{report.nodeid.split("::")[-1]}\t{reason}\n')


@pytest.fixture
def random():
    seed = int(os.environ.get('VORPIPE_TEST_SEED', np.random.SeedSequence().entropy % 2**32))
    print(f'VORPIPE_TEST_SEED={seed}')
    return np.random.default_rng(seed)


@pytest.fixture
def rng(random):
    """By another name, where a file has something else called random."""
    return random


def usable(backend):
    return any(info.usable for info in vorpipe.devices() if info.backend == backend)


@pytest.fixture(params=['cpu', 'vulkan-compute', 'vulkan-geometry', 'opengl'])
def backend(request):
    if not usable(request.param):
        if request.param in os.environ.get('VORPIPE_EXPECTED_BACKENDS', '').split(','):
            pytest.fail(f'{request.param} cannot be used')
        pytest.skip(f'{request.param} cannot be used here')
    return request.param
