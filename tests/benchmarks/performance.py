#!/usr/bin/python3
"""How fast, beside programs of others on the same machine: the table of docs/performance.md (script/bench).

Times are medians over --runs runs (5), of those that take minutes over one. Without --long the latter are left out:
SciPy at 9,600 cells, CalculiX, and CVODES without a preconditioner at 614,400 cells.
"""
import argparse
import json
import math
import pathlib
import re
import shutil
import statistics
import subprocess
import sys
import tempfile

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(pathlib.Path(__file__).parent / "block"))
import exact
import peers

SMALL, LARGE, TOLERANCE = (40, 20, 12), (160, 80, 48), "1e-4"
MOVED_PER_STEP = 264  # bytes per cell: history of order 4 read and written, right-hand side, one solve in single precision


def program(name, n, tolerance=TOLERANCE):
    """What it printed, and the rise of all cells at the ends of the pieces."""
    with tempfile.NamedTemporaryFile() as file:
        command = [str(ROOT / "build" / name), *map(str, n), tolerance, file.name]
        printed = subprocess.run(command, check=True, capture_output=True, text=True).stdout
        return json.loads(printed), np.fromfile(file.name).reshape(len(exact.UNTIL), -1)


def median_of(runs, function):
    answers = [function() for _ in range(runs)]
    return statistics.median(a[0] for a in answers), answers[-1][1]


class Block:
    """One size of the block, its exact answer, and the rows of the table."""

    def __init__(self, n, runs):
        self.n, self.runs, self.truth = n, runs, exact.rises(n, exact.UNTIL)
        facts = []

        def ours():
            fact, rise = program("thermotwin_block", n)
            facts.append(fact)
            return fact["seconds"], rise

        self.seconds, rise = median_of(runs, ours)
        self.fact = facts[-1]
        self.row("thermotwin", self.seconds, rise, runs)

    def row(self, name, seconds, rise, runs):
        error = np.abs(rise - self.truth).max() / self.truth.max()
        ratio = "" if name == "thermotwin" else f"{seconds / self.seconds:.0f}"
        print(f"| {np.prod(self.n):,} cells | {name} | {seconds:.3f} s | {runs} | {error:.1e} | {ratio} |", flush=True)

    def peer(self, name, function, runs):
        seconds, rise = median_of(runs, function)
        self.row(name, seconds, rise, runs)


def cvodes(n):
    fact, rise = program("peer_cvodes", n, "1e-5")
    return fact["seconds"], rise


def bench(pattern, runs):
    """Medians [s] of thermotwin_bench by name."""
    command = [str(ROOT / "build/thermotwin_bench"), f"--benchmark_filter={pattern}", f"--benchmark_repetitions={runs}",
               "--benchmark_report_aggregates_only", "--benchmark_format=json"]
    results = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)["benchmarks"]
    return {r["run_name"]: r["real_time"] * {"ms": 1e-3, "us": 1e-6}[r["time_unit"]] for r in results
            if r["aggregate_name"] == "median"}


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--long", action="store_true", help="also the runs that take minutes")
    options.add_argument("--runs", type=int, default=5)
    asked = options.parse_args()
    runs = asked.runs

    print("| block | by | time (median) | runs | largest error / largest rise | times ours |\n|---|---|---|---|---|---|")
    if shutil.which("ngspice"):
        Block((10, 6, 4), runs).peer("ngspice, RC network", lambda: peers.ngspice((10, 6, 4)), runs)
    n = (20, 10, 8)
    medium = Block(n, runs)
    medium.peer("SciPy BDF, sparse, 1e-6", lambda: peers.scipy_bdf(n), runs)
    medium.peer("CVODES, GMRES without preconditioner", lambda: cvodes(n), runs)
    small = Block(SMALL, runs)
    small.peer("CVODES, GMRES without preconditioner", lambda: cvodes(SMALL), runs)
    if asked.long:
        small.peer("SciPy BDF, sparse, 1e-6", lambda: peers.scipy_bdf(SMALL), runs)
        small.peer("SciPy BDF, sparse, 1e-4", lambda: peers.scipy_bdf(SMALL, 1e-4), 1)
        small.peer("CalculiX, 240 fixed steps", lambda: peers.calculix(SMALL), 1)
    large = Block(LARGE, runs)
    if asked.long:
        large.peer("CVODES, GMRES without preconditioner", lambda: cvodes(LARGE), 1)
    cells = np.prod(LARGE)
    power = math.log(large.seconds / small.seconds) / math.log(cells / np.prod(SMALL))
    bandwidth = json.loads(subprocess.run([str(ROOT / "build/memory_bandwidth")], check=True, capture_output=True,
                                          text=True).stdout)["bytes_per_second"]
    least = MOVED_PER_STEP * cells * large.fact["steps"] / bandwidth
    print(f"\nFrom {np.prod(SMALL):,} to {cells:,} cells the time grows with their number to the power {power:.3f}.")
    print(f"Peak memory at {cells:,} cells: {large.fact['peak_bytes'] / cells:.0f} bytes per cell; "
          f"{large.fact['building']:.2f} s to build the network; {large.fact['steps']} steps, {large.fact['solver']}.")
    print(f"Memory bandwidth (a = b + s c, all threads): {bandwidth / 1e9:.1f} GB/s; what must move at "
          f"{MOVED_PER_STEP} bytes per cell and step takes {least:.2f} s: {100 * least / large.seconds:.0f} % of ours.")

    print("\n| machine, 8 h of spectrum | time (median) | with 40 sensitivities | times the run without |\n|---|---|---|---|")
    times = bench("^Spectrum", runs)
    for name in ("v450", "vmc850", "g200", "v450_fine"):
        plain, more = times[f"Spectrum/{name}"], times.get(f"SpectrumWithSensitivities/{name}")
        print(f"| `{name}` | {plain * 1e3:.2f} ms | " + (f"{more * 1e3:.1f} ms | {more / plain:.1f} |" if more else " | |"))
    print()
    subprocess.run([sys.executable, str(pathlib.Path(__file__).parent / "spectrum.py")], check=True)


if __name__ == "__main__":
    sys.exit(main())
