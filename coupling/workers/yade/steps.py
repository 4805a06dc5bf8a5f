"""Velocity Verlet out of YADE's leap-frog: what is put in, taken out and reported has positions and velocities of one instant.

    kick      v += dt/2 (f/m + g)                 no drift
    step      x += dt v;  f = forces(x, v)        the engines' loop with no force and no gravity in the integrator
    step      v += dt (f/m + g);  x += dt v;  f   the engines' loop as it is, for all other steps
    kick

YADE's integrator drifts with the step that it kicks with. For a kick alone it gets the step dt 2^-80 and a density scaling of
2^79: the first moves nothing, and both together are dt/2 to the bit.
"""
from yade import O
from yade.minieigenHP import Vector3
from yade.wrapper import (Bo1_Facet_Aabb, Bo1_Sphere_Aabb, ForceResetter, GlobalStiffnessTimeStepper, InsertionSortCollider,
                          NewtonIntegrator)

HALF_STEP, SCALING = 2.0 ** -80, 2.0 ** 79
MOST_AT_ONCE = 90
GRAIN_MASK, SURFACE_MASK = 1, 3  # bodies meet where masks share a bit; surfaces never meet each other


class Stepper:
    def __init__(self, setup, contacts, movers):
        self._dt = setup.timestep
        self._gravity = Vector3(*setup.gravity.tolist())
        self._newton = self._integrator()
        self._kicker = self._integrator()
        O.engines = [GlobalStiffnessTimeStepper(dead=True)]  # without one in sight the integrator takes no density scaling
        self._kicker.densityScaling = True
        skin = setup.skin if setup.skin > 0 else 0.5 * setup.max_radius
        self._collider = InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Facet_Aabb()], verletDist=skin, avoidSelfInteractionMask=2,
                                               sortAxis=int((setup.hi - setup.lo)[:2].argmax()))  # flows are shallow
        self._resetter = ForceResetter()
        self._loop = [self._newton, self._resetter, self._collider, contacts]
        self.take_movers(movers)
        O.dt = self._dt

    def take_movers(self, movers):
        O.engines = movers + self._loop

    def _integrator(self):
        return NewtonIntegrator(damping=0, gravity=self._gravity, warnNoForceReset=False)

    def sort_in(self, bodies):
        """Appends bodies a few at a time: more than a hundred that are new make YADE sort all from scratch, at ten times the cost."""
        ids = []
        for first in range(0, len(bodies), MOST_AT_ONCE):
            ids += O.bodies.append(bodies[first:first + MOST_AT_ONCE])
            self._collider()
        return ids

    def run(self, steps, after_forces):
        """after_forces(last): called after each step's forces."""
        self._kick()
        self._resetter()  # not O.forces.reset(): after a body was erased the next step would crash
        self._newton.gravity = Vector3.Zero
        O.step()
        self._newton.gravity = self._gravity
        for left in range(steps - 1, 0, -1):
            O.forces.f(0, True)  # adds up what the threads have summed
            after_forces(False)
            O.step()
        O.forces.f(0, True)
        after_forces(True)
        self._kick()

    def _kick(self):
        O.dt = self._dt * HALF_STEP
        self._kicker()
        O.dt = self._dt
