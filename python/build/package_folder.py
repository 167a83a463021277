"""Prints where packages of this Python are installed, below a prefix: package_folder.py PREFIX"""
import sys
import sysconfig

version = f'python{sys.version_info.major}.{sys.version_info.minor}'
if 'deb_system' not in sysconfig.get_scheme_names():
    print(f'lib/{version}/site-packages')
elif sys.argv[1].rstrip('/') == '/usr':
    # Debian's own packages are for all versions of Python 3.
    print('lib/python3/dist-packages')
else:
    print(f'lib/{version}/dist-packages')
