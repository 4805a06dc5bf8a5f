"""Blocked rotation and rotation control (coupling/engine/rotation.hpp).

A grain that slides has its spin blocked, in the integrator, so that it has none at any step. Who slides, and the factor that slows
a spin, are looked up every few steps, for reading all contacts in Python takes as long as several steps: a spin is then slowed by
as many steps at once, which is the same where contacts last, and thresholds act up to as many steps late.
"""
import numpy as np
from yade import O

from .book import SPIN, VELOCITY

MOST_STEPS = 20             # between two looks ...
SHARE_OF_RETARDING = 0.2    # ... and of the retarding time at most
ONE_PLANE = 0.95            # cosine: facets met under normals as near as this are one contact, as a plane's two triangles are
BLOCKED, TURNING = "XYZ", ""


class Rotation:
    def __init__(self, setup, surface_bodies, step):
        self._rule, self._control, self._dt = setup.rotation, setup.control, setup.timestep
        self._surfaces = surface_bodies
        self._step = step
        self._every = max(1, min(MOST_STEPS, int(SHARE_OF_RETARDING * self._control.retarding_time / self._dt)))

    def at_first(self, spin):
        """Which degrees of freedom of a grain are blocked that comes free, with this spin."""
        return first_blocked(self._rule, self._control, spin)

    def post_force(self, book, held):
        """After each step's forces; held(): ids of the grains that are none of ours."""
        self._step += 1
        if self._rule == "control" and self._step % self._every == 0 and len(book):
            self._look(book, held())

    def _look(self, book, held):
        states = book.states()
        contacts, shear = self._count(book, states)
        ours = (contacts > 0) & ~np.isin(book.ids, np.fromiter(held, np.int64, len(held)))
        c, spin = self._control, states[:, SPIN]
        spins = (spin != 0).any(1)
        slides = ours & (shear < np.where(spins, c.roll_to_slide, c.slide_to_roll))
        k = 1 / (1 + contacts.astype(float) ** c.contact_influence)
        slowed = spin * (k ** (self._every * self._dt / (c.shear_influence * shear + c.retarding_time)))[:, None]
        slowed[slides] = 0
        for row in np.flatnonzero(ours & spins):
            O.bodies[int(book.bodies[row])].state.angVel = slowed[row].tolist()
        if c.slide_to_roll > 0:
            for row in np.flatnonzero(ours & (slides | ~spins)):
                O.bodies[int(book.bodies[row])].state.blockedDOFs = BLOCKED if slides[row] else TURNING

    def _count(self, book, states):
        """Of each grain of the book: its contacts, and its shear velocity [m/s] or 0."""
        found = [(i.id1, i.id2, *i.geom.normal) for i in O.interactions]
        if not found:
            return np.zeros(len(book), int), np.zeros(len(book))
        found = np.array(found)
        row_of = np.full(max(int(book.bodies.max()), max(map(max, filter(None, self._surfaces)), default=0)) + 1, -1)
        row_of[book.bodies] = np.arange(len(book))
        a, b = row_of[found[:, 0].astype(int)], row_of[found[:, 1].astype(int)]
        normal = found[:, 2:]
        stay = one_a_plane(np.where(a < 0, b, a), (a < 0) | (b < 0), normal)
        a, b, normal = a[stay], b[stay], normal[stay]
        velocity = np.vstack([states[:, VELOCITY], np.zeros(3)])  # row -1: a surface
        u = velocity[a] - velocity[b]
        along = u - (u * normal).sum(1)[:, None] * normal
        speed = np.sqrt((along ** 2).sum(1))
        contacts, shear = np.zeros(len(book), int), np.zeros(len(book))
        for side in (a, b):
            contacts += np.bincount(side[side >= 0], minlength=len(book))
            shear += np.bincount(side[side >= 0], speed[side >= 0], len(book))
        return contacts, shear / np.maximum(contacts, 1)


def first_blocked(rule, control, spin):
    slides = rule == "blocked" or (rule == "control" and control.slide_to_roll > 0 and not any(spin))
    return BLOCKED if slides else TURNING


def one_a_plane(row, on_surface, normal):
    """Which contacts stay: of a grain's with surfaces, one of those in one plane."""
    stay = np.ones(len(row), bool)
    at = np.flatnonzero(on_surface)
    at = at[np.argsort(row[at], kind="stable")]
    kept = []
    for n, k in enumerate(at):
        if n == 0 or row[at[n - 1]] != row[k]:
            kept = []
        if any(abs(normal[k] @ other) > ONE_PLANE for other in kept):
            stay[k] = False
        else:
            kept.append(normal[k])
    return stay
