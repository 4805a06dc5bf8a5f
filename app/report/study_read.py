"""study.h5: the columns of a study's table, and its rows gathered into the lines of a picture."""

import json
import re

import h5py
import numpy as np


class NoStudy(Exception):
    """What was given is no table of a study."""


class Column:
    def __init__(self, data):
        text = lambda name: str(data.attrs[name])
        self.name = data.name.split("/")[-1]
        self.unit, self.role, self.label, self.about = text("unit"), text("role"), text("label"), text("description")
        self.is_text = h5py.check_string_dtype(data.dtype) is not None
        self.values = [v.decode() for v in data[()]] if self.is_text else data[()]

    def heading(self):
        return f"{self.label} [{self.unit}]" if self.unit not in ("", "1") else self.label

    def shown(self, k):
        """The value of a row as a person writes it."""
        return self.values[k] if self.is_text else "" if np.isnan(self.values[k]) else f"{self.values[k]:.6g}"


class Study:
    def __init__(self, path):
        try:
            with h5py.File(path) as file:
                if file.attrs.get("format") != "couloir study":
                    raise NoStudy(f"{path} is no table of a study; give the study.h5 that `couloir study` wrote")
                self.attributes = {name: file.attrs[name] for name in file.attrs}
                self.ladder = json.loads(file["ladder"][0]) if "ladder" in file else None
                self.columns = {name: Column(file["rows"][name]) for name in str(file.attrs["columns"]).split("\n")}
        except OSError as error:
            raise NoStudy(f"{path} cannot be read: {error}") from error
        self.rows = range(len(self.columns["table"].values))

    def role(self, role):
        return [c for c in self.columns.values() if c.role == role]

    def of(self, quantity, role):
        return self.columns.get(f"{quantity.name} {role}")

    def tables(self):
        """(name, numbers of its rows), in the file's order."""
        names = dict.fromkeys(self.columns["table"].values)
        return [(name, [k for k in self.rows if self.columns["table"].values[k] == name]) for name in names]


class Layout:
    """What stands along a table's x axis, and which rows make a line.

    One parameter that varies is the axis. Every combination of several: the one with the most values is, the others tell lines
    apart. Any other list of rows stands side by side, named by what it sets."""

    def __init__(self, study, rows):
        values = lambda c: list(dict.fromkeys(c.shown(k) for k in rows))
        varying = [c for c in study.role("parameter") if len(values(c)) > 1]
        settings = len({tuple(c.shown(k) for c in varying) for k in rows})
        product = settings == np.prod([len(values(c)) for c in varying], dtype=int)
        numeric = [c for c in varying if not c.is_text and not np.isnan(c.values[rows]).any()]
        self.axis = max(numeric, key=lambda c: len(values(c))) if numeric and product else None
        telling = [c for c in varying if c is not self.axis] if self.axis else []
        self.name = self.axis.heading() if self.axis else ", ".join(c.heading() for c in varying)
        self.labels = list(dict.fromkeys(" / ".join(c.shown(k) for c in varying) for k in rows))
        self.lines = {}
        several = {n: len(set(study.columns[n].values)) > 1 for n in ("variant", "mode")}
        for k in rows:
            words = [study.columns[n].values[k] for n in ("variant", "mode") if several[n]]
            words += [f"{c.label} {c.shown(k)}" for c in telling]
            self.lines.setdefault(", ".join(w for w in words if w), []).append(k)
        self.place = {k: float(self.axis.values[k]) if self.axis else self.labels.index(" / ".join(c.shown(k) for c in varying))
                      for k in rows}
        self.mark = {k: self.axis.shown(k) if self.axis else " / ".join(c.shown(k) for c in varying) for k in rows}

    def points(self, rows, value):
        """(place, value, first row) of each setting once, in the order of the axis."""
        first = {}
        for k in rows:
            if not np.isnan(value[k]):
                first.setdefault(self.place[k], k)
        return [(place, value[k], k) for place, k in sorted(first.items())]


def file_name(text):
    return re.sub(r"[^a-z0-9]+", "_", text.lower()).strip("_") or "table"
