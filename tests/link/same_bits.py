"""Compares OBJ files by the bits of their coordinates and by their triangles: same_bits.py FILE FILE...

Triangles are compared as a set: the command writes each in the place of the line that it came from.
"""

import struct
import sys


def read(path):
    positions, triangles = [], []
    with open(path, encoding="utf-8") as lines:
        for line in lines:
            kind, *words = line.split() or ["#"]
            if kind == "v":
                positions.append(struct.pack("3d", *map(float, words[:3])))
            elif kind == "f":
                triangles.append([int(word.split("/")[0]) for word in words])
    return positions, sorted(triangles)


def main():
    first, *others = sys.argv[1:]
    expected = read(first)
    if not expected[0] or not expected[1]:
        sys.exit(f"{first} holds no mesh")
    for other in others:
        if read(other) != expected:
            sys.exit(f"{other} differs from {first}")
    print(f"the same bits in {1 + len(others)} files of {len(expected[0])} vertices and {len(expected[1])} triangles")


main()
