"""NumPy: the one that is installed, whichever that is; the copy in a wheel of a release where there is none."""
import os
import sys

_copy = os.path.join(os.path.dirname(__file__), '_copies')
try:
    import numpy
except ModuleNotFoundError as error:
    if error.name != 'numpy' or not os.path.isdir(_copy):
        raise
    # The last place: one that is installed later is found before.
    sys.path.append(_copy)
