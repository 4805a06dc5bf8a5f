"""Pictures of what a run counts: mass ledger, momentum budget, grains."""

import numpy as np

import style
from style import plt

FLOOR = 1e-17  # what a logarithmic axis shows for an error of exactly 0


def log_panel(axes, time, values, label, title):
    """A ratio on a logarithmic axis, with round-off and one per cent marked for orientation."""
    axes.semilogy(time, np.maximum(np.abs(values), FLOOR), color=style.RED, linewidth=1.2)
    axes.axhline(2.2e-16, color=style.GREY, linewidth=0.9, linestyle="--")
    axes.text(time[-1], 2.2e-16, "round-off ", color=style.GREY, ha="right", va="bottom", fontsize=8.5,
              bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.85, "pad": 1})
    axes.set_ylim(FLOOR, max(1e-2, 3 * float(np.max(np.abs(values)))))
    axes.set_ylabel(label)
    axes.set_xlabel("time [s]")
    axes.set_title(title)


def ledger(run, path):
    if len(run.time) < 2:
        return None
    w, t = run.windows, run.time
    figure, axes = plt.subplots(2, 2, figsize=(style.WIDTH, 6.2), sharex=True, layout="constrained", height_ratios=[1.5, 1])
    parts = [("continuum", w["mass_continuum"], style.BLUE), ("grains", w["mass_grains"], style.ORANGE),
             ("on the faces", w["mass_faces"], style.PURPLE), ("airborne", w["mass_airborne"], style.GREEN),
             ("left the domain", w["mass_left_domain"], "#B8BDC2")]
    parts = [part for part in parts if np.any(np.abs(part[1]) > 0)]
    mass = axes[0, 0]
    mass.stackplot(t, [p[1] for p in parts], labels=[p[0] for p in parts], colors=[p[2] for p in parts], alpha=0.85, linewidth=0)
    total = w["mass_initial"] + w["mass_entered"]
    mass.plot(t, total, color=style.INK, linewidth=1.4, linestyle="--", label="released")
    mass.set_ylim(0, 1.32 * float(np.max(total)) or 1)
    mass.set_title("Mass")
    mass.set_ylabel("mass [kg]")
    mass.legend(loc="upper left", ncols=2)
    log_panel(axes[1, 0], t, w["mass_relative_error"], "error / released [-]", "Mass that is not accounted for")

    momentum = axes[0, 1]
    for k, (name, label) in enumerate([("gravity", "gravity"), ("bed", "bed"), ("obstacles", "obstacles"),
                                       ("boundary", "domain's sides"), ("faces", "zone's faces")]):
        values = w["momentum_" + name]
        if np.any(values != 0):
            momentum.plot(t, np.cumsum(values), color=style.SERIES[k], linestyle=style.DASHES[k], linewidth=1.7, label=label)
    momentum.plot(t, np.cumsum(w["momentum_storage"]), color=style.INK, linewidth=2.2, label="stored: their sum")
    momentum.axhline(0, color=style.GREY, linewidth=0.8)
    momentum.set_title("Momentum along the slope, since the start")
    momentum.set_ylabel("momentum [N s]")
    momentum.legend(loc="best")
    scale = np.where(w["momentum_scale"] > 0, w["momentum_scale"], np.inf)
    log_panel(axes[1, 1], t, w["momentum_residual"] / scale, "residual / largest [-]", "Momentum that is not accounted for")
    for a in axes.flat:
        a.set_xlim(t[0] - w["length"][0], t[-1])
    return style.save(figure, path)


def rate(time, count, span):
    """d count / dt over `span` [1/s]."""
    back = np.interp(time - span, time, count, left=count[0])
    return (count - back) / span


def counts(run, path):
    if len(run.time) < 2:
        return None
    w, t = run.windows, run.time
    with_grains = np.any(w["grains"] > 0)
    figure, axes = plt.subplots(2, 2, figsize=(style.WIDTH, 5.0), sharex=True, layout="constrained")
    top_left, top_right, low_left, low_right = axes.flat
    if with_grains:
        top_left.plot(t, w["grains"], color=style.BLUE, linewidth=2, label="in the engine")
        top_left.plot(t, w["inserted"], color=style.GREEN, linestyle=style.DASHES[1], linewidth=1.5, label="inserted so far")
        top_left.plot(t, w["returned"], color=style.RED, linestyle=style.DASHES[2], linewidth=1.8, label="returned so far")
        top_left.set_title("Grains")
        top_left.set_ylabel("number")
        top_left.legend(loc="best")
        span = max(0.01, (t[-1] - t[0]) / 40)
        top_right.plot(t, rate(t, w["inserted"], span), color=style.GREEN, linewidth=1.6, label="inserted")
        top_right.plot(t, rate(t, w["returned"], span), color=style.RED, linestyle=style.DASHES[1], linewidth=1.6,
                       label="returned")
        top_right.set_title(f"Grains a second (mean of {1e3 * span:.0f} ms)")
        top_right.set_ylabel("rate [1/s]")
        top_right.legend(loc="best")
        low_right.plot(t, 100 * w["max_overlap"], color=style.PURPLE, linewidth=1.2)
        low_right.set_title("Largest overlap of two grains")
        low_right.set_ylabel("of their mean diameter [%]")
    else:
        top_left.plot(t, w["solver_steps"], color=style.BLUE, linewidth=2)
        top_left.set_title("Steps of the continuum")
        top_left.set_ylabel("number")
        steps = np.diff(w["solver_steps"], prepend=0)
        top_right.plot(t, 1e3 * w["length"] / np.where(steps > 0, steps, np.inf), color=style.GREEN, linewidth=1.2)
        top_right.set_title("Time step")
        top_right.set_ylabel("time step [ms]")
        low_right.plot(t, w["overtopped"], color=style.PURPLE, linewidth=1.6)
        low_right.set_title("Mass over the obstacles")
        low_right.set_ylabel("mass [kg]")
    low_left.plot(t, w["max_speed"], color=style.BLUE, linewidth=1.4)
    low_left.set_title("Largest speed")
    low_left.set_ylabel("speed [m/s]")
    for a in (low_left, low_right):
        a.set_xlabel("time [s]")
    for a in axes.flat:
        a.set_xlim(t[0] - w["length"][0], t[-1])
        a.set_ylim(bottom=0)
    return style.save(figure, path)
