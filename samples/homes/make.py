#!/usr/bin/env python3
"""Draws the six sample homes: make.py FOLDER [NAME...]. Writes NAME.sh3d, NAME_day.json, NAME_night.json, NAME_walk.json and CREDITS.md."""
import concurrent.futures
import pathlib
import sys

import catalogue
import credits
import lighting
import own_pieces
import pack
import family_flat
import house
import large_house
import one_room
import studio
import two_room_flat
import walks

HOMES = {"room": one_room, "studio": studio, "two_room_flat": two_room_flat, "family_flat": family_flat, "house": house, "large_house": large_house}


def _make(folder, name):
    home = HOMES[name].draw(catalogue.read() | own_pieces.read())
    pack.write(home, folder / f"{name}.sh3d")
    lighting.write(home, folder)
    walks.write(home, folder)


def main():
    folder, names = pathlib.Path(sys.argv[1]), sys.argv[2:] or list(HOMES)
    try:
        pieces = catalogue.read() | own_pieces.read()
    except FileNotFoundError as missing:
        sys.exit(f"{missing.filename}: not found; install the Debian package sweethome3d-furniture")
    folder.mkdir(parents=True, exist_ok=True)
    with concurrent.futures.ProcessPoolExecutor() as pool:
        # The largest first: they take longest.
        list(pool.map(_make, [folder] * len(names), sorted(names, key=list(HOMES).index, reverse=True)))
    if set(names) == set(HOMES):
        (folder / "CREDITS.md").write_text(credits.text([HOMES[name].draw(pieces) for name in HOMES]))


if __name__ == "__main__":
    main()
