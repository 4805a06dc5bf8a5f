"""Whether two run folders hold the same run: every dataset of records.h5, forces.csv, the XDMF files, the summary's figures."""
import hashlib
import json
import pathlib
import sys

import h5py
import numpy as np


def datasets(path):
    """name -> (dtype, shape, hash of the bytes)."""
    found = {}

    def look(name, thing):
        if not isinstance(thing, h5py.Dataset):
            return
        data = thing[()]
        raw = "\0".join(x.decode() for x in data.ravel()).encode() if thing.dtype.kind == "O" else np.asarray(data).tobytes()
        found[name] = (str(thing.dtype), thing.shape, hashlib.sha256(raw).hexdigest())

    with h5py.File(path, "r") as file:
        file.visititems(look)
    return found


def figures(path):
    """The summary without times, what follows from times, and where the run was broken."""
    summary = json.loads((path / "summary.json").read_text())
    for key in ("wall", "cpu", "cpu_continuum", "cpu_engine", "cpu_coupling", "share_continuum", "share_engine", "share_coupling"):
        del summary["time"][key]
    del summary["continuum"]["cell_updates_per_second"], summary["grains"]["particle_steps_per_second"]
    summary.pop("resumed"), summary.pop("costs")
    return summary


def differences(a, b):
    """Sentences; none: the same run."""
    a, b = pathlib.Path(a), pathlib.Path(b)
    out = []
    p, q = datasets(a / "records.h5"), datasets(b / "records.h5")
    if len(p) < 10:
        out.append(f"{a} has only {len(p)} datasets")
    out += [f"{name}: only in one" for name in sorted(p.keys() ^ q.keys())]
    out += [f"{name}: {p[name]} and {q[name]}" for name in sorted(p.keys() & q.keys()) if p[name] != q[name]]
    for name in ("forces.csv", "flow.xdmf", "grains.xdmf"):
        texts = [(f / name).read_bytes() if (f / name).exists() else None for f in (a, b)]
        if texts[0] != texts[1]:
            out.append(f"{name}: not the same")
    one, two = figures(a), figures(b)
    out += [f"summary {key}: {one.get(key)} and {two.get(key)}" for key in sorted(one.keys() | two.keys()) if one.get(key) != two.get(key)]
    return out


if __name__ == "__main__":
    found = differences(*sys.argv[1:3])
    print("\n".join(found) or "the same run")
    sys.exit(1 if found else 0)
