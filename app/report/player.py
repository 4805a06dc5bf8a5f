"""The frames one after the other: pictures from above that a slider turns, over the force with a marker at the frame's time.

The pictures are drawn here and lie in the page; without scripts, and in print, the page has its still pictures instead.
"""

import io
from html import escape

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.collections import EllipseCollection
from matplotlib.colors import Normalize
from PIL import Image

import style
from figures import MM, common_box, common_instants, deepest, draw_depth
from page import data, number
from read import running_mean
from style import plt

MOST_FRAMES = 41  # both ends of forty equal parts
MOST_BYTES = 3_000_000  # of the pictures; a third more in the page
MOST_NUMBERS = 4  # forces told beside the slider

SCRIPT = """
for (const player of document.querySelectorAll(".player")) {
  const [button, slider, told, marker] = ["button", "input", "output", ".marker"].map(what => player.querySelector(what));
  const frames = [...player.querySelectorAll(".frames img")];
  let timer = 0;
  function show() {
    const frame = frames[slider.value];
    for (const other of frames) other.hidden = other !== frame;
    told.textContent = frame.alt;
    if (marker) marker.style.left = frame.dataset.at + "%";
  }
  function stop() {
    timer = clearInterval(timer);
    button.textContent = "Play";
  }
  button.onclick = () => {
    if (timer) return stop();
    if (slider.value == slider.max) slider.value = 0;
    show();
    button.textContent = "Pause";
    timer = setInterval(() => {
      slider.stepUp();
      show();
      if (slider.value == slider.max) stop();
    }, Math.min(400, 8000 / frames.length));
  };
  slider.oninput = () => { stop(); show(); };
  player.hidden = false;
  show();
}
"""


def draw_grains(axes, frame, top):
    """Grains from above, the upper ones over the lower ones, each in the colour that a flow as high as its upper side has."""
    grains = frame.grains()
    if grains is None:
        return
    height = grains["n"] + grains["radius"]
    order = np.argsort(height)
    size = 2 * grains["radius"][order] * MM
    axes.add_collection(EllipseCollection(
        size, size, np.zeros(len(order)), units="x", transOffset=axes.transData, zorder=3, linewidths=0.15, edgecolors="#20303A80",
        offsets=np.column_stack([grains["s"], grains["y"]])[order] * MM, facecolors=style.DEPTH(height[order] / top)))


def frame_pictures(runs, labels, rows):
    """A WebP picture of each row of frames, all of one size and scale: a map for each run."""
    box, top = common_box(runs, rows), max(deepest(run) for run in runs)
    ratio = max(box[3] - box[2], 0.08 * (box[1] - box[0])) / (box[1] - box[0])
    columns = 1 if ratio < 0.7 else min(len(runs), 3)
    lines = -(-len(runs) // columns)
    panel = min((style.NARROW - 0.7) / columns * ratio, 5)
    figure, axes = plt.subplots(lines, columns, figsize=(style.NARROW, lines * (panel + (0.3 if len(runs) > 1 else 0.1)) + 0.95), sharex=True, sharey=True,
                                squeeze=False, dpi=150, layout="constrained")
    for spare in axes.flat[len(runs):]:
        spare.set_visible(False)
    figure.colorbar(ScalarMappable(Normalize(0, top * MM), style.DEPTH), ax=axes, location="bottom", extend="max", aspect=40,
                    label="depth along the normal [mm]")
    for a in axes.flat:
        style.plain_map(a)
        a.set_xlim(box[0] * MM, box[1] * MM)
        a.set_ylim(box[2] * MM, box[3] * MM)
        a.set_title(" " if len(runs) > 1 else "")  # keeps its place
    for a in axes[:, 0]:
        a.set_ylabel("y [mm]")
    for a in axes[-1]:
        a.set_xlabel("x, down the slope [mm]")
    figure.canvas.draw()
    empty, pictures = figure.canvas.copy_from_bbox(figure.bbox), []  # scales and labels once: they take longest
    for row in rows:
        figure.canvas.restore_region(empty)
        for a, run, label, frame in zip(axes.flat, runs, labels, row):
            before = set(a.get_children())
            draw_depth(a, run, frame, top, box)
            draw_grains(a, frame, top)
            if len(runs) > 1:
                a.draw_artist(a.set_title(f"{label}, t = {frame.time:.3f} s"))
            for artist in sorted(set(a.get_children()) - before, key=lambda artist: artist.get_zorder()):
                a.draw_artist(artist)
                artist.remove()
            for side in a.spines.values():
                a.draw_artist(side)
        file = io.BytesIO()
        Image.fromarray(np.asarray(figure.canvas.buffer_rgba())[..., :3]).save(file, format="webp", quality=80, method=2)
        pictures.append(file.getvalue())
    plt.close(figure)
    return pictures


class Curves:
    """The 15 ms means of the force on all obstacles in all runs, in one picture."""

    def __init__(self, runs, labels):
        names = list(dict.fromkeys(name for run in runs for name in run.forces))
        several, self.means = len(names) > 1, {}
        for run, label in zip(runs, labels):
            for name, f in run.forces.items() if len(run.time) else ():
                key = f"{name}, {label}" if several and len(runs) > 1 else label if len(runs) > 1 else name
                self.means[key] = f["time"], running_mean(f["time"], run.windows["length"], f["fx"])
        self.title = "Force along the slope, mean of 15 ms" if several else f"Force on {next(iter(names), '')}, mean of 15 ms"

    def draw(self):
        """The picture; where in it a time [s] is, in % of its width; top and height of its axes, in % of its height."""
        figure, axes = plt.subplots(figsize=(style.NARROW, 1.9), layout="constrained")
        for k, (name, (time, mean)) in enumerate(self.means.items()):
            axes.plot(time, mean, color=style.SERIES[k % len(style.SERIES)], linestyle=style.DASHES[k % len(style.DASHES)],
                      linewidth=1.6, label=name)
        axes.axhline(0, color=style.GREY, linewidth=0.8)
        axes.set_xlim(0, max(time[-1] for time, _ in self.means.values()))
        axes.set_title(self.title)
        axes.set_xlabel("time [s]")
        axes.set_ylabel("force [N]")
        if len(self.means) > 1:
            axes.legend(loc="best", ncols=1 + len(self.means) // 4)
        file = io.BytesIO()
        figure.savefig(file, format="webp", dpi=150, facecolor="white", pil_kwargs={"lossless": True})
        at = lambda time: 100 * figure.transFigure.inverted().transform(axes.transData.transform((time, 0)))[0]
        start, rate, box = at(0), at(1) - at(0), axes.get_position()
        plt.close(figure)
        return file.getvalue(), lambda time: start + time * rate, (100 * (1 - box.y1), 100 * box.height)

    def told(self, time):
        if len(self.means) > MOST_NUMBERS:
            return ""
        return "".join(f" · {name} {style.short(np.interp(time, times, mean))} N" for name, (times, mean) in self.means.items())


def fitting(rows, pictures):
    """Every second of them, the last one included, until they are small enough for a page."""
    while sum(map(len, pictures)) > MOST_BYTES and len(pictures) > 2:
        rows, pictures = rows[::-2][::-1], pictures[::-2][::-1]
    return rows, pictures


def player(runs, labels):
    """HTML; nothing where there are not two frames that all runs have."""
    shown = [(run, label) for run, label in zip(runs, labels) if run.frames and (run.has_flow or run.has_grains)]
    if not shown:
        return ""
    runs, labels = zip(*shown)
    rows = common_instants(runs, MOST_FRAMES)
    if len(rows) < 2:
        return ""
    rows, pictures = fitting(rows, frame_pictures(runs, labels, rows))
    curves, curve, at = Curves(runs, labels), "", lambda time: 0.0
    if curves.means:
        picture, at, (top, height) = curves.draw()
        curve = (f'<div class="curve"><img alt="{escape(curves.title)}" src="{data(picture, "webp")}">'
                 f'<i class="marker" style="top:{top:.2f}%;height:{height:.2f}%"></i></div>')
    fewest = min(runs, key=lambda run: len(run.frames))
    times = [row[runs.index(fewest)].time for row in rows]
    images = "".join(f'<img hidden alt="{escape(f"t = {time:.3f} s{curves.told(time)}")}" data-time="{time!r}" '
                     f'data-at="{at(time):.3f}" src="{data(picture, "webp")}">' for time, picture in zip(times, pictures))
    which = (f"{len(rows)} of the {len(fewest.frames)} frames recorded, from {number(times[0])} s to {number(times[-1])} s, "
             f"about every {number((times[-1] - times[0]) / (len(rows) - 1), 3)} s")
    text = "Depth of the flow with its outline" + ("; hatched: obstacles" if any(run.obstacles for run in runs) else "")
    if any(len(frame.zones) for row in rows for frame in row):
        text += "; dashed: the zone of the grains"
    if any(run.has_grains for run in runs):
        text += "; circles: grains, in the colour of a flow as high as their upper sides"
    return (f'<div class="player" hidden><h2>Frame by frame</h2><figure>{curve}<div class="controls"><button type="button">Play</button>'
            f'<input type="range" min="0" max="{len(rows) - 1}" value="0" aria-label="frame"><output></output></div>'
            f'<div class="frames">{images}</div><figcaption>{escape(text)}. Shown: {which}.</figcaption></figure></div>\n'
            f"<script>{SCRIPT}</script>\n")
