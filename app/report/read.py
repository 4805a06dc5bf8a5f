"""A run's folder as plain arrays: records.h5 and summary.json."""

import json
from functools import cached_property
from pathlib import Path

import h5py
import numpy as np

MODES = ("grains", "coupled", "continuum")  # from the most to the least accurate


class NoRun(Exception):
    """The folder holds no readable record; the text says which and what to do."""


class Frame:
    """One stored instant. Arrays are read when asked for; absent ones are None."""

    def __init__(self, run, group):
        self.run, self.group = run, group
        self.time = float(group["time"][()])

    def flow(self, name="h"):
        return self.group[name][()] if name in self.group else None

    @cached_property
    def places(self):
        """The blocks of a refined mesh: rows of level, i0, j0, nx, ny; none where all cells are of one size."""
        if "blocks" not in self.group:
            return np.empty((0, 5), dtype=int)
        return np.column_stack([self.group[f"blocks/{name}"][()] for name in ("level", "i0", "j0", "nx", "ny")])

    def blocks(self, name="h"):
        """(level, i0, j0, values [y, x]) of each block, coarser ones first; (i0, j0) counts cells of its level."""
        if not len(self.places):
            return
        values, first = self.group[f"blocks/{name}"][()], np.concatenate([[0], np.cumsum(self.places[:, 3] * self.places[:, 4])])
        for k in np.argsort(self.places[:, 0], kind="stable"):
            level, i0, j0, nx, ny = self.places[k]
            yield level, i0, j0, values[first[k]:first[k + 1]].reshape(ny, nx)

    @property
    def zones(self):
        """[n, 4]: x from, x to, y from, y to [m] of each rectangle that grains hold."""
        return self.group["zones"][()] if "zones" in self.group else np.zeros((0, 4))

    def grains(self):
        """dict of s, y, n (along, across, above the surface) [m], radius [m], speed [m/s], driven; or None."""
        if "grains" not in self.group or self.group["grains/id"].size == 0:
            return None
        g = self.group["grains"]
        s, n = self.run.surface_coordinates(g["position"][()])
        speed = np.sqrt(g["vx"][()] ** 2 + g["vy"][()] ** 2 + g["vz"][()] ** 2)
        return {"s": s, "y": g["y"][()], "n": n, "radius": g["radius"][()], "speed": speed, "driven": g["driven"][()]}


class Run:
    def __init__(self, path):
        self.path = Path(path)
        try:
            self.file = h5py.File(self.path / "records.h5", "r")
        except FileNotFoundError:
            raise NoRun(f"{path} holds no records.h5, so it is not the folder of a run")
        except OSError as error:
            raise NoRun(f"{path}/records.h5 cannot be read: {error}")
        if not {"windows", "frames", "events"} <= set(self.file):
            raise NoRun(f"{path}/records.h5 ends before the run began, so there is nothing to show")
        self.attributes = dict(self.file.attrs)
        if self.attributes.get("format_version") != 1:
            raise NoRun(f"{path}/records.h5 is of another layout than this version reads; take the version that wrote it")
        self.summary = self._summary(self.path / "summary.json")
        self.windows = {name: data[()] for name, data in self.file["windows"].items()}
        self.time = self.windows["time"]
        self.frames = [Frame(self, group) for _, group in sorted(self.file["frames"].items())]
        self.obstacles = {name: dict(group.attrs) for name, group in self.file["obstacles"].items()}
        for name, group in self.file["obstacles"].items():
            if "triangles" in group:
                self.obstacles[name]["triangles"] = group["triangles"][()]  # [triangle, corner, (x, y, height)] of any body [m]
        self.forces = {name: {key: data[()] for key, data in group.items()} for name, group in self.file["forces"].items()}
        stresses = self.file["stresses"].items() if "stresses" in self.file else ()
        self.stresses = {(of, name): {key: data[()] for key, data in gauge.items()}
                         for of, gauges in stresses for name, gauge in gauges.items()}
        samples = self.file["force_samples"].items() if "force_samples" in self.file else ()
        # (force [N], interval [s], window [s]) by obstacle: the force within windows.
        self.samples = {name: (group["fx"][()], float(group.attrs["interval"]), float(group.attrs["window"]))
                        for name, group in samples}
        self._depths = {}
        self.events = list(zip(self.file["events/time"][()], self.file["events/text"].asstr()[()]))

    @cached_property
    def packings(self):
        """All runs of the scene with a packing each (grains.replicates), this one first; empty where it is the only one."""
        folders = self.summary.get("replicates", {}).get("runs", [])
        return [self] + [Run(self.path / folder) for folder in folders if folder != "."] if len(folders) > 1 else []

    @property
    def name(self):
        return self.path.resolve().name

    @property
    def mode(self):
        return self.attributes["mode"]

    @property
    def title(self):
        return self.attributes["title"] or self.name

    @property
    def status(self):
        return self.summary.get("status", "unfinished")

    @property
    def diameter(self):
        """[m] of the grains; 0 where there are none."""
        return float(self.attributes["grain_diameter"])

    @property
    def has_flow(self):
        return "x" in self.file["grid"]

    @cached_property
    def has_grains(self):
        return any("grains" in frame.group and frame.group["grains/id"].size for frame in self.frames)

    @cached_property
    def grid(self):
        """x, y [m] of the cells' centres and the bed [m], [y, x]."""
        return tuple(self.file["grid"][name][()] for name in ("x", "y", "bed"))

    @staticmethod
    def _summary(file):
        """What stands in it; nothing where there is none yet."""
        try:
            summary = json.loads(file.read_text()) if file.exists() else {}
        except ValueError as error:
            raise NoRun(f"{file} cannot be read: {error}; move it away to see the records alone")
        if not isinstance(summary, dict):
            raise NoRun(f"{file} is no summary; move it away to see the records alone")
        return summary

    def figure(self, path):
        """A number of summary.json by its dotted path (obstacles' names may hold dots: use a tuple), or None."""
        value = self.summary
        for key in path.split(".") if isinstance(path, str) else path:
            if not isinstance(value, dict) or key not in value:
                return None
            value = value[key]
        return value

    def peak(self, name):
        """Time [s] and value [N] of the largest 15 ms mean of an obstacle's force, anywhere in the run (summary.json)."""
        return (self.figure(("obstacles", name, key)) or 0.0 for key in ("force_peak_time", "force_peak"))

    def surface_coordinates(self, points):
        """Level-frame points [N, 3] -> arc length s and height n [m]: the foot point by Newton's method on the centre line."""
        surface = self.file["surface"]
        x, angle, line = surface["x"][()], surface["angle"][()], surface["line"][()]
        s = np.interp(points[:, 0], line[:, 0], x)
        for _ in range(5):
            zeta = np.interp(s, x, angle)
            dx = points[:, 0] - np.interp(s, x, line[:, 0])
            dz = points[:, 2] - np.interp(s, x, line[:, 2])
            along = dx * np.cos(zeta) - dz * np.sin(zeta)
            s = s + along  # np.interp holds the end points: beyond them `along` would run away
            s = np.clip(s, x[0], x[-1])
        return s, dx * np.sin(zeta) + dz * np.cos(zeta)

    @cached_property
    def grain_mass_per_volume(self):
        """[kg/m3] from the ledger and the frame with most grains: the grains' own density."""
        best = 0.0, 0.0
        for frame in self.frames:
            if "grains" not in frame.group or not len(self.time):
                continue
            volume = 4 / 3 * np.pi * np.sum(frame.group["grains/radius"][()] ** 3)
            if volume > best[0]:
                best = volume, self.windows["mass_grains"][np.argmin(np.abs(self.time - frame.time))]
        return best[1] / best[0] if best[0] > 0 and best[1] > 0 else 0.0

    def depth(self, frame):
        """(x, y, h) of a frame [m]: the flow's own cells, or the grains coarse-grained onto cells of two diameters."""
        if self.has_flow:
            x, y, _ = self.grid
            return x, y, frame.flow("h")
        x, y = self._coarse_cells
        if frame.time not in self._depths:
            grains = frame.grains()
            cell = x[1] - x[0]
            density = self.grain_mass_per_volume / self.attributes["bulk_density"] if self.grain_mass_per_volume else 1 / 0.58
            volume = np.zeros((len(y), len(x))) if grains is None else spread(grains, x, y, cell)
            self._depths[frame.time] = volume * density / cell**2
        return x, y, self._depths[frame.time]

    def finest_depth(self, frame, box, most=1800):
        """(x, y, h) of a frame in the box (x from, to, y from, to): on the finest cells that are there, or as fine as gives at
        most `most` of them in a row. A coarser cell fills all that it covers, a finer one counts by its mean."""
        x, y, h = self.depth(frame)
        if not self.has_flow or not len(frame.places):
            return x, y, h
        dx = x[1] - x[0]
        dy = y[1] - y[0] if len(y) > 1 else dx
        i0, i1 = np.searchsorted(x + dx / 2, box[0]), min(np.searchsorted(x - dx / 2, box[1]), len(x))
        j0, j1 = np.searchsorted(y + dy / 2, box[2]), min(np.searchsorted(y - dy / 2, box[3]), len(y))
        finest = int(frame.places[:, 0].max())
        while finest > 0 and max(i1 - i0, j1 - j0) << finest > most:
            finest -= 1
        parts = 1 << finest
        fine = np.kron(h[j0:j1, i0:i1], np.ones((parts, parts)))
        for level, bi, bj, values in frame.blocks():
            if level <= finest:
                more = 1 << (finest - level)
                values = np.kron(values, np.ones((more, more)))
            else:
                more = 1 << (level - finest)
                values = values.reshape(values.shape[0] // more, more, -1, more).mean(axis=(1, 3))
            left = int(np.ldexp(bi, finest - level)) - i0 * parts
            low = int(np.ldexp(bj, finest - level)) - j0 * parts
            a, b = max(left, 0), min(left + values.shape[1], fine.shape[1])
            c, d = max(low, 0), min(low + values.shape[0], fine.shape[0])
            if a < b and c < d:
                fine[c:d, a:b] = values[c - low:d - low, a - left:b - left]
        fx, fy = dx / parts, dy / parts
        return (x[i0] - dx / 2 + fx * (np.arange(fine.shape[1]) + 0.5), y[j0] - dy / 2 + fy * (np.arange(fine.shape[0]) + 0.5), fine)

    @cached_property
    def _coarse_cells(self):
        cell = 2 * (self.diameter or 0.005)
        length, width = self.file["surface/x"][-1], self.attributes["width"]
        return np.arange(cell / 2, length, cell), np.arange(-width / 2 + cell / 2, width / 2, cell)


def spread(grains, x, y, cell):
    """Volume of the grains by cell [m3]: each grain's volume is shared among the cells that its own width reaches into."""
    volume = np.zeros((len(y) + 2, len(x) + 2))  # a margin of one cell, cut off below
    radius = grains["radius"]

    def shares(position, first):
        low = np.floor((position - radius - first) / cell).astype(int)
        upper = np.clip((position + radius - first - (low + 1) * cell) / (2 * radius), 0, 1)
        return (low, 1 - upper), (low + 1, upper)

    for i, part_x in shares(grains["s"], x[0] - cell / 2):
        for j, part_y in shares(grains["y"], y[0] - cell / 2):
            np.add.at(volume, (np.clip(j + 1, 0, len(y) + 1), np.clip(i + 1, 0, len(x) + 1)),
                      4 / 3 * np.pi * radius**3 * part_x * part_y)
    return volume[1:-1, 1:-1]


def running_mean(time, length, force, span=0.015):
    """Mean over the last `span` seconds at each window's end, exact for a force that is constant in each window; a contact
    shorter than that is averaged over its own length, as in the summary."""
    contact = np.flatnonzero(force)
    if len(contact):
        first = contact[0]
        span = min(span, time[-1] - (time[first] - length[first]))
    edges = np.concatenate([[time[0] - length[0]], time])
    impulse = np.concatenate([[0.0], np.cumsum(force * length)])
    return (impulse[1:] - np.interp(time - span, edges, impulse)) / span


def pick(frames, count, first=None, last=None):
    """At most `count` of the frames, evenly spread over the time from `first` to `last` [s], or all of it, both ends included."""
    times = np.array([f.time for f in frames])
    wanted = np.linspace(times[0] if first is None else first, times[-1] if last is None else last, count)
    return [frames[k] for k in sorted({int(np.argmin(np.abs(times - t))) for t in wanted})]
