"""One look for all pictures: type, colours that colour-blind readers can tell apart, saving."""

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt

# Okabe and Ito (2008), darkest first.
BLUE, ORANGE, GREEN, RED, SKY, PURPLE, GREY, INK = (
    "#0072B2", "#E69F00", "#009E73", "#D55E00", "#56B4E9", "#CC79A7", "#7A7F85", "#22272B")
SERIES = (BLUE, RED, GREEN, ORANGE, PURPLE, SKY)
DASHES = ("-", (0, (5, 1.5)), (0, (1.5, 1.2)), (0, (6, 1.5, 1.5, 1.5)), "--", ":")  # readable in black and white too

plt.rcParams.update({
    "font.family": "DejaVu Sans", "font.size": 10, "text.color": INK,
    "axes.titlesize": 10.5, "axes.titleweight": "bold", "axes.titlelocation": "left",
    "axes.labelcolor": INK, "axes.edgecolor": "#9AA0A6", "axes.linewidth": 0.8,
    "axes.spines.top": False, "axes.spines.right": False, "axes.axisbelow": True,
    "axes.grid": True, "grid.color": "#E4E7EA", "grid.linewidth": 0.7,
    "xtick.color": "#4A5056", "ytick.color": "#4A5056", "xtick.labelsize": 9, "ytick.labelsize": 9,
    "legend.frameon": False, "legend.fontsize": 9, "lines.solid_capstyle": "round",
    "figure.dpi": 120, "savefig.dpi": 120,
})

# Pale where thin, dark where deep; its darkness falls steadily, so it also reads in grey.
DEPTH = matplotlib.colors.LinearSegmentedColormap.from_list("depth", matplotlib.colormaps["YlGnBu"](np.linspace(0.1, 1, 256)))
DEPTH.set_bad("#FFFFFF")
SPEED = matplotlib.colormaps["viridis"]


def line(k):
    """How the k-th of several lines looks: the same in all pictures, and each another way for 36 of them."""
    return {"color": SERIES[k % len(SERIES)], "linestyle": DASHES[(k + k // len(SERIES)) % len(DASHES)]}


def log_ticks(axis, least, most):
    """On a logarithmic axis of less than two decades 2 and 5 have labels, too."""
    if most < 100 * least:
        axis.set_major_locator(matplotlib.ticker.LogLocator(subs=(1, 2, 5)))


WIDTH = 9.2  # [in] of every picture
NARROW = 5.2  # [in] of what a phone shows in its width: letters stay legible


def narrow(draw, *arguments):
    """draw(..., path) once more for a phone, beside the picture at `path`; its path, or None."""
    global WIDTH
    wide, WIDTH = WIDTH, NARROW
    try:
        path = arguments[-1]
        return draw(*arguments[:-1], path.with_stem(path.stem + "_narrow"))
    finally:
        WIDTH = wide


def short(value):
    """Three digits, or all before the point."""
    return f"{value:.3g}" if abs(value) < 1000 else f"{value:.0f}"


def map_grid(rows, columns, ratio, width=WIDTH, title_lines=1):
    """A figure of rows x columns maps of `ratio` = height / width with room for labels and one colour bar, and no gaps."""
    panel = (width - 1.75 - 0.15 * (columns - 1)) / columns
    height = rows * (panel * ratio + 0.34) + 0.45 + 0.17 * (title_lines - 1)
    figure, axes = plt.subplots(rows, columns, figsize=(width, height), sharex=True, sharey=True, squeeze=False,
                                layout="constrained")
    for a in axes[-1, :]:
        a.set_xlabel("x, down the slope [mm]")
    return figure, axes


def colour_bar(figure, axes, image, label):
    figure.colorbar(image, ax=axes, label=label, extend="max", shrink=0.9, pad=0.015, aspect=max(12, 7 * figure.get_figheight()))


def save(figure, path):
    figure.savefig(path, bbox_inches="tight", pad_inches=0.08, facecolor="white")
    plt.close(figure)
    return path


def plain_map(axes):
    """For pictures in space: no grid, all four sides, true proportions."""
    axes.grid(False)
    axes.set_aspect("equal")
    for side in axes.spines.values():
        side.set_visible(True)
