"""W1 and W2: the block of course.h, by us and by programs of others (../block), beside its answer in closed form.

An error is the largest of any cell at the end of a piece of constant heat, as a share of the largest rise.
"""
import json
import math
import pathlib
import shutil
import statistics
import sys
import tempfile

import numpy as np

from measurement import BUILD, Answer, bandwidth, in_turn, ratios, timed

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "block"))
import exact
import peers

TINY, SMALL, MEDIUM, LARGE = (10, 6, 4), (20, 10, 8), (40, 20, 12), (160, 80, 48)
OURS, OURS_LARGE, GMRES = "7e-5", "1.3e-4", "1e-5"  # relative tolerances; no larger error than SciPy's BDF at 1e-4, than GMRES
AGREED = 1e-4
AWAY, AGREED_AWAY = 6, 1e-2  # CalculiX has its temperatures at corners: compared so many cells from the heat
MOVED_PER_STEP = 264  # bytes per cell: history of order 4 read and written, right-hand side, one solve in single precision


def program(name, n, tolerance):
    """What it printed, and the rise of all cells at the ends of the pieces."""
    with tempfile.NamedTemporaryFile() as file:
        printed = timed([str(BUILD / name), *map(str, n), tolerance, file.name]).printed
        return json.loads(printed), np.fromfile(file.name).reshape(len(exact.UNTIL), -1)


def by_program(name, n, tolerance):
    def run():
        fact, rise = program(name, n, tolerance)
        return fact["seconds"], rise, fact

    return run


def away_from_heat(n):
    """Cells that are at least AWAY cells from every heated one, in some direction."""
    place = np.array(np.unravel_index(range(np.prod(n)), n[::-1]))
    heated = place[:, exact.heated_cells(n)]
    return np.abs(place[:, :, None] - heated[:, None, :]).max(axis=0).min(axis=1) >= AWAY


class Block:
    """One size of the block: contenders in turn, ours first; their times, errors and agreement."""

    def __init__(self, answer, n, contenders):
        self.answer, self.cells, self.truth = answer, int(np.prod(n)), exact.rises(n, exact.UNTIL)
        self.away, self.rows = away_from_heat(n), []
        self.answers = in_turn(*((f"{self.cells:,} cells, {name}", run, runs) for name, run, runs in contenders))
        self.names = [name for name, _, _ in contenders]
        for name in self.names:
            self.add(name)

    def of(self, name):
        return self.answers[f"{self.cells:,} cells, {name}"]

    def times(self, name):
        return [a[0] for a in self.of(name)]

    def seconds(self, name="thermotwin"):
        return statistics.median(self.times(name))

    def ratio(self, name):
        ours, theirs = self.times("thermotwin"), self.times(name)
        return ratios(theirs, ours)[0] if len(ours) == len(theirs) else statistics.median(theirs) / self.seconds()

    def error(self, name, cells=slice(None)):
        return np.abs(self.of(name)[-1][1] - self.truth)[:, cells].max() / self.truth.max()

    def add(self, name):
        what = f"{self.cells:,} cells, {name}"
        if name.startswith("CalculiX"):
            self.answer.agree(f"{what}, {AWAY} cells or more from the heat", self.error(name, self.away), AGREED_AWAY,
                              "of the largest rise")
        else:
            self.answer.agree(what, self.error(name), AGREED, "of the largest rise")
        ratio = "" if name == "thermotwin" else f"{self.ratio(name):.0f}"
        self.rows.append([f"{self.cells:,}", name, f"{self.seconds(name):.3g} s", len(self.of(name)),
                          f"{self.error(name):.1e}", ratio])

    def share_of(self, bytes_per_second):
        """Of our time, what moving the least that a step must move would take."""
        return MOVED_PER_STEP * self.cells * self.of("thermotwin")[-1][2]["steps"] / bytes_per_second / self.seconds()


def table(answer, *blocks):
    answer.table("The block", ["cells", "by", "time", "runs", "error", "times ours"], [r for b in blocks for r in b.rows])


def ours(n, runs):
    return "thermotwin", by_program("thermotwin_block", n, OURS_LARGE if n == LARGE else OURS), runs


def gmres(n, runs):
    return "CVODES, GMRES without preconditioner", by_program("peer_cvodes", n, GMRES), runs


def scipy(n, tolerance, runs):
    return f"SciPy BDF, sparse, {tolerance:.0e}", lambda: peers.scipy_bdf(n, tolerance), runs


def slow_peers(runs):
    return [scipy(MEDIUM, 1e-4, runs), scipy(MEDIUM, 1e-6, 1),
            ("CalculiX, 240 fixed steps", lambda: peers.calculix(MEDIUM), 1)]


def w1(runs, long):
    answer = Answer("block, 9,600 cells, two cores")
    small = Block(answer, SMALL, [ours(SMALL, runs), scipy(SMALL, 1e-6, runs), gmres(SMALL, runs)])
    blocks = [small]
    if shutil.which("ngspice"):
        blocks.insert(0, Block(answer, TINY, [ours(TINY, runs), ("ngspice, RC network", lambda: peers.ngspice(TINY), runs)]))
    medium = Block(answer, MEDIUM, [ours(MEDIUM, runs), gmres(MEDIUM, runs)] + (slow_peers(runs) if long else []))
    table(answer, *blocks, medium)
    bars_of_w1(answer, medium, runs)
    memory, _ = bandwidth()
    answer.limit = f"{100 * medium.share_of(memory):.0f} %, were it in memory ({MOVED_PER_STEP} bytes a cell and step); but " \
        "most of it stays in the cache of the one core that is used: waking another costs more than its share of such short loops"
    return answer


def bars_of_w1(answer, medium, runs):
    for name, least, times in (("SciPy BDF, sparse, 1e-04", 200, runs), ("CalculiX, 240 fixed steps", 1000, 1)):
        bar = f"≥ {least:,} × {name}, at no larger error"
        if name not in medium.names:
            answer.bar(bar, "", None, 0)
            continue
        ratio, error, theirs = medium.ratio(name), medium.error("thermotwin"), medium.error(name)
        answer.bar(bar, f"{ratio:,.0f} ×; error {error:.2g}, theirs {theirs:.2g}", bool(ratio >= least and error <= theirs),
                   times)


def w2(runs, long):
    answer = Answer("block, 614,400 cells, two cores")
    medium = Block(answer, MEDIUM, [ours(MEDIUM, runs)])
    large = Block(answer, LARGE, [ours(LARGE, runs)] + ([gmres(LARGE, 1)] if long else []))
    table(answer, medium, large)
    seconds, fact = large.seconds(), large.of("thermotwin")[-1][2]
    answer.bar("≤ 12 s", f"{seconds:.1f} s", seconds <= 12, runs)
    if long:
        ratio = large.ratio("CVODES, GMRES without preconditioner")
        answer.bar("≥ 30 × bare GMRES", f"{ratio:.0f} ×", bool(ratio >= 30), 1)
    else:
        answer.bar("≥ 30 × bare GMRES", "", None, 0)
    power = math.log(seconds / medium.seconds()) / math.log(large.cells / medium.cells)
    answer.bar("cost grows with cells to a power ≤ 1.05 from 9,600", f"{power:.3f}", power <= 1.05, runs)
    memory = fact["peak_bytes"] / large.cells
    answer.bar("peak memory ≤ 1 KiB per cell", f"{memory:,.0f} bytes", memory <= 1024, runs)
    answer.limit = f"{100 * large.share_of(bandwidth()[0]):.0f} % of memory: {MOVED_PER_STEP} bytes a cell in each of " \
        f"{fact['steps']} steps"
    return answer
