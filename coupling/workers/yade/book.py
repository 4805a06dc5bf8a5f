"""Which grain is which body, and all grains' states at once."""
import numpy as np
from yade.wrapper import Subdomain

POSITION, VELOCITY, SPIN = slice(0, 3), slice(3, 6), slice(6, 9)
WIDTH = 13  # numbers of a body: position, velocity, spin, orientation


def states_of(bodies):
    """[n, WIDTH] of a list of bodies, read in C++."""
    return np.array(Subdomain().getStateValuesFromIds(bodies), float).reshape(-1, WIDTH)


class Book:
    """By rising id of the grain."""

    def __init__(self, density):
        self._density = density
        self.ids = np.zeros(0, np.int64)
        self.bodies = np.zeros(0, np.int64)
        self.radius = np.zeros(0)
        self._list = []

    def __len__(self):
        return len(self.ids)

    @property
    def mass(self):
        return self.mass_of(self.radius)

    def mass_of(self, radius):
        return 4.0 / 3.0 * np.pi * radius ** 3 * self._density

    def has(self, ids):
        return np.isin(ids, self.ids)

    def rows(self, ids):
        """Of ids that are there."""
        return np.searchsorted(self.ids, ids)

    def remove(self, ids):
        stay = ~np.isin(self.ids, ids)
        self._set(self.ids[stay], self.bodies[stay], self.radius[stay])

    def add(self, ids, bodies, radius):
        self._set(np.append(self.ids, ids), np.append(self.bodies, bodies), np.append(self.radius, radius))

    def states(self):
        return states_of(self._list) if self._list else np.zeros((0, WIDTH))

    def _set(self, ids, bodies, radius):
        order = np.argsort(ids, kind="stable")
        self.ids, self.bodies, self.radius = ids[order], bodies[order], radius[order]
        self._list = self.bodies.tolist()
