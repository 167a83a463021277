#!/usr/bin/env python3
"""film.py FOLDER FILM.gif: an animation of numbered pictures, as `--frames FOLDER` writes them. Needs Pillow."""
import pathlib
import sys

from PIL import Image

folder, film = sys.argv[1:]
pictures = [Image.open(path).convert('P', palette=Image.Palette.ADAPTIVE, colors=16)
            for path in sorted(pathlib.Path(folder).glob('*.png'))]
pictures[0].save(film, save_all=True, append_images=pictures[1:], duration=[80] * (len(pictures) - 1) + [2000], loop=0)
