#!/usr/bin/env python3
"""make_dam.py [FILE]: writes a curved catching dam as STL, in mm.

In plan a part of a ring, open to low x (upstream); in section a trapezoid with a steep inner and a gentle outer face.

          ____
         /    \\            height
       _/      \\___
     inner      outer
"""
import math
import sys

INNER, CREST, OUTER, HEIGHT = 150, (162, 172), 190, 60  # [mm] radii at the bed, of the crest's edges, at the bed; height
OPENING, PARTS = 140, 16                                # [deg] of the ring, and pieces along it


def section(angle):
    """The trapezoid's corners at this angle: inner foot, outer foot, outer crest, inner crest."""
    at = lambda r, z: (r * math.cos(angle), r * math.sin(angle), z)
    return [at(INNER, 0), at(OUTER, 0), at(CREST[1], HEIGHT), at(CREST[0], HEIGHT)]


def triangles():
    angles = [math.radians(OPENING * (k / PARTS - 0.5)) for k in range(PARTS + 1)]
    sections = [section(a) for a in angles]
    for a, b in zip(sections, sections[1:]):
        for k in range(4):
            m = (k + 1) % 4
            yield a[k], b[m], a[m]
            yield a[k], b[k], b[m]
    first, last = sections[0], sections[-1]
    yield first[0], first[1], first[2]
    yield first[0], first[2], first[3]
    yield last[0], last[2], last[1]
    yield last[0], last[3], last[2]


def main(path):
    with open(path, "w", encoding="ascii") as out:
        out.write("solid dam\n")
        for t in triangles():
            out.write("facet normal 0 0 0\nouter loop\n")
            out.writelines("vertex {:.5g} {:.5g} {:.5g}\n".format(*(x + 0.0 for x in p)) for p in t)
            out.write("endloop\nendfacet\n")
        out.write("endsolid dam\n")


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "dam.stl")
