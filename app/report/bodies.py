"""Bodies of triangles, [triangle, corner, (x, y, height)], as lines and areas for pictures."""

import numpy as np


def looks_up(triangles):
    a, b, c = (triangles[:, k, :2] for k in range(3))
    u, v = b - a, c - a
    return u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0] > 0


def seen_from_above(triangles):
    """(x, y) of the corners of all triangles that look up."""
    return triangles[looks_up(triangles)][:, :, :2]


def outline(triangles):
    """Segments (x, y) along which the body ends, seen from above: edges that one of the triangles that look up has alone."""
    count = {}
    for corners in triangles[looks_up(triangles)]:
        for k in range(3):
            edge = tuple(sorted((tuple(corners[k]), tuple(corners[(k + 1) % 3]))))
            count[edge] = count.get(edge, 0) + 1
    return np.array([[end[:2] for end in edge] for edge, n in count.items() if n == 1]).reshape(-1, 2, 2)


def section(triangles, y):
    """Closed lines (x, height) in which the plane at this y cuts the body, the bed closing them."""
    pieces = []
    for corners in triangles:
        above = corners[:, 1] > y
        if above.all() or not above.any():
            continue
        ends = []
        for k in range(3):
            a, b = corners[k], corners[(k + 1) % 3]
            if (a[1] > y) != (b[1] > y):
                a, b = sorted((tuple(a), tuple(b)))  # the same bits from both triangles of an edge
                share = (y - a[1]) / (b[1] - a[1])
                ends.append((a[0] + share * (b[0] - a[0]), a[2] + share * (b[2] - a[2])))
        if ends[0] != ends[1]:
            pieces.append(ends)
    loops = []
    while pieces:
        line = list(pieces.pop())
        grown = True
        while grown:
            grown = False
            for k, (p, q) in enumerate(pieces):
                if line[-1] in (p, q):
                    line.append(q if line[-1] == p else p)
                elif line[0] in (p, q):
                    line.insert(0, q if line[0] == p else p)
                else:
                    continue
                del pieces[k]
                grown = True
                break
        if line[0][1] == 0 == line[-1][1] or line[0] == line[-1]:
            loops.append(np.array(line))
    return loops
