#!/usr/bin/python3
"""The report's moving parts on recorded runs: pages_test.py REPORT_FOLDER RUN RUN RUN

The first run is SyntheticRun's: its force sets in at 0.1 s and it ends at 0.4 s.
"""

import base64
import io
import re
import sys
from html.parser import HTMLParser
from pathlib import Path

import numpy as np

sys.path.insert(0, sys.argv[1])
import figures
import player
import report
import style
from PIL import Image
from read import Run


class Page(HTMLParser):
    """What the page would fetch, its player's frames, slider and words."""

    def __init__(self, text):
        super().__init__()
        self.addresses, self.frames, self.curve, self.slider, self.inside, self.words = [], [], None, None, [], ""
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        a = dict(attributes)
        self.addresses += [a[name] for name in ("src", "srcset", "href", "data", "poster") if name in a]
        if tag in ("link", "iframe", "object", "embed"):
            raise AssertionError(f"the page has a <{tag}>")
        if tag == "div":
            self.inside.append(a.get("class"))
        if tag == "input":
            self.slider = a
        if tag == "img" and "frames" in self.inside:
            self.frames.append(a)
        if tag == "img" and "curve" in self.inside:
            self.curve = a

    def handle_endtag(self, tag):
        if tag == "div":
            self.inside.pop()

    def handle_data(self, data):
        self.words += data


def image(element):
    return np.asarray(Image.open(io.BytesIO(base64.b64decode(element["src"].split(",")[1]))).convert("RGB")).astype(int)


def fetches_nothing(text):
    page = Page(text)
    for address in page.addresses:
        assert address.startswith("data:image/"), address[:80]
    bare = re.sub(r"base64,[A-Za-z0-9+/=]*", "", text)
    for word in ("http:", "https:", "url(", "@import", "fetch(", "XMLHttpRequest", "import("):
        assert word not in bare, word
    return page


def shows_its_frames(run, page, count):
    times = [frame.time for frame in run.frames]
    shown = [float(frame["data-time"]) for frame in page.frames]
    assert len(shown) == count and int(page.slider["max"]) == count - 1 and int(page.slider["min"]) == 0, (len(shown), page.slider)
    assert f"Shown: {count} of the {len(times)} frames recorded" in page.words, page.words[-400:]
    assert set(shown) <= set(times) and shown == sorted(set(shown)) and shown[-1] == times[-1], shown
    for frame, time in zip(page.frames, shown):
        assert frame["alt"].startswith(f"t = {time:.3f} s"), frame["alt"]
    pictures = [image(frame) for frame in page.frames]
    assert len({picture.shape for picture in pictures}) == 1
    assert len({picture.tobytes() for picture in pictures}) == count, "two frames look the same"


def marks_the_frames_time(page):
    """The curve leaves the line of zero at 0.1 s and ends at 0.4 s: there the marker must be at these times."""
    curve = image(page.curve)
    blue = np.abs(curve - [int(style.BLUE[k:k + 2], 16) for k in (1, 3, 5)]).sum(axis=2) < 60
    columns = np.flatnonzero(blue.any(axis=0))
    low = np.flatnonzero(blue[:, columns[0]])[-1]  # the row of zero
    rises = next(c for c in columns if np.flatnonzero(blue[:, c])[0] < low - 8)
    times, places = ([float(frame[name]) for frame in page.frames] for name in ("data-time", "data-at"))
    for time, column in ((0.1, rises), (0.4, columns[-1])):
        at = np.interp(time, times, places)
        assert abs(at - 100 * column / curve.shape[1]) < 1, (time, at, 100 * column / curve.shape[1])


def bounds_the_page(run):
    frames, size = player.MOST_FRAMES, player.MOST_BYTES
    player.MOST_FRAMES = 5
    shows_its_frames(run, Page(player.player([run], [run.mode])), 5)
    player.MOST_FRAMES, player.MOST_BYTES = frames, 1
    shows_its_frames(run, Page(player.player([run], [run.mode])), 2)
    player.MOST_BYTES = size


def holds_what_flies(run, out):
    """A grain thrown up is in the side view; of one thrown too high its title tells."""
    drawn, save = [], style.save
    style.save = lambda figure, path: (drawn.append(figure), save(figure, path))[1]
    whole = figures.in_section
    o = next(iter(run.obstacles.values()))

    def with_flyer(height):
        def section(run, frame, middle):
            grains = whole(run, frame, middle)
            if grains is None:
                return None
            flyer = {name: values[:1].copy() for name, values in grains.items()}
            flyer["s"][0], flyer["n"][0] = o["x"], height
            return {name: np.append(values, flyer[name]) for name, values in grains.items()}
        return section

    for height, told in ((2 * o["height"], False), (30 * o["height"], True)):
        figures.in_section = with_flyer(height)
        figures.side_views(run, out)
        panels = drawn[-1].axes[:4]
        assert (panels[0].get_ylim()[1] > height * 1e3) != told, panels[0].get_ylim()
        titles = [axes.get_title(loc="left") for axes in panels]
        assert any("; 1 higher, up to 18" in title for title in titles) == told, titles
    figures.in_section, style.save = whole, save


def main():
    runs = [Run(path) for path in sys.argv[2:]]
    out = runs[0].path / "pages"
    out.mkdir()
    text = report.report_one(runs[0], out)
    assert '<div class="player" hidden>' in text, "without scripts the player would show nothing"
    page = fetches_nothing(text)
    shows_its_frames(runs[0], page, len(runs[0].frames))
    marks_the_frames_time(page)
    assert all(re.search(r"· wall -?[0-9.]+ N", frame["alt"]) for frame in page.frames)
    bounds_the_page(runs[0])
    holds_what_flies(runs[0], out)
    page = fetches_nothing(report.report_several(runs, out))
    shows_its_frames(runs[0], page, len(runs[0].frames))
    for run in runs:
        assert all(f"· {run.mode} " in frame["alt"] for frame in page.frames), page.frames[0]["alt"]


main()
