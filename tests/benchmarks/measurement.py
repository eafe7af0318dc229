"""How the workloads of performance.py are measured: programs in turn, their medians, and what else the machine did."""
import dataclasses
import functools
import json
import os
import pathlib
import re
import resource
import statistics
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = ROOT / "build"
THERMOTWIN = str(BUILD / "thermotwin")
AS_ROOT = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
SECONDS = {"s": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9}


class Failure(Exception):
    """A program that did not end as it should."""


@dataclasses.dataclass
class Process:
    """What is seen of a program that ended."""

    wall: float  # s
    processor: float  # s, of all its threads and children
    printed: str


@dataclasses.dataclass
class Answer:
    """What a workload showed, as it is kept and printed."""

    title: str
    limit: str = ""
    bars: list = dataclasses.field(default_factory=list)
    agreements: list = dataclasses.field(default_factory=list)
    tables: list = dataclasses.field(default_factory=list)

    def bar(self, bar, measured, met, runs):
        """`met`: True, False, or None for what was not measured."""
        self.bars.append({"bar": bar, "measured": measured, "met": met, "runs": runs})

    def agree(self, what, apart, allowed, unit):
        self.agreements.append({"what": what, "apart": float(apart), "allowed": allowed, "unit": unit,
                                "holds": bool(apart <= allowed)})

    def table(self, title, head, rows):
        self.tables.append({"title": title, "head": head, "rows": rows})


def timed(command, environment=None):
    """Failure unless it ends well."""
    with tempfile.TemporaryFile("w+") as printed, tempfile.TemporaryFile("w+") as errors:
        begin = time.perf_counter()
        process = subprocess.Popen(command, stdout=printed, stderr=errors, env={**os.environ, **(environment or {})})
        _, status, usage = os.wait4(process.pid, 0)
        wall = time.perf_counter() - begin
        process.returncode = os.waitstatus_to_exitcode(status)
        printed.seek(0)
        errors.seek(0)
        if process.returncode != 0:
            raise Failure(f"{' '.join(command)}\nended with {process.returncode}: {errors.read().strip()}")
        return Process(wall, usage.ru_utime + usage.ru_stime, printed.read())


def in_turn(*contenders):
    """Each (name, function, runs) once, then each once again, so that a drift of the machine's clock meets all alike."""
    answers = {name: [] for name, _, _ in contenders}
    for k in range(max(runs for _, _, runs in contenders)):
        for name, function, runs in contenders:
            if k < runs:
                answers[name].append(function())
                print(f"  {name}, {k + 1} of {runs}", file=sys.stderr, flush=True)
    return answers


def ratios(many, few):
    """Of two that ran in turn: the median of the ratios of neighbours, the smallest and the largest."""
    each = [a / b for a, b in zip(many, few)]
    return statistics.median(each), min(each), max(each)


def google_benchmark(pattern):
    """Cases of thermotwin_bench by name, once: their counters, and `seconds`."""
    command = [str(BUILD / "thermotwin_bench"), f"--benchmark_filter={pattern}", "--benchmark_format=json"]
    cases = json.loads(timed(command).printed)["benchmarks"]
    for case in cases:
        if case.get("error_occurred"):
            raise Failure(f"{case['name']}: {case['error_message']}")
    return {case["name"]: {**case, "seconds": case["real_time"] * SECONDS[case["time_unit"]]} for case in cases}


def campaign(file, folder, threads=1, ranks=1, cache="", options=()):
    """The process, seconds of a thread per run, and of the campaign itself."""
    command = [THERMOTWIN, "campaign", str(file), "-o", str(folder), *options]
    environment = {"OMP_NUM_THREADS": str(threads), "THERMOTWIN_CACHE": str(cache)}
    if ranks > 1:
        command, environment = ["mpirun", "-np", str(ranks), "--oversubscribe", *command], environment | AS_ROOT
    process = timed(command, environment)
    found = re.search(r"([\d.]+) ms of a thread each, and (-?[\d.]+) ms for the campaign", process.printed)
    if not found or re.search(r"[1-9]\d* of them failed", process.printed):
        raise Failure(f"{' '.join(command)}\nnot all runs were made: {process.printed}")
    return process, float(found[1]) * 1e-3, float(found[2]) * 1e-3


@functools.cache
def bandwidth():
    """Bytes per second of memory with all cores, and of the nearest cache of one."""
    told = json.loads(timed([str(BUILD / "memory_bandwidth")]).printed)
    return told["bytes_per_second"], told["cache_bytes_per_second"]


def processor_times():
    """Seconds that all processors were busy, and that this process and its ended children took."""
    fields = [float(f) for f in pathlib.Path("/proc/stat").read_text().split("\n", 1)[0].split()[1:9]]
    idle = fields[3] + fields[4]
    own = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return (sum(fields) - idle) / os.sysconf("SC_CLK_TCK"), sum(u.ru_utime + u.ru_stime for u in own)


def peak_memory(process):
    """Of a program that still runs [bytes]."""
    return 1024 * int(re.search(r"VmHWM:\s+(\d+)", pathlib.Path(f"/proc/{process.pid}/status").read_text())[1])


class Neighbours:
    """What else the machine did in a `with`: its load before, and the processors that others kept busy meanwhile."""

    def __enter__(self):
        self.load, self.begin, self.before = os.getloadavg()[0], time.perf_counter(), processor_times()
        return self

    def __exit__(self, *_):
        self.seconds = time.perf_counter() - self.begin
        busy, own = (after - before for after, before in zip(processor_times(), self.before))
        self.processors = max(0.0, (busy - own) / self.seconds)


def machine():
    """One line: processor, cores, vector units."""
    text = pathlib.Path("/proc/cpuinfo").read_text()
    name = re.search(r"model name\s*: (.*)", text)[1]
    flags = set(re.search(r"flags\s*: (.*)", text)[1].split())
    units = [title for flag, title in (("avx2", "AVX2"), ("fma", "FMA"), ("avx512f", "AVX-512")) if flag in flags]
    virtual = " (virtual)" if "hypervisor" in flags else ""
    return f"{name}, {os.cpu_count()} cores{virtual}, {', '.join(units)}"


def version():
    return timed([THERMOTWIN, "--version"]).printed.strip().removeprefix("thermotwin ")
