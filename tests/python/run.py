#!/usr/bin/env python3
"""Runs tests of the Python package with pytest: run.py FILE...; without pytest they are skipped, and it says so."""
import os
import signal
import sys

try:
    import pytest
except ImportError:
    reason = 'there is no pytest'
    print(f'SKIPPED: {reason}')
    if os.environ.get('VORPIPE_SKIPPED'):
        with open(os.environ['VORPIPE_SKIPPED'], 'a') as report:
            report.write(f'{os.environ.get("VORPIPE_TEST_NAME", "")}\t\t{reason}\n')
    sys.exit(77)

# Processes that tests start import this file, too.
if __name__ == '__main__':
    # Scripts start jobs in the background with SIGINT ignored, and Python then has no KeyboardInterrupt: tests that
    # interrupt themselves would go on for ever.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    sys.exit(pytest.main(['-q', '-p', 'no:cacheprovider', '--tb=short', *sys.argv[1:]]))
