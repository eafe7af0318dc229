"""A campaign on many ranks as a simulation of discrete events: each rank on a core of its own, one folder for all.

Three things are shared: the lock of the folder, which one rank holds at a time, and the file system, which serves names
and bytes apart, each one request after the other. Everything else a rank does alone. A rank, as
twin/campaign/run_campaign.cc has it:

    start → lock: claim → read the shapes → for each run: run, append to the journal → write the part
          → where there is no index yet, lock: look for the first part that is missing; who finds none writes the index
"""
import collections
import dataclasses
import heapq

import numpy as np


@dataclasses.dataclass
class FileSystem:
    title: str
    name: float  # s: to open, rename, remove or look for a file
    bandwidth: float  # bytes/s
    durable: float  # s: until bytes or names are on disk


@dataclasses.dataclass
class Costs:
    """Of one process with one thread, without what the file system takes [s, bytes]."""

    title: str
    start: float  # until it asks for the lock
    claim: float  # it holds the lock
    reading: float  # until its first run: the machine again, and the shapes
    shapes: int  # bytes it reads
    runs: list  # what single runs took
    append: float  # to bring a result to the journal
    record: int  # bytes of a result
    part: float  # to make a part's file
    index: float  # the index, and per part of it
    index_part: float


CAUSES = {"start": "the start of a process", "lock": "the lock of the folder", "names": "names in the file system",
          "bytes": "bytes to the file system", "results": "bringing results to parts", "index": "the index, by one rank",
          "slowest": "the slowest rank's runs", "parts": "parts that do not go round"}


class Simulation:
    """`parts` parts of `size` runs by `ranks` ranks. `lost`: of the last rank's time [s], by cause; with an even share of
    the runs they make the whole `time`."""

    def __init__(self, costs, files, ranks, parts, size):
        self.costs, self.files, self.ranks, self.parts, self.size = costs, files, ranks, parts, size
        self.random, self.made, self.indexed = np.random.default_rng(1), np.zeros(parts, bool), False
        self.served_until, self.holder, self.queue = {"names": 0.0, "bytes": 0.0}, None, collections.deque()
        self.spent = [dict.fromkeys(CAUSES, 0.0) for _ in range(ranks)]
        self.worked, self.time, self.last = np.zeros(ranks), 0.0, 0
        self.events, self.order = [], 0
        self.run()
        self.account()

    def rank(self, number):
        """What it does, one (kind, amount, cause) after the other."""
        costs = self.costs
        yield "alone", costs.start, "start"
        yield "lock", 0.0, "lock"
        yield "alone", costs.claim, "lock"
        yield "unlock", 0.0, "lock"
        yield "alone", costs.reading, "start"
        yield "bytes", costs.shapes / self.files.bandwidth, "bytes"
        for part in range(number, self.parts, self.ranks):
            yield from self.part(number)
            self.made[part] = True
        yield from self.finish()

    def part(self, number):
        costs, files = self.costs, self.files
        for seconds in self.random.choice(costs.runs, self.size).tolist():
            self.worked[number] += seconds
            yield "alone", seconds, None
            yield "bytes", costs.record / files.bandwidth, "bytes"
        yield "alone", self.size * costs.append + costs.part, "results"
        yield "names", 4 * files.name, "names"
        yield "bytes", self.size * costs.record / files.bandwidth + 2 * files.durable, "bytes"

    def finish(self):
        costs, files = self.costs, self.files
        yield "names", files.name, "names"
        if self.indexed:
            return
        yield "lock", 0.0, "lock"
        whole = self.made.all()
        yield "names", files.name * (self.parts if whole else int(np.argmin(self.made)) + 1), "lock"
        if whole and not self.indexed:
            self.indexed = True
            yield "alone", costs.index + self.parts * costs.index_part, "index"
            yield "bytes", 4 * files.durable, "index"
        yield "unlock", 0.0, "lock"

    def run(self):
        ranks = [self.rank(number) for number in range(self.ranks)]
        for number in range(self.ranks):
            self.at(0.0, number)
        while self.events:
            now, _, number = heapq.heappop(self.events)
            step = next(ranks[number], None)
            if step is None:
                self.time, self.last = now, number
            else:
                self.take(now, number, *step)

    def at(self, time, number):
        self.order += 1
        heapq.heappush(self.events, (time, self.order, number))

    def take(self, now, number, kind, amount, cause):
        """The rank goes on when it is over, or, of a lock that another holds, when that gives it away."""
        if kind == "lock" and self.holder is not None:
            return self.queue.append((now, number))
        end = now + amount
        if kind in self.served_until:
            end = self.served_until[kind] = max(now, self.served_until[kind]) + amount
        elif kind == "lock":
            self.holder = number
        elif kind == "unlock":
            self.pass_on(now)
        if cause:
            self.spent[number][cause] += end - now
        self.at(end, number)

    def pass_on(self, now):
        self.holder = None
        if self.queue:
            since, self.holder = self.queue.popleft()
            self.spent[self.holder]["lock"] += now - since
            self.at(now, self.holder)

    def account(self):
        even = self.parts * self.size * np.mean(self.costs.runs) / self.ranks
        most = -(-self.parts // self.ranks) * self.size * np.mean(self.costs.runs)
        self.lost = self.spent[self.last]
        self.lost["parts"] = most - even
        self.lost["slowest"] = self.worked[self.last] - most
        self.efficiency = even / self.time
