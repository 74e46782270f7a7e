"""Compares cuts of a page of lines with union and polygonize of Shapely: python3 tests/page.py [PAGES [FIRST [LINES]]].
Needs cffi, NumPy and Shapely.

A page is a unit square with random straight lines. A line begins on an older line or on the border, or free. It ends
beyond some crossings, on another line or free. Kiri cuts the lines in random order; each end on a line is 0 to 0.95 snap
distances short of it, and coordinates are floats. Shapely gets the lines with their ends on each other. Both must give
the same number of pieces, and pieces of the same areas. A line is left out if the answer would depend on the snap: a free
end, a crossing or a join nearer than CLEAR snaps to something else, or a crossing angle below 15 degrees."""

import math
import pathlib
import random
import sys

import numpy
import shapely.geometry
import shapely.ops

repository = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(repository / "bindings/python"))
sys.dont_write_bytecode = True

import kiri  # noqa: E402

SNAP, CLEAR, SQUARES = 1e-4, 8, (16, 32, 64, 128)
BORDER = [(0, 0, 1, 0), (1, 0, 1, 1), (1, 1, 0, 1), (0, 1, 0, 0)]


class Page:
    """lines: rows (ax, ay, bx, by), the border first. joins: for each line, whether its two ends lie on another line."""

    def __init__(self, seed, count):
        self.random = random.Random(seed)
        self.lines = numpy.array(BORDER, float)
        self.joins = [(False, False)] * 4
        attempts = 0
        while len(self.lines) < count + 4 and attempts < 100 * count:
            attempts += 1
            self.add()

    def crossings(self, start, way):
        """Shares of each line, and lengths along the ray, where the ray from `start` crosses it."""
        a, d = self.lines[:, :2], self.lines[:, 2:] - self.lines[:, :2]
        cross = way[0] * d[:, 1] - way[1] * d[:, 0]
        with numpy.errstate(divide="ignore", invalid="ignore"):
            along = ((a[:, 0] - start[0]) * d[:, 1] - (a[:, 1] - start[1]) * d[:, 0]) / cross
            share = ((a[:, 0] - start[0]) * way[1] - (a[:, 1] - start[1]) * way[0]) / cross
        return along, share, numpy.abs(cross) / numpy.hypot(d[:, 0], d[:, 1])

    def distances(self, p):
        a, d = self.lines[:, :2], self.lines[:, 2:] - self.lines[:, :2]
        t = numpy.clip(((p - a) * d).sum(1) / (d * d).sum(1), 0, 1)
        return numpy.hypot(*(a + t[:, None] * d - p).T)

    def add(self):
        clear, random_, on = CLEAR * SNAP, self.random, None
        if random_.random() < 0.7:
            on = random_.randrange(len(self.lines))
            a, b = self.lines[on, :2], self.lines[on, 2:]
            start = a + random_.random() * (b - a)
        else:
            start = numpy.array([random_.random(), random_.random()])
        angle = random_.uniform(0, 2 * math.pi)
        way = numpy.array([math.cos(angle), math.sin(angle)])
        along, share, sine = self.crossings(start, way)
        ahead = [i for i in numpy.argsort(along) if i != on and along[i] > 0 and 0 <= share[i] <= 1]
        if not ahead:
            return
        joins = random_.random() < 0.7
        k = min(int(random_.expovariate(0.7)), len(ahead) - 1)
        if joins:
            end_on, length = ahead[k], along[ahead[k]]
        else:
            low = along[ahead[k - 1]] if k > 0 else 0.0
            end_on, length = None, low + random_.uniform(0.1, 0.9) * (along[ahead[k]] - low)
        end = start + length * way
        if length < 4 * clear or length > 0.5:
            return
        for place, its in ((start, on), (end, end_on)):
            near = self.distances(place) < clear
            if its is not None:
                near[its] = False
            if near.any():
                return
        # Ends of older lines that are near, and crossings that are oblique, near an end or near another crossing.
        for p in (self.lines[4:, :2], self.lines[4:, 2:], self.lines[:4, :2]):
            t = numpy.clip((p - start) @ way, 0, length)
            if (numpy.hypot(*(start + t[:, None] * way - p).T) < clear).any():
                return
        inside = (along > -clear) & (along < length + clear) & (share >= 0) & (share <= 1)
        if on is not None:
            inside[on] = True
        if (sine[inside] < math.sin(math.radians(15))).any():
            return
        places = numpy.sort(along[inside])
        if (numpy.diff(places) < clear).any():
            return
        self.lines = numpy.vstack([self.lines, numpy.concatenate([start, end])])
        self.joins.append((on is not None, joins))

    def polygons(self):
        """Areas of the pieces, ascending, and the length of all lines."""
        strings = []
        for (ax, ay, bx, by), (first, second) in zip(self.lines, self.joins):
            length = math.hypot(bx - ax, by - ay)
            u, v = (bx - ax) / length * 1e-9, (by - ay) / length * 1e-9
            strings.append(shapely.geometry.LineString([(ax - u * first, ay - v * first), (bx + u * second, by + v * second)]))
        faces = list(shapely.ops.polygonize(shapely.ops.unary_union(strings)))
        return sorted(face.area for face in faces if face.area > 1e-12)

    def strokes(self):
        """What is cut: ends that join are short, in random order, each line in a random direction."""
        strokes = []
        for (ax, ay, bx, by), joins in list(zip(self.lines, self.joins))[4:]:
            length = math.hypot(bx - ax, by - ay)
            u, v = (bx - ax) / length * SNAP, (by - ay) / length * SNAP
            s, t = (0.95 * self.random.choice((0.0, 0.5, 1.0, self.random.random())) * j for j in joins)
            ends = [(ax + s * u, ay + s * v), (bx - t * u, by - t * v)]
            strokes.append(ends if self.random.random() < 0.5 else ends[::-1])
        self.random.shuffle(strokes)
        return strokes


def cut(strokes, squares):
    """Areas of Kiri's pieces, ascending."""
    world = kiri.World()
    sheet = world.create_rectangle(1.0, 1.0, squares, squares, frameCount=1, maxFrames=1, gridResolution=8, snapDistance=SNAP)
    for start, end in strokes:
        stroke = sheet.begin_cut(start)
        stroke.extend([end])
        stroke.end()
    world.tick(1 / 60)
    areas = sorted(sheet.piece(i).area for i in range(sheet.counts().pieces))
    return areas


def main(pages=4, first=1, lines=2000):
    wrong = 0
    for seed in range(first, first + pages):
        page = Page(seed, lines)
        wanted, squares = page.polygons(), SQUARES[seed % 4]
        got = cut(page.strokes(), squares)
        off = max(abs(a - b) for a, b in zip(wanted, got)) if len(wanted) == len(got) else math.nan
        fine = off < 0.5 * SNAP  # a piece has a border of a few lengths of the page at most
        wrong += not fine
        print(f"page {seed}: {len(page.lines) - 4} lines, {squares} x {squares} squares: {len(got)} pieces, {len(wanted)} by "
              f"polygonize; areas differ by {off:.1e} at most, least {min(got):.1e} and {min(wanted):.1e}", flush=True)
    return wrong


if __name__ == "__main__":
    sys.exit(1 if main(*map(int, sys.argv[1:])) else 0)
