"""What is said over the wire: coupling/engine/protocol.hpp in Python.

A structure is an array of its fields in the order of their declaration; a long vector of numbers is one block of bytes.
"""
from dataclasses import dataclass

import msgpack
import numpy as np

VERSION = 9
HELLO, START, STARTED, ADVANCE, CHECKPOINT, STOP, DONE, HEARTBEAT, ADVANCED, FAILED = range(10)
CONTACT_LAWS = ("hertz", "kelvin_voigt")
ROTATIONS = ("free", "blocked", "control")


@dataclass
class Surface:
    name: str
    triangles: np.ndarray  # [n, 3 corners, 3] m
    friction: float
    rolling_friction: float


@dataclass
class Bend:
    begin: float
    length: float
    foot: np.ndarray
    centre: np.ndarray


@dataclass
class Face:
    origin: np.ndarray
    inward: np.ndarray
    along: np.ndarray
    segment_width: float
    segments: int
    strip_begin: float
    strip_end: float
    bend: Bend


@dataclass
class Linear:
    stiffness: float
    shear_stiffness: float
    damping: float
    shear_damping: float
    surface_damping: float
    surface_shear_damping: float


@dataclass
class Control:
    retarding_time: float
    contact_influence: float
    shear_influence: float
    slide_to_roll: float
    roll_to_slide: float


@dataclass
class Setup:
    timestep: float
    gravity: np.ndarray
    lo: np.ndarray
    hi: np.ndarray
    periodic: np.ndarray
    density: float
    max_radius: float
    skin: float
    friction: float
    rolling_friction: float
    restitution: float
    youngs_modulus: float
    poisson_ratio: float
    contact: str
    linear: Linear
    rotation: str
    control: Control
    surfaces: list
    faces: list
    ranks: int
    timeout: float
    work_dir: str
    tangential_damping: bool = True


@dataclass
class NewGrain:
    id: int
    position: list
    velocity: list
    radius: float
    face: int
    segment: int
    spin: list


@dataclass
class Drive:
    push: float = 0.0
    most: float = 0.0
    least: float = 0.0
    along: float = 0.0
    least_mass: float = 0.0
    exit_active: bool = False
    exit_velocity: tuple = (0.0, 0.0, 0.0)
    slide: float = 0.0


@dataclass
class RimMove:
    faces: list
    driven: list  # (id, face, segment)


@dataclass
class Request:
    steps: int
    insert: list
    remove: np.ndarray
    drives: list  # [face][segment]; empty: as before
    want_grains: bool
    rim_moves: list  # one at most
    sample_steps: int = 0


def unpack(message):
    """The kind of a message and its body, still as lists."""
    parts = msgpack.unpackb(message, raw=False)
    if parts[0] != VERSION:
        raise ValueError(f"the program speaks version {parts[0]} of the protocol and the worker version {VERSION}; "
                         "build both again from the same sources")
    return parts[1], parts[2] if len(parts) > 2 else None


def pack(kind, body=None):
    return msgpack.packb([VERSION, kind] if body is None else [VERSION, kind, body])


def start(body):
    """The set-up, and the checkpoint to go on from or ''."""
    fields, restore = body
    s = Setup(*fields)
    for name in ("gravity", "lo", "hi"):
        setattr(s, name, np.array(getattr(s, name), float))
    s.periodic = np.array(s.periodic, bool)
    s.contact = CONTACT_LAWS[s.contact]
    s.linear = Linear(*s.linear)
    s.rotation = ROTATIONS[s.rotation]
    s.control = Control(*s.control)
    s.surfaces = [Surface(n, np.frombuffer(t).reshape(-1, 3, 3), f, r) for n, t, f, r in s.surfaces]
    s.faces = faces(s.faces)
    return s, restore


def faces(all):
    return [Face(*(np.array(v, float) for v in face[:3]), *face[3:7], bend(*face[7])) for face in all]


def bend(begin, length, foot, centre):
    return Bend(begin, length, np.array(foot, float), np.array(centre, float))


def request(body):
    steps, insert, remove, drives, want_grains, rim_moves, sample_steps = body
    return Request(steps, [NewGrain(*g) for g in insert], np.frombuffer(remove, np.int64),
                   [[Drive(*d) for d in face] for face in drives], want_grains,
                   [RimMove(faces(to), [tuple(g) for g in driven]) for to, driven in rim_moves], sample_steps)


def block(values, kind=float):
    return np.ascontiguousarray(values, kind).tobytes()


def vector(v):
    return [float(v[0]), float(v[1]), float(v[2])]
