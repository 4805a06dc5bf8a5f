#!/usr/bin/python3
"""The rate of the YADE worker against that of a plain YADE script, on the same grains (bench/README.md).

    settle ----> checkpoint --+--> worker: restore, 50 windows of 40 steps, all grains returned after each
                              +--> plain:  the same bodies, O.run(2000)
"""
import argparse
import math
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

DIAMETER, SPREAD, DENSITY, G, TILT = 0.005, 0.1, 2650, 9.81, math.radians(45)
NX, NY, NZ = 25, 20, 20  # 10000 grains
PITCH = 1.12 * DIAMETER
LENGTH, WIDTH, HEIGHT = NX * PITCH, NY * PITCH, 0.3
WINDOW, STEPS = 40, 2000
YOUNGS_MODULUS, POISSON_RATIO = 5e6, 0.25


def setup(folder):
    """A floor and four walls; the box is tilted by turning gravity."""
    import numpy as np
    from couloir_yade.messages import Control, Setup, Surface

    def rectangle(o, a, b):
        o, a, b = (np.array(v, float) for v in (o, a, b))
        return np.array([[o, o + a, o + a + b], [o, o + a + b, o + b]])

    x, y, z = (LENGTH, 0, 0), (0, WIDTH, 0), (0, 0, HEIGHT)
    sides = {"floor": ((0, 0, 0), x, y), "x0": ((0, 0, 0), y, z), "x1": (x, y, z), "y0": ((0, 0, 0), x, z), "y1": (y, x, z)}
    least = 0.5 * DIAMETER * (1 - SPREAD)
    shear_modulus = YOUNGS_MODULUS / (2 * (1 + POISSON_RATIO))
    rayleigh = math.pi * least * math.sqrt(DENSITY / shear_modulus) / (0.1631 * POISSON_RATIO + 0.8766)
    return Setup(timestep=0.16 * rayleigh, gravity=np.array([G * math.sin(TILT), 0, -G * math.cos(TILT)]),
                 lo=np.full(3, -DIAMETER), hi=np.array([LENGTH + DIAMETER, WIDTH + DIAMETER, HEIGHT]),
                 periodic=np.zeros(3, bool), density=DENSITY, max_radius=0.5 * DIAMETER * (1 + SPREAD), skin=0, friction=0.5,
                 rolling_friction=0.15, restitution=0.5, youngs_modulus=YOUNGS_MODULUS, poisson_ratio=POISSON_RATIO,
                 contact="hertz", linear=None, rotation="free", control=Control(0, 0, 0, 0, 0), surfaces=[Surface(n, rectangle(*s), 0.5, 0.15) for n, s in sides.items()],
                 faces=[], ranks=1, timeout=60, work_dir=folder)


def loose_grains():
    from couloir_yade.messages import NewGrain
    grains = []
    for k in range(NZ):
        for j in range(NY):
            for i in range(NX):
                wiggle = 0.01 * DIAMETER * math.sin(17 * i + 5 * j + 11 * k)
                grains.append(NewGrain(len(grains) + 1,
                                       [(i + 0.5) * PITCH + wiggle, (j + 0.5) * PITCH - wiggle, (k + 0.6) * PITCH],
                                       [0.1 * math.cos(3 * i + j), 0.1 * math.sin(2 * j + k), -0.2],
                                       0.5 * DIAMETER * (1 + SPREAD * math.sin(29 * i + 13 * j + 7 * k)), -1, -1, [0, 0, 0]))
    return grains


def advance(session, steps, insert=()):
    """As the worker does it, with the answer packed."""
    from couloir_yade import messages
    import numpy as np
    answer = session.advance(messages.Request(steps, list(insert), np.zeros(0, np.int64), [], True, []))
    messages.pack(messages.ADVANCED, answer)
    return answer


def settle(folder, seconds):
    from couloir_yade.session import Session
    session = Session(setup(folder), "", lambda: None)
    advance(session, 1000, loose_grains())
    while session.step * session.setup.timestep < seconds:
        advance(session, 1000)
    session.checkpoint(f"{folder}/state")


def worker(folder):
    from couloir_yade.session import Session
    session = Session(setup(folder), f"{folder}/state", lambda: None)
    advance(session, WINDOW)
    begin = time.process_time()
    for _ in range(STEPS // WINDOW):
        advance(session, WINDOW)
    return time.process_time() - begin


def plain(folder):
    """The same bodies, contacts and law, with the engines in the order of YADE's manual."""
    from couloir_yade import load  # noqa: F401
    from couloir_yade import laws
    from yade import O
    from yade.wrapper import Bo1_Facet_Aabb, Bo1_Sphere_Aabb, ForceResetter, InsertionSortCollider, NewtonIntegrator
    s = setup(folder)
    O.load(f"{folder}/state", quiet=True)
    O.engines = [ForceResetter(), InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Facet_Aabb()], verletDist=0.5 * s.max_radius,
                                                        avoidSelfInteractionMask=2),
                 laws.interaction_loop(s, range(len(O.materials))), NewtonIntegrator(damping=0, gravity=s.gravity.tolist())]
    O.dt = s.timestep
    O.run(WINDOW, True)
    begin = time.process_time()
    O.run(STEPS, True)
    return time.process_time() - begin


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--repetitions", type=int, default=3)
    parser.add_argument("--settle", type=float, default=0.3, help="seconds simulated before the measurement")
    parser.add_argument("--part", choices=["settle", "worker", "plain"], help=argparse.SUPPRESS)
    parser.add_argument("--folder", help=argparse.SUPPRESS)
    a = parser.parse_args()
    sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "build/release/bin"))
    from couloir_yade import worker as _  # noqa: F401  (one thread)
    if a.part == "settle":
        return settle(a.folder, a.settle)
    if a.part:
        return print({"worker": worker, "plain": plain}[a.part](a.folder))

    def part(name, folder):
        words = [sys.executable, __file__, "--part", name, "--folder", folder, "--settle", str(a.settle)]
        return subprocess.run(words, check=True, capture_output=True, text=True).stdout.split()[-1:]

    with tempfile.TemporaryDirectory() as folder:
        part("settle", folder)
        rates = {"worker": [], "plain": []}
        for _ in range(a.repetitions):
            for name in rates:
                rates[name].append(NX * NY * NZ * STEPS / float(part(name, folder)[0]))
                print(f"{name}: {rates[name][-1] / 1e6:.3f} million particle-steps a second of CPU", flush=True)
        median = {name: statistics.median(r) for name, r in rates.items()}
        print(f"medians: worker {median['worker'] / 1e6:.3f}, plain {median['plain'] / 1e6:.3f}, ratio "
              f"{median['worker'] / median['plain']:.3f}; of the fastest {max(rates['worker']) / max(rates['plain']):.3f}")


main()
