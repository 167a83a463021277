#!/usr/bin/env python3
"""Whether two PDF files have the same streams, however they are packed: same_pdf.py A B"""
import re
import sys
import zlib


def streams(path):
    data = open(path, "rb").read()
    found = re.findall(rb"obj\n<<(.*?)>>\nstream\n(.*?)\nendstream", data, re.S)
    return [zlib.decompress(stream) if b"/FlateDecode" in head else stream for head, stream in found]


a, b = (streams(path) for path in sys.argv[1:3])
if not a or a != b:
    print(f"{sys.argv[1]} and {sys.argv[2]}: {'the streams differ' if a else 'there is no stream'}")
    sys.exit(1)
