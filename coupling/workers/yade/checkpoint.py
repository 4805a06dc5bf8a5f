"""A checkpoint is YADE's own file of all bodies and contacts and, beside it, PATH.drive: all that YADE does not know."""
import os

import numpy as np
from yade import O
from yade.minieigenHP import Vector3

from . import messages
from .drive import Member

LAYOUT = "couloir yade 3"


def save(session, path):
    drive, book = session.drive, session.book
    driven, rafts = drive.driven_ids()
    rows = book.rows(driven)
    keys = {m.id: m.key for raft in drive.rafts for m in raft.members}
    bodies = book.bodies.tolist()
    side = {
        "layout": LAYOUT, "faces": segments_of(session.setup), "step": session.step,
        "ids": book.ids, "bodies": book.bodies, "radius": book.radius,
        "force": vectors(O.forces.f(b) for b in bodies), "torque": vectors(O.forces.t(b) for b in bodies),
        "surface_bodies": np.array([len(b) for b in session.surface_bodies]),
        "surface_force": vectors(session.probes.last), "zone_force": vectors(session.zone_probe.last), "taken": vectors([drive.taken]),
        "driven": driven, "rafts": rafts, "keys": np.array([keys[i] for i in driven.tolist()]),
        "held": np.array(sorted(drive.held), np.int64),
        "raft_state": np.array([[r.velocity, r.travel] for r in drive.rafts]).reshape(-1, 2),
        "drives": np.array([[d.push, d.most, d.least, d.along, d.least_mass, d.exit_active, *d.exit_velocity, d.slide]
                            for d in (r.drive for r in drive.rafts)], float).reshape(-1, 10),
    }
    try:
        with open(path + ".drive.part", "wb") as out:
            np.savez(out, **side)
        O.save(path + ".part", quiet=True)
        os.replace(path + ".drive.part", path + ".drive")
        os.replace(path + ".part", path)
    except (OSError, RuntimeError) as error:
        raise RuntimeError(f"the checkpoint {path} cannot be written: {error}") from error


def load(session, path):
    side = read_side(path + ".drive", session.setup)
    try:
        O.load(path, quiet=True)
    except Exception as error:
        raise RuntimeError(f"the checkpoint {path} cannot be read: {error}") from error
    session.step = int(side["step"])
    session.book.remove(session.book.ids)
    session.book.add(side["ids"], side["bodies"], side["radius"])
    ends = np.cumsum(side["surface_bodies"]).tolist()
    session.surface_bodies = [list(range(begin, end)) for begin, end in zip([0] + ends, ends)]
    session.equip([Vector3(*f) for f in side["surface_force"].tolist()], Vector3(*side["zone_force"][0].tolist()))
    for body, force, torque in zip(side["bodies"].tolist(), side["force"].tolist(), side["torque"].tolist()):
        O.forces.addF(body, Vector3(*force))
        O.forces.addT(body, Vector3(*torque))
    O.forces.f(0, True)
    restore_drive(session, side)


def restore_drive(session, side):
    drive, book = session.drive, session.book
    drive.taken = Vector3(*side["taken"][0].tolist())

    def member(id, key):
        row = book.rows(id)
        body = int(book.bodies[row])
        return Member(id, body, float(book.mass[row]), O.bodies[body].state, key)

    for raft, (velocity, travel), d in zip(drive.rafts, side["raft_state"].tolist(), side["drives"].tolist()):
        raft.drive = messages.Drive(*d[:5], bool(d[5]), tuple(d[6:9]), d[9])
        raft.velocity, raft.travel = velocity, travel
        raft.steer()
    for id, raft, key in zip(side["driven"].tolist(), side["rafts"].tolist(), side["keys"].tolist()):
        drive.rafts[raft].members.append(member(id, key))
    for raft in drive.rafts:
        raft.settle_members()
    drive.held = {id: member(id, 0.0) for id in side["held"].tolist()}
    drive.settle_held()


def read_side(path, setup):
    foreign = f"{path} is missing or does not belong to this scene's zone"
    try:
        side = dict(np.load(path))
    except Exception as error:
        raise RuntimeError(f"{foreign} ({error})") from error
    if str(side.get("layout")) != LAYOUT or not np.array_equal(side["faces"], segments_of(setup)):
        raise RuntimeError(foreign)
    return side


def segments_of(setup):
    return np.array([face.segments for face in setup.faces])


def vectors(all):
    return np.array([messages.vector(v) for v in all]).reshape(-1, 3)
