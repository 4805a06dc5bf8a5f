"""Spectra of the force on obstacles, and what the coupling adds at its windows' frequency."""

import numpy as np

import style
from style import plt

LEAST_SEGMENTS = 4


def segment(count, per_window):
    """Samples of a segment: as in coupling/records/coupling_noise.hpp, so that windows fall on bins; 0: too few."""
    for windows in (128, 64, 32, 16):
        length = windows * per_window
        if count >= length + (LEAST_SEGMENTS - 1) * (length // 2):
            return length
    return 0


def density(force, interval, length):
    """Welch: (f [Hz], S [N2/Hz]) without f = 0; half-overlapping segments, means taken off, Hann's weights."""
    weight = 0.5 - 0.5 * np.cos(2 * np.pi * np.arange(length) / length)
    parts = [force[k:k + length] for k in range(0, len(force) - length + 1, length // 2)]
    power = np.mean([np.abs(np.fft.rfft(weight * (part - part.mean()))) ** 2 for part in parts], axis=0)
    power *= 2 * interval / np.sum(weight**2)
    return np.fft.rfftfreq(length, interval)[1:], power[1:]


def spectrum(run, name):
    """(f, S) of the force on an obstacle since the first contact, or None where there is none to be had."""
    contact = run.figure(("obstacles", name, "first_contact"))
    if name not in run.samples or contact is None or run.figure(("coupling_noise", "obstacles", name, "segments")) is None:
        return None
    force, interval, window = run.samples[name]
    force = force[int(np.ceil(contact / interval - 1e-6)):]
    length = segment(len(force), round(window / interval))
    return density(force, interval, length) if length else None


def picture(runs, labels, path):
    """Log-log, a panel an obstacle; the frequency of each run's windows and its harmonics marked."""
    found = {}
    for k, (run, label) in enumerate(zip(runs, labels)):
        for name in run.samples:
            s = spectrum(run, name)
            if s is not None:
                found.setdefault(name, []).append((k, run, label, s))
    if not found:
        return None
    figure, all_axes = plt.subplots(len(found), 1, figsize=(style.WIDTH, 4.4 * len(found)), squeeze=False, layout="constrained")
    for axes, (name, entries) in zip(all_axes.flat, found.items()):
        marked = {}
        for k, run, label, (f, s) in entries:
            ratio = run.figure(("coupling_noise", "obstacles", name, "peak_over_neighbours"))
            axes.loglog(f, s, color=style.SERIES[k % len(style.SERIES)], linewidth=1.2,
                        label=f"{label}: peak over neighbours {ratio:.2f}")
            marked.setdefault(round(run.figure("coupling_noise.window_frequency"), 6), f[-1])
        for window, top in marked.items():
            for harmonic in range(1, int(top / window) + 1):
                axes.axvline(harmonic * window, color=style.GREY, linewidth=1.1 if harmonic == 1 else 0.6,
                             linestyle=style.DASHES[1], zorder=0)
            axes.annotate(f" windows, {window:.0f} Hz", (window, 0.98), xycoords=("data", "axes fraction"), rotation=90,
                          va="top", ha="right", color=style.GREY, fontsize=8)
        axes.set_title(f"Force on {name}, along the slope, since the first contact")
        axes.set_xlabel("frequency [Hz]")
        axes.set_ylabel("power spectral density [N²/Hz]")
        axes.legend(loc="lower left")
    return style.save(figure, path)


FIGURES = [("peak at the windows' frequency over its neighbours", "", "peak_over_neighbours"),
           ("the same between harmonics", "", "between_harmonics"), ("what stands out", "N", "rms"),
           ("segments", "", "segments"), ("resolution", "Hz", "resolution")]


def groups(runs):
    """For page.figures_table: coupling noise by obstacle."""
    names = list(dict.fromkeys(name for run in runs for name in run.samples))
    return [(f"Coupling noise on {name}",
             [("frequency of the windows", "Hz", [run.figure("coupling_noise.window_frequency") for run in runs])] +
             [(what, unit, [run.figure(("coupling_noise", "obstacles", name, key)) for run in runs]) for what, unit, key in FIGURES])
            for name in names]
