"""The one run of YADE in this process."""
import time

from . import load
import numpy as np
from yade import O, utils
from yade.minieigenHP import Matrix3, Vector3

from . import checkpoint, laws, messages, requests, surfaces
from .book import POSITION, SPIN, VELOCITY, Book
from .drive import Drive, Member
from .rotation import Rotation
from .steps import GRAIN_MASK, SCALING, Stepper


class Session:
    def __init__(self, setup, restore, beat):
        """Starts anew, or goes on from a checkpoint. `beat` is called after each step."""
        self.name = f"YADE {load.VERSION}"
        self.setup = setup
        self._beat = beat
        self._gravity = Vector3(*setup.gravity.tolist())
        self.step = 0
        self.book = Book(setup.density)
        if restore:
            checkpoint.load(self, restore)
        else:
            self._build()
            self.equip()
        self._write_log()

    def _build(self):
        if self.setup.periodic.any():
            self._make_periodic()
        O.materials.append(laws.materials(self.setup))
        self.surface_bodies = surfaces.put_up(self.setup, list(O.materials)[1:])

    def _make_periodic(self):
        # YADE is periodic along all axes or none: the others get room for all that is there and a gap.
        s = self.setup
        corners = np.concatenate([[s.lo, s.hi]] + [surface.triangles.reshape(-1, 3) for surface in s.surfaces])
        room = 2 * (corners.max(0) - corners.min(0)) + 20 * s.max_radius
        O.periodic = True
        O.cell.hSize = Matrix3(*np.diag(np.where(s.periodic, s.hi - s.lo, room)).ravel().tolist())

    def _probe_zone(self, last):
        self.zone_probe = surfaces.Probes([surfaces.inside(self.surface_bodies, self.setup.faces)], last)

    def equip(self, last=None, zone_force=None):
        """Engines around the bodies that are there; last: forces on the surfaces, on those of the zone."""
        # Else YADE takes removed bodies out of its sorted list and forgets where a periodic list begins: the next sort may not end.
        O.bodies.enableRedirection = False
        self.drive = Drive(self.setup, self._wrap)
        self.probes = surfaces.Probes(self.surface_bodies, last)
        self._probe_zone([zone_force] if zone_force else None)
        self.rotation = Rotation(self.setup, self.surface_bodies, self.step)
        self._stepper = Stepper(self.setup, laws.interaction_loop(self.setup, range(len(O.materials))), self.drive.movers())

    def checkpoint(self, path):
        checkpoint.save(self, path)
        checkpoint.load(self, path)  # from here on the writer has the bits of a reader

    def advance(self, request):
        cpu = time.process_time()
        requests.check(request, self.setup, self.book)
        self.probes.begin_window(request.sample_steps)
        self.zone_probe.begin_window()
        exchange = self._remove(request.remove)
        self.drive.begin_window(request.drives, self._move_rim(request.rim_moves))
        exchange = exchange + self._insert(request.insert)
        if request.steps > 0:
            self._watch_strips(request.steps)
            self._stepper.run(request.steps, self._after_forces)
            self.step += request.steps
        states = self._states()
        self._check_none_lost(states)
        return self._report(request, states, exchange, cpu)

    def _after_forces(self, last):
        self.probes.read()
        self.zone_probe.read()
        self.rotation.post_force(self.book, self.drive.all_held)
        self.drive.post_force(last)
        self._beat()

    def _remove(self, ids):
        """Returns the impulse [N s] of the half kick that the others get from grains that are gone, with gravity left out."""
        impulse = Vector3.Zero
        half = 0.5 * self.setup.timestep
        held = self.drive.all_held() if len(ids) else ()
        rows = self.book.rows(ids)
        for id, body, mass in zip(ids.tolist(), self.book.bodies[rows].tolist(), self.book.mass[rows].tolist()):
            impulse = impulse + (half * mass * self._gravity if id in held else -half * O.forces.f(body))
            O.bodies.erase(body)
        self.drive.forget(ids.tolist())
        self.book.remove(ids)
        return impulse

    def _insert(self, grains):
        """Returns the impulse [N s] of the kick that new driven grains do not get."""
        impulse = Vector3.Zero
        if not grains:
            return impulse
        spheres = [utils.sphere(Vector3(*g.position), g.radius, material=0, mask=GRAIN_MASK) for g in grains]
        few = len(spheres) < 0.3 * len(self.book)  # else a sort from scratch is as good
        ids = self._stepper.sort_in(spheres) if few else O.bodies.append(spheres)
        rafts = set()
        for g, id, sphere in zip(grains, ids, spheres):
            state = sphere.state
            state.densityScaling = SCALING
            state.vel = Vector3(*g.velocity)
            if g.segment < 0:
                state.angVel = Vector3(*g.spin)
                state.blockedDOFs = self.rotation.at_first(g.spin)
                if state.blockedDOFs and self.setup.rotation == 'blocked':
                    state.angVel = Vector3.Zero
                continue
            raft = self.drive.rafts[self.drive.first_raft[g.face] + g.segment]
            member = Member(g.id, id, float(self.book.mass_of(g.radius)), state)
            self.drive.put_in(raft, member, state.vel)
            rafts.add(raft)
            impulse = impulse - 0.5 * self.setup.timestep * member.mass * self._gravity
        for raft in rafts:
            raft.settle_members()
        self.book.add([g.id for g in grains], ids, [g.radius for g in grains])
        return impulse

    def _move_rim(self, moves):
        """The new faces and the grains that belong to their rafts; None where the rim stays."""
        if not moves:
            return None
        self.setup.faces = moves[0].faces
        self._probe_zone(self.zone_probe.last)
        ids = np.array([id for id, _, _ in moves[0].driven], np.int64)
        rows = self.book.rows(ids)
        members = [Member(int(id), int(body), float(mass), O.bodies[int(body)].state)
                   for id, body, mass in zip(ids, self.book.bodies[rows], self.book.mass[rows])]
        return moves[0].faces, members, [(face, segment) for _, face, segment in moves[0].driven], self._stepper.take_movers

    def _watch_strips(self, steps):
        if not self.drive.has_strips():
            return
        free = ~self._driven()
        book = self.book
        self.drive.watch(book.ids[free], book.bodies[free], book.mass[free], book.states()[free], steps, O.bodies.__getitem__)

    def _driven(self):
        driven = np.zeros(len(self.book), bool)
        driven[self.book.rows(self.drive.driven_ids()[0])] = True
        return driven

    def _states(self):
        """All grains, those of rafts with the velocity that their raft has now."""
        states = self.book.states()
        ids, rafts = self.drive.driven_ids()
        rows = self.book.rows(ids)
        velocities = np.array([messages.vector(raft.course(raft.along)) for raft in self.drive.rafts]).reshape(-1, 3)
        moved = ~np.array([raft.bends for raft in self.drive.rafts], bool)[rafts]  # the others have theirs
        states[rows[moved], VELOCITY] = velocities[rafts[moved]]
        states[rows, SPIN] = 0
        return states

    def _wrap(self, position):
        """Into the box along periodic axes: YADE lets grains wander off."""
        s = self.setup
        size = s.hi - s.lo
        return np.where(s.periodic, position - size * np.floor((position - s.lo) / size), position)

    def _check_none_lost(self, states):
        s, x = self.setup, states[:, POSITION]
        if not np.isfinite(states).all():
            raise requests.RanAway(f"by step {self.step} the motion of a grain is no longer a finite number")
        lost = ~((s.periodic | ((x >= s.lo) & (x <= s.hi))).all(1))
        if lost.any():
            box = ", ".join(f"{lo:g}..{hi:g}" for lo, hi in zip(s.lo, s.hi))
            raise requests.RanAway(f"by step {self.step} {lost.sum()} of {len(lost)} grains have left the box ({box}) m")

    def _report(self, request, states, exchange, cpu):
        mass, radius = self.book.mass, self.book.radius
        energy = 0.5 * mass @ ((states[:, VELOCITY] ** 2).sum(1) + 0.4 * radius ** 2 * (states[:, SPIN] ** 2).sum(1))
        rafts, steps = iter(self.drive.rafts), max(1, request.steps)
        segments = [[[r.displacement, r.velocity, r.force / steps, r.mass] for r in (next(rafts) for _ in range(face.segments))]
                    for face in self.setup.faces]
        columns = [[]] * 9
        if request.want_grains:
            x, v = self._wrap(states[:, POSITION]), states[:, VELOCITY]
            columns = [self.book.ids, *x.T, *v.T, radius, self._driven()]
        kinds = [np.int64] + 7 * [float] + [np.int8]
        return [self.step, [messages.block(c, k) for c, k in zip(columns, kinds)],
                messages.block([messages.vector(f) for f in self.probes.mean()]),
                messages.block([messages.vector(f) for f in self.probes.last]), segments,
                messages.vector(self.drive.impulse() + exchange), float(energy), self._largest_overlap(),
                time.process_time() - cpu, messages.vector(-self.zone_probe.mean()[0]),
                [messages.block([messages.vector(f) for f in samples]) for samples in self.probes.samples]]

    def _largest_overlap(self):
        # YADE's own count, over the harmonic mean of the two diameters: at most (r1 + r2)^2 / (4 r1 r2) times that over the mean.
        return 0.5 * max(0.0, utils.maxOverlapRatio()) if len(self.book) else 0.0

    def _write_log(self):
        with open(f"{self.setup.work_dir}/engine.log", "w") as log:
            log.write(f"{self.name}, contact {self.setup.contact}, time step {self.setup.timestep:.17g} s, "
                      f"{sum(map(len, self.surface_bodies))} facets, from step {self.step}\n")
