"""Rafts and exit strips of the rim faces (coupling/engine/grain_engine.hpp), every step, after all forces.

    x += dt v                                     the step's drift, with the velocity set a step ago
    f  = contacts
    release     distance >= 0: free for good
    raft        u <- u + dt (sum (f + m g).n + push) / m, clipped to [least, most]
    set         v = u n + slide along for the next drift; the grains' degrees of freedom are blocked, so the integrator leaves them alone

A raft is moved by a TranslationEngine and its forces are summed by a ForceRecorder, both C++ over a list of bodies: a step costs
the same however many grains a raft has. Grains of a strip keep the velocity they are given, since nothing else changes it; so do
those of a raft beside an arc, which are turned step by step.
"""
import math

import numpy as np
from yade import O
from yade.minieigenHP import Vector3
from yade.wrapper import ForceRecorder, TranslationEngine

from . import face as faces_
from .book import POSITION, states_of
from .messages import Drive as SegmentDrive
from .rotation import first_blocked

FIXED = "xyzXYZ"
STRIP_SLACK = 0.02  # [diameters] that a grain may go between two looks at who is in a strip


class Member:
    """A grain that is held: its id, body, mass and state; key: what a raft's travel must reach for it to pass the plane."""

    def __init__(self, id, body, mass, state, key=0.0):
        self.id, self.body, self.mass, self.state, self.key = id, body, mass, state, key


class Raft:
    def __init__(self, face):
        self.face = face
        self.origin, self.inward, self.along = (Vector3(*v.tolist()) for v in (face.origin, face.inward, face.along))
        self.bends = face.bend.length > 0
        self.drive = SegmentDrive()
        self.velocity = self.mass = self.travel = self.displacement = self.force = 0.0
        self.members = []  # the next to pass the plane last
        self.mover = TranslationEngine(translationAxis=self.inward, dead=True)
        self.probe = ForceRecorder()

    def distance(self, position):
        return (position - self.origin).dot(self.inward)

    def directions(self, members):
        """For each: the direction along the face, and how fast a layer that slides at 1 moves there."""
        if not self.bends or not members:
            return [(self.along, 1.0)] * len(members)
        directions, paces = faces_.courses(self.face, [m.state.pos for m in members])
        return [(Vector3(*v), pace) for v, pace in zip(directions.tolist(), paces.tolist())]

    def segments(self, members):
        """The segment of its face where each is."""
        s = faces_.place_along(self.face, [m.state.pos for m in members])
        return np.clip(np.floor(s / self.face.segment_width).astype(int), 0, self.face.segments - 1).tolist()

    def course(self, direction, pace=1.0):
        """The velocity of its grain there."""
        return self.velocity * self.inward + self.drive.slide * pace * direction

    def steer(self):
        """After the course has changed."""
        if self.drive.slide == 0:
            self.mover.translationAxis, self.mover.velocity = self.inward, self.velocity
            return
        course = self.course(self.along)
        speed = course.norm() or 1.0
        self.mover.translationAxis, self.mover.velocity = course / speed, speed

    def settle_members(self):
        """After members came or went."""
        self.members.sort(key=lambda m: (m.key, -m.id))
        self.mass = math.fsum(m.mass for m in self.members)
        self.mover.ids = self.probe.ids = [m.body for m in self.members]
        self.mover.dead = not self.members or self.bends

    def speed(self, wanted):
        d = self.drive
        return d.most if not self.members or self.mass < d.least_mass else min(max(wanted, d.least), d.most)


class Drive:
    def __init__(self, setup, wrap):
        self._gravity = Vector3(*setup.gravity.tolist())
        self._dt = setup.timestep
        self._edge = setup.max_radius  # a strip reaches so far past its face's ends
        self._slack = STRIP_SLACK * 2 * setup.max_radius
        self._wrap = wrap
        self.faces = setup.faces
        self._free = first_blocked(setup.rotation, setup.control, (0, 0, 0))  # what of a grain that is let go stays blocked
        self.rafts = [Raft(face) for face in setup.faces for _ in range(face.segments)]
        self.first_raft = np.cumsum([0] + [face.segments for face in setup.faces])
        self.held = {}  # by id: the grains in strips
        self._strip_probe = ForceRecorder()
        self._near = []
        self.taken = Vector3.Zero
        self._taken_sum = self._taken_first = self._jump = Vector3.Zero
        self._held_mass = 0.0

    def movers(self):
        return [raft.mover for raft in self.rafts]

    def driven_ids(self):
        """Ids of driven grains and the raft of each."""
        pairs = [(m.id, k) for k, raft in enumerate(self.rafts) for m in raft.members]
        return np.array(pairs, np.int64).reshape(-1, 2).T

    def has_strips(self):
        return bool(self.held) or any(raft.drive.exit_active for raft in self.rafts)

    def all_held(self):
        """Ids of the grains of rafts and strips, which get no kicks."""
        return self.held.keys() | {m.id for raft in self.rafts for m in raft.members}

    def forget(self, ids):
        """Of grains that are removed."""
        gone = set(ids)
        for raft in self.rafts:
            if any(m.id in gone for m in raft.members):
                raft.members = [m for m in raft.members if m.id not in gone]
                raft.settle_members()
        if gone & self.held.keys():
            for id in gone:
                self.held.pop(id, None)
            self.settle_held()

    def begin_window(self, drives, rim_move=None):
        """Before grains are put in; `drives` are empty or one for each segment of each face."""
        self._jump = self._taken_sum = Vector3.Zero
        self._taken_first = self.taken
        self._near = []
        if rim_move:
            self._move_rim(*rim_move)
        for raft, drive in zip(self.rafts, [d for face in drives for d in face]):
            if not raft.bends:
                self._jump = self._jump + raft.mass * (drive.slide - raft.drive.slide) * raft.along
            raft.drive = drive
        self._regroup()
        for raft in self.rafts:
            raft.displacement = raft.force = 0.0
            self._set_speed(raft, raft.speed(raft.velocity))

    def _regroup(self):
        """What has slid into another segment goes on with that one's raft."""
        changed = []
        for first, face in zip(self.first_raft, self.faces):
            own = self.rafts[first:first + face.segments]
            if len(own) < 2 or not any(raft.drive.slide for raft in own):
                continue
            for raft in own:
                if raft.members and raft.drive.slide:
                    for m, segment in zip(raft.members, raft.segments(raft.members)):
                        to = self.rafts[first + segment]
                        if to is not raft:
                            changed.append((raft, to, m))
        for raft, to, m in changed:
            raft.members.remove(m)
            m.key = to.distance(m.state.pos) - to.travel
            to.members.append(m)
            if not to.bends:
                self._jump = self._jump + m.mass * (to.course(to.along) - raft.course(raft.along))
        for raft in {r for raft, to, _ in changed for r in (raft, to)}:
            raft.settle_members()

    def _move_rim(self, faces, members, places, take_movers):
        """Onto new faces; members belong to the rafts at `places`, all others that were driven are free."""
        for raft in self.rafts:
            for m in raft.members:  # they get this step's half kick
                self._taken_first = self._taken_first - self._pull(m)
            while raft.members:
                self._release_last(raft)
            raft.settle_members()
        self.faces = faces
        self.rafts = [Raft(face) for face in faces for _ in range(face.segments)]
        self.first_raft = np.cumsum([0] + [face.segments for face in faces])
        take_movers(self.movers())
        for member, (face, segment) in zip(members, places):
            raft = self.rafts[self.first_raft[face] + segment]
            self.held.pop(member.id, None)
            if member.state.blockedDOFs != FIXED:  # the half kick that this step will not give it
                self._taken_first = self._taken_first + self._pull(member)
            member.state.blockedDOFs = FIXED
            member.state.angVel = Vector3.Zero
            member.key = raft.distance(member.state.pos)
            raft.members.append(member)
        self.settle_held()
        for raft in self.rafts:
            raft.settle_members()
            if raft.members:
                momentum = math.fsum(m.mass * m.state.vel.dot(raft.inward) for m in raft.members)
                raft.velocity = momentum / raft.mass
                for m in raft.members if not raft.bends else []:
                    self._jump = self._jump + m.mass * (raft.velocity * raft.inward - m.state.vel)

    def _pull(self, member):
        return O.forces.f(member.body) + member.mass * self._gravity

    def put_in(self, raft, member, velocity):
        """A new grain of a raft; velocity: as it was given."""
        member.state.blockedDOFs = FIXED
        member.key = raft.distance(member.state.pos) - raft.travel
        course = raft.course(*raft.directions([member])[0])
        self._jump = self._jump + member.mass * (course - velocity)
        if raft.bends:
            member.state.vel = course
        raft.members.append(member)

    def watch(self, ids, bodies, mass, states, steps, body_of):
        """Notes the free grains that may be in a strip within so many steps; all arguments are of grains that are not driven."""
        exits = [raft.drive.exit_velocity for raft in self.rafts if raft.drive.exit_active]
        if not len(ids):
            return
        fastest = math.sqrt(max([(states[:, 3:6] ** 2).sum(1).max()] + [sum(c * c for c in v) for v in exits]))
        reach = 2 * fastest * steps * self._dt + 2 * self._edge  # room for grains that speed up
        position = self._wrap(states[:, POSITION])
        near = np.isin(ids, np.array(list(self.held), np.int64))
        for face in self.faces:
            d = (position - face.origin) @ face.inward
            near |= (d >= -face.strip_end - reach) & (d <= -face.strip_begin + reach)
        self._near = [self.held.get(int(i)) or Member(int(i), int(b), float(m), body_of(int(b)).state)
                      for i, b, m in zip(ids[near], bodies[near], mass[near])]
        self._pause = max(1, int(self._slack / (fastest * self._dt))) if fastest > 0 else 1
        self._until_look = 0

    def post_force(self, last):
        taken = Vector3.Zero
        for raft in self.rafts:
            way = raft.velocity * self._dt
            raft.displacement += way
            raft.travel += way
            if raft.members and raft.distance(raft.members[-1].state.pos) >= 0:
                self._release(raft)
            if not raft.members:
                raft.velocity = raft.drive.most
                continue
            raft.probe()
            force = raft.probe.totalForce + raft.mass * self._gravity
            along = force.dot(raft.inward)
            raft.force += along
            self._set_speed(raft, raft.speed(raft.velocity + self._dt * (along + raft.drive.push) / raft.mass))
            taken = taken + force
        if self._near:
            if self._until_look == 0 or last:
                self._look()
                self._until_look = self._pause
            self._until_look -= 1
        if self.held:
            self._strip_probe()
            taken = taken + self._strip_probe.totalForce + self._held_mass * self._gravity
        self.taken = taken
        self._taken_sum = self._taken_sum + taken

    def impulse(self):
        """[N s] that setting velocities gave to the grains beyond the forces that it took away, in this window."""
        return self._jump - self._dt * (self._taken_sum + 0.5 * (self._taken_first - self.taken))

    def settle_held(self):
        members = [self.held[id] for id in sorted(self.held)]
        self._held_mass = math.fsum(m.mass for m in members)
        self._strip_probe.ids = [m.body for m in members]

    def _set_speed(self, raft, speed):
        if raft.bends:
            raft.velocity = speed
            self._turn(raft)
            return
        if raft.members:
            self._jump = self._jump + raft.mass * (speed - raft.velocity) * raft.inward
        raft.velocity = speed
        raft.steer()

    def _turn(self, raft):
        for m, there in zip(raft.members, raft.directions(raft.members)):
            course = raft.course(*there)
            self._jump = self._jump + m.mass * (course - m.state.vel)
            m.state.vel = course

    def _release(self, raft):
        while raft.members and raft.distance(raft.members[-1].state.pos) >= 0:
            self._release_last(raft)
        raft.settle_members()

    def _release_last(self, raft):
        m = raft.members.pop()
        direction, _ = raft.directions([m])[0]
        was = Vector3(m.state.vel) if raft.bends else raft.course(direction)
        m.state.vel = raft.velocity * raft.inward + raft.drive.along * direction
        m.state.blockedDOFs = self._free
        self._jump = self._jump + m.mass * (m.state.vel - was)

    def _look(self):
        """Who is in a strip now?"""
        position = self._wrap(states_of([m.body for m in self._near])[:, POSITION])
        raft_of = np.full(len(position), -1)
        for face, first in zip(self.faces, self.first_raft):
            d = (position - face.origin) @ face.inward
            s = faces_.place_along(face, position)
            within = ((d >= -face.strip_end) & (d <= -face.strip_begin) & (s >= -self._edge) &
                      (s <= face.segments * face.segment_width + self._edge) & (raft_of < 0))
            segment = np.clip(np.floor(s / face.segment_width).astype(int), 0, face.segments - 1)
            active = np.array([self.rafts[first + k].drive.exit_active for k in range(face.segments)])
            raft_of = np.where(within & active[segment], first + segment, raft_of)
        changed = False
        for row in np.flatnonzero((raft_of >= 0) | np.array([m.id in self.held for m in self._near])):
            m = self._near[row]
            if raft_of[row] < 0:
                m.state.blockedDOFs = self._free
                del self.held[m.id]
                changed = True
                continue
            raft = self.rafts[raft_of[row]]
            leaving = np.array(raft.drive.exit_velocity)
            velocity = Vector3(*(faces_.turned(raft.face, leaving, position[row])[0] if raft.bends else leaving).tolist())
            if m.id not in self.held:
                m.state.blockedDOFs = FIXED
                m.state.angVel = Vector3.Zero
                self.held[m.id] = m
                changed = True
            if m.state.vel != velocity:
                self._jump = self._jump + m.mass * (velocity - m.state.vel)
                m.state.vel = velocity
        if changed:
            self.settle_held()
