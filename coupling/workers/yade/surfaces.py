"""Surfaces as facets, and the forces on them."""
import numpy as np
from yade import O, utils
from yade.minieigenHP import Vector3
from yade.wrapper import ForceRecorder

from .steps import SURFACE_MASK

SHARE_OF_PERIOD = 0.25  # YADE refuses bodies of half a period, their bounds included


def put_up(setup, materials):
    """All surfaces' facets, before the grains. Returns the bodies of each."""
    periods = np.where(setup.periodic, setup.hi - setup.lo, np.inf)
    return [O.bodies.append([utils.facet([Vector3(*corner) for corner in t.tolist()], material=material, mask=SURFACE_MASK)
                             for triangle in surface.triangles for t in pieces(triangle, SHARE_OF_PERIOD * periods)])
            for surface, material in zip(setup.surfaces, materials)]


def pieces(triangle, most):
    """The triangle, or halves of halves of it that are no larger than `most` along each axis."""
    if ((triangle.max(0) - triangle.min(0)) <= most).all():
        return [triangle]
    edges = np.linalg.norm(triangle - np.roll(triangle, -1, axis=0), axis=1)
    a, b, c = np.roll(triangle, -edges.argmax(), axis=0)  # a - b is the longest
    middle = (a + b) / 2
    return pieces(np.array([a, middle, c]), most) + pieces(np.array([middle, b, c]), most)


def inside(bodies, faces):
    """The facets whose middle is inside of all faces."""
    def within(id):
        return all((np.array(O.bodies[id].state.pos) - face.origin) @ face.inward >= 0 for face in faces)
    return [id for ids in bodies for id in ids if within(id)]


class Probes:
    """[N] by the grains on each surface: at the last step, and its mean over a window, weighted as velocity Verlet kicks (both
    ends by half), so that the mean times the window is the momentum given. samples: the same over `sample_steps` steps each."""

    def __init__(self, bodies, last=None):
        self._recorders = [ForceRecorder(ids=ids) for ids in bodies]
        self.last = last or [Vector3.Zero for _ in bodies]
        self.begin_window()

    def begin_window(self, sample_steps=0):
        self._first = self._sample_first = self.last
        self._sum = [Vector3.Zero for _ in self.last]
        self._sample_sum = list(self._sum)
        self._sample_steps = sample_steps
        self.samples = [[] for _ in self.last]
        self._steps = 0

    def read(self):
        for recorder in self._recorders:
            recorder()
        self.last = [Vector3(recorder.totalForce) for recorder in self._recorders]  # copies: totalForce is a view
        self._sum = [s + f for s, f in zip(self._sum, self.last)]
        self._sample_sum = [s + f for s, f in zip(self._sample_sum, self.last)]
        self._steps += 1
        if self._sample_steps and self._steps % self._sample_steps == 0:
            self._end_sample()

    def _end_sample(self):
        for samples, s, first, last in zip(self.samples, self._sample_sum, self._sample_first, self.last):
            samples.append((s + 0.5 * (first - last)) / self._sample_steps)
        self._sample_first = self.last
        self._sample_sum = [Vector3.Zero for _ in self.last]

    def mean(self):
        if self._steps == 0:
            return self.last
        return [(s + 0.5 * (first - last)) / self._steps for s, first, last in zip(self._sum, self._first, self.last)]
