#!/usr/bin/python3
"""Weak scaling of campaigns to a thousand ranks (script/weak_scaling): measures what a process with one thread costs on
this machine, simulates ranks that share one folder (rank_simulation.py), names what stands in the way first, and writes
the tables into docs/campaign.md. A thousand runs a rank, in one part; each rank has a core of its own.

The file system is this machine's disk as measured, as if all ranks shared it; and one for many machines, which is
assumed: --name, --bandwidth, --durable.
"""
import argparse
import datetime
import fcntl
import itertools
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time

import numpy as np

from measurement import ROOT, THERMOTWIN, campaign, machine
from performance_page import put_between_markers, table
from rank_simulation import CAUSES, Costs, FileSystem, Simulation

LUMPED, REDUCED = ROOT / "scenarios/campaigns/v450_spectra.toml", ROOT / "tests/benchmarks/w4.toml"
RANKS, SIZE, PARTS = (1, 10, 100, 300, 1000), 1000, (1, 50)  # runs a part: simulated; of the campaigns that are measured
RUNS = 400
PAGE = ROOT / "docs/campaign.md"


def shortened(file, folder, part):
    """The first runs of a campaign, in small parts."""
    fewer = ("count = 1000", f"count = {RUNS // 100}") if file == LUMPED else ("= 1000", f"= {RUNS}")
    short = pathlib.Path(folder) / f"{file.stem}_{part}.toml"
    short.write_text(f"part = {part}\n{file.read_text().replace(*fewer)}")
    return short


def held(lock, process):
    """When others held the lock, as pairs of times, until the process ends."""
    changes, was = [], False
    with open(lock) as file:
        while process.poll() is None:
            try:
                fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
                fcntl.flock(file, fcntl.LOCK_UN)
                now = False
            except BlockingIOError:
                now = True
            if now != was:
                changes.append(time.perf_counter())
                was = now
    return list(itertools.pairwise([*changes, time.perf_counter()]))[::2]


class Missed(Exception):
    """A busy machine hid when the lock was held."""


class Seen:
    """The second half of a short campaign, by one thread; the first was made before, so that it claims, and ends all."""

    def __init__(self, file, cache, part):
        with tempfile.TemporaryDirectory() as folder:
            short, made = shortened(file, folder, part), pathlib.Path(folder) / "made"
            campaign(short, made, cache=cache, options=["--array", "0/2"])
            begin = time.perf_counter()
            environment = {**os.environ, "OMP_NUM_THREADS": "1", "THERMOTWIN_CACHE": str(cache)}
            with subprocess.Popen([THERMOTWIN, "campaign", str(short), "--array", "1/2", "-o", str(made)], text=True,
                                  stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, env=environment) as process:
                times = held(made / "lock", process)
                printed = process.stdout.read()
            if len(times) != 2:
                raise Missed
            (claimed, released), (finishing, finished) = times
            self.start, self.claim, self.index = claimed - begin, released - claimed, finished - finishing
            files = sorted((made / "parts").glob("*.h5"), key=lambda f: f.stat().st_mtime_ns)[RUNS // part // 2:]
            self.record = sum(f.stat().st_size for f in files) / (RUNS / 2)
            self.ends = np.array([f.stat().st_mtime_ns for f in files]) * 1e-9
        self.run, self.overhead = (float(f) * 1e-3 for f in re.findall(r"([\d.]+) ms (?:of|for)", printed))
        self.reading = finishing - released - RUNS / 2 * (self.run + self.overhead)


def seen(file, cache, part, tries=10):
    for _ in range(tries):
        try:
            return Seen(file, cache, part)
        except Missed:
            pass
    raise SystemExit("the machine is too busy to see when the lock is held")


def costs(title, file, cache, disk):
    """From the same runs in parts of one and of many: what a run costs, and what a part."""
    single, many = (seen(file, cache, part) for part in PARTS)
    share = 1 / PARTS[1]
    part = (single.overhead - many.overhead) / (1 - share)
    append = max(0.0, many.overhead - share * part)
    part = max(0.0, part - 4 * disk.name - 2 * disk.durable)
    between = np.diff(single.ends)
    runs = between * many.run / between.mean()
    index_part = max(0.0, (single.index - many.index) / (RUNS * (1 - share)))
    index = max(0.0, many.index - RUNS * share * index_part)
    shapes = sum(f.stat().st_size for f in pathlib.Path(cache).iterdir()) if pathlib.Path(cache).exists() else 0
    return Costs(title, many.start, min(single.claim, many.claim), max(0.0, many.reading), shapes, runs.tolist(), append,
                 many.record, part, index, index_part)


def this_disk():
    """Its names, its bytes, and until they are durable, from a few hundred small files and one of 64 MB."""
    with tempfile.TemporaryDirectory(dir=ROOT / "build") as folder:
        begin = time.perf_counter()
        for k in range(300):
            os.close(os.open(f"{folder}/{k}", os.O_WRONLY | os.O_CREAT))
            os.rename(f"{folder}/{k}", f"{folder}/{k}.h5")
        name = (time.perf_counter() - begin) / 600
        durable = np.median([synchronised(f"{folder}/{k}.h5", b"x") for k in range(20)])
        size = 1 << 26
        bandwidth = size / (synchronised(f"{folder}/large", bytes(size)))
    return FileSystem("this disk", name, bandwidth, durable)


def synchronised(path, contents):
    begin = time.perf_counter()
    with open(path, "wb", buffering=0) as file:
        file.write(contents)
        os.fsync(file.fileno())
    return time.perf_counter() - begin


def of(cost):
    runs = np.array(cost.runs)
    low, high = 1e3 * np.percentile(runs, [5, 95])
    return [cost.title, f"{1e3 * runs.mean():.1f} ms ({low:.1f} to {high:.1f})", f"{cost.start + cost.reading:.2f} s",
            f"{1e3 * cost.claim:.1f} ms", f"{1e6 * cost.append:.0f} µs", f"{1e-3 * cost.record:.1f} kB",
            f"{1e3 * cost.part:.1f} ms", f"{1e3 * cost.index:.0f} ms and {1e3 * cost.index_part:.2f} ms a part"]


def causes(simulation, most=2):
    """What took most of the last rank's time besides its runs."""
    largest = sorted(CAUSES, key=lambda cause: -simulation.lost[cause])[:most]
    return ", ".join(f"{CAUSES[cause]} {simulation.lost[cause]:.2g} s" for cause in largest)


def first_bottleneck(simulations):
    """What grows most from one rank to where a tenth is lost, or to all of them."""
    one = simulations[0]
    there = next((s for s in simulations if s.efficiency < 0.9 * one.efficiency), simulations[-1])
    return CAUSES[max(CAUSES, key=lambda cause: there.lost[cause] - one.lost[cause])], there


def scaling(cost, files):
    simulations = [Simulation(cost, files, ranks, ranks, SIZE) for ranks in RANKS]
    rows = [[cost.title if s.ranks == 1 else "", files.title if s.ranks == 1 else "", f"{s.ranks:,}", f"{s.time:.1f} s",
             f"{100 * s.efficiency:.0f} %", causes(s)] for s in simulations]
    cause, there = first_bottleneck(simulations)
    return rows, f"{cost.title}, {files.title}: **{cause}** ({there.ranks:,} ranks, {100 * there.efficiency:.0f} %)"


def tables_of_costs(all_costs, systems):
    head = ["one thread", "a run (5 to 95 %)", "start", "holds the lock", "result to journal", "a result", "a part's file",
            "the index"]
    files = [[f.title, f"{1e6 * f.name:.0f} µs", f"{1e-9 * f.bandwidth:.1f} GB/s", f"{1e3 * f.durable:.1f} ms"]
             for f in systems]
    return [f"Costs of {datetime.date.today():%-d %B %Y}, {machine()}.\n\n" + table(head, [of(cost) for cost in all_costs]),
            table(["file system", "a name", "bytes", "until durable"], files)]


def tables_of_scaling(all_costs, systems):
    each = [scaling(cost, files) for cost in all_costs for files in systems]
    head = ["runs", "file system", "ranks", "time", "efficiency", "lost most to"]
    return [table(head, [row for rows, _ in each for row in rows]),
            "The first bottleneck, and where it shows:\n\n" + "".join(f"- {named}\n" for _, named in each)]


def of_few_parts(cost, files):
    """What 1,000 ranks make of 100,000 runs in 256 parts, as is the default, and in a part each."""
    default, small = (Simulation(cost, files, 1000, parts, size) for parts, size in ((256, 391), (1000, 100)))
    return f"With fewer parts than ranks, ranks stand idle: 100,000 runs ({cost.title}) are 256 parts by default,\n" \
        f"which 1,000 ranks make with an efficiency of {100 * default.efficiency:.0f} %; with `part = 100` it is " \
        f"{100 * small.efficiency:.0f} %, lost most to {causes(small, 1)}.\n"


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--name", type=float, default=50e-6, help="to open, rename or look for a file [s] (%(default)g)")
    options.add_argument("--bandwidth", type=float, default=10e9, help="of all its disks [bytes/s] (%(default)g)")
    options.add_argument("--durable", type=float, default=0.0, help="that a durable write keeps others [s] (%(default)g)")
    asked = options.parse_args()
    disk = this_disk()
    systems = [disk, FileSystem("a parallel one (assumed)", asked.name, asked.bandwidth, asked.durable)]
    with tempfile.TemporaryDirectory() as cache:
        all_costs = [costs("24 h on `v450`, in modes", LUMPED, f"{cache}/none", disk),
                     costs("8 h on `v450_fine`, reduced", REDUCED, f"{cache}/shapes", disk)]
    text = "\n".join([*tables_of_costs(all_costs, systems), *tables_of_scaling(all_costs, systems),
                      of_few_parts(all_costs[0], systems[-1])])
    print(text)
    put_between_markers(PAGE, "script/weak_scaling", text)


if __name__ == "__main__":
    sys.exit(main())
