"""Where points stand with respect to a rim face, and which way along it leads there (coupling/engine/drive_face.hpp)."""
import numpy as np


def place_along(face, positions):
    """[m] [n] from the face's low end, measured on the bed; positions [n, 3]."""
    return _on(face, positions)[0]


def courses(face, positions):
    """[n, 3] the direction along the bed there, and [n] how fast a layer that slides along the bed at 1 moves there."""
    return _on(face, positions)[1:]


def turned(face, velocity, positions):
    """[n, 3] what a velocity has along the face, in the direction that the face has at each position."""
    normal = velocity @ face.inward
    along = velocity - normal * face.inward
    direction = _on(face, positions)[1]
    speed = np.copysign(np.linalg.norm(along), direction @ along)
    return normal * face.inward + speed[:, None] * direction


def _on(face, positions):
    positions, bend = np.asarray(positions, float).reshape(-1, 3), face.bend
    if bend.length == 0:
        return (positions - face.origin) @ face.along, np.broadcast_to(face.along, positions.shape), np.ones(len(positions))
    down = bend.foot - bend.centre
    radius = np.linalg.norm(down)
    down, arm = down / radius, positions - bend.centre
    ahead, below = arm @ face.along, arm @ down
    turned, whole = np.arctan2(ahead, below), bend.length / radius
    c, s = np.cos(whole), np.sin(whole)
    before, on_arc = ahead <= 0, turned < whole
    place = np.select([before, on_arc], [bend.begin + ahead, bend.begin + turned * radius],
                      bend.begin + bend.length + c * ahead - s * below)
    reach = np.hypot(ahead, below)
    on, off = np.select([before, on_arc], [1.0, below / reach], c), np.select([before, on_arc], [0.0, -ahead / reach], -s)
    return place, on[:, None] * face.along + off[:, None] * down, np.select([before, on_arc], [1.0, reach / radius], 1.0)
