"""W4, W6 and W7: a fine machine through its reduced model, in a campaign (../w4.toml) and beside the machine."""
import hashlib
import os
import pathlib
import statistics
import tempfile

from measurement import ROOT, Answer, bandwidth, campaign, google_benchmark, in_turn, ratios

FILE = ROOT / "tests/benchmarks/w4.toml"
RUNS, IN_FULL = 1000, 5


def digest(folder):
    """Of all bytes of a campaign's folder."""
    total = hashlib.sha256()
    for file in sorted(pathlib.Path(folder).rglob("*")):
        if file.is_file():
            total.update(str(file.relative_to(folder)).encode() + file.read_bytes())
    return total.hexdigest()


def made(file, digests, **how):
    """A campaign in a new folder; what its bytes are goes to `digests`."""
    with tempfile.TemporaryDirectory() as folder:
        answer = campaign(file, folder, **how)
        digests.add(digest(folder))
        return answer


class Caches:
    """A folder for shapes that is empty at every call of `empty`, and one that is not."""

    def __init__(self, folder):
        self.folder, self.count = pathlib.Path(folder), 0

    def empty(self):
        self.count += 1
        return self.folder / f"empty_{self.count}"

    @property
    def full(self):
        return self.folder / "full"


def in_full(folder, tolerance):
    """The first runs of the same campaign through all nodes."""
    text = FILE.read_text().replace('"reduced"', f'"full"\ntolerance = {tolerance}')
    file = pathlib.Path(folder) / f"full_{tolerance}.toml"
    file.write_text(text.replace(f"= {RUNS}", f"= {IN_FULL}"))
    return file


def walls(answers):
    return [process.wall for process, *_ in answers]


def w4(runs, _):
    answer = Answer("1,000 × 8 h on `v450_fine`, reduced, two cores")
    with tempfile.TemporaryDirectory() as folder:
        caches, digests, other = Caches(folder), set(), set()
        made(FILE, digests, threads=2, cache=caches.full)
        seen = in_turn(("shapes found", lambda: made(FILE, digests, threads=2, cache=caches.empty()), runs),
                       ("shapes on disk", lambda: made(FILE, digests, threads=2, cache=caches.full), runs),
                       ("in full, 1e-5", lambda: made(in_full(folder, "1e-5"), other, threads=1), runs),
                       ("in full, 1e-6", lambda: made(in_full(folder, "1e-6"), other, threads=1), runs))
        shapes = sum(file.stat().st_size for file in caches.full.iterdir())
    answer.agree("bytes of all campaigns, shapes found or read (kinds beyond one)", len(digests) - 1, 0, "")
    found, kept = seen["shapes found"], seen["shapes on disk"]
    seconds = statistics.median(walls(found))
    answer.bar("≤ 30 s with construction", f"{seconds:.1f} s; shapes on disk: {statistics.median(walls(kept)):.1f} s",
               seconds <= 30, runs)
    gaps_of_w4(answer)
    for tolerance in ("1e-5", "1e-6"):
        full = [in_run * p.processor / p.wall for p, in_run, _ in seen[f"in full, {tolerance}"]]  # of one thread
        each = [ratios([RUNS * f for f in full], [p.processor for p, *_ in which])[0] for which in (found, kept)]
        answer.bar(f"≥ 200 × the full model at a tolerance of {tolerance}, in processor time with construction",
                   f"{each[0]:.0f} × ({statistics.median(full):.2f} s a run in full); shapes on disk: {each[1]:.0f} ×",
                   each[0] >= 200, runs)
    answer.limit = limit_of_w4(shapes)
    return answer


def gaps_of_w4(answer):
    """Against runs in full to 1e-7, on experiments that are none of those that shapes were found from."""
    case = google_benchmark("^bound/v450_fine")["bound/v450_fine/20/iterations:1"]
    answer.agree("largest gap of a sensor to 20 runs in full", case["error_K"], 0.01, "K")
    answer.agree("largest gap of a displacement to 20 runs in full", case["error_um"], 0.1, "µm")
    answer.agree("runs of 20 that left their bound", 20 - case["held"], 0, "")
    answer.bar("sensors within 0.01 K, displacements within 0.1 µm, bound true in 20 runs in full",
               f"{1e3 * case['error_K']:.1f} mK, {case['error_um']:.3f} µm; bound held in {case['held']:.0f} of 20",
               case["error_K"] <= 0.01 and case["error_um"] <= 0.1 and case["held"] == 20, 1)


def limit_of_w4(shapes):
    memory, cache = bandwidth()
    case = google_benchmark("^w4/one_run_reduced$")["w4/one_run_reduced"]
    return f"a run reads {case['least_bytes'] / 1e6:.0f} MB of shapes at the laws' ports, which stay in the cache: " \
        f"{100 * case['least_bytes'] / cache / case['seconds']:.0f} % of one core's nearest cache; of memory only the " \
        f"{shapes / 1e6:.0f} MB of shapes on disk, once, {1e3 * shapes / memory:.0f} ms"


def w6(runs, _):
    answer = Answer("W4 on two threads, and on two MPI ranks")
    with tempfile.TemporaryDirectory() as folder:
        caches, digests = Caches(folder), set()
        made(FILE, digests, threads=2, cache=caches.full)
        contenders = []
        for shapes, cache in (("on disk", lambda: caches.full), ("found", caches.empty)):
            for name, how in (("one", {}), ("two threads", {"threads": 2}), ("two ranks", {"ranks": 2})):
                contenders.append((f"{name}, shapes {shapes}",
                                   lambda how=how, cache=cache: made(FILE, digests, cache=cache(), **how), runs))
        seen = in_turn(*contenders)
    answer.agree("bytes of all campaigns, whatever threads or ranks (kinds beyond one)", len(digests) - 1, 0, "")
    shares = []
    for shapes in ("on disk", "found"):
        one = walls(seen[f"one, shapes {shapes}"])
        for name in ("two threads", "two ranks"):
            two = walls(seen[f"{name}, shapes {shapes}"])
            ratio, low, high = ratios(one, two)
            answer.bar(f"{name}, shapes {shapes}: ≥ 1.9 × one", f"{ratio:.2f} × ({low:.2f} to {high:.2f}); "
                       f"{statistics.median(one):.1f} s to {statistics.median(two):.1f} s", ratio >= 1.9, runs)
            shares.append(f"{100 * ratio / min(2, os.cpu_count()):.0f} %")
    answer.limit = f"two cores: {', '.join(shares)} of them in the order of the rows"
    return answer


def w7(runs, _):
    answer = Answer("a real-time step of the reduced `v450_fine` with its observer")
    cases = in_turn(("w7/live_step", lambda: google_benchmark("^w7/live_step$")["w7/live_step"], runs))["w7/live_step"]
    seconds = statistics.median(case["seconds"] for case in cases)
    answer.bar("≤ 50 µs", f"{1e6 * seconds:.1f} µs", seconds <= 50e-6, runs)
    least = cases[-1]["least_bytes"]
    answer.limit = f"{100 * least / bandwidth()[1] / seconds:.0f} % of one core's nearest cache ({least / 1e3:.0f} kB a step), " \
        "nothing of memory; the rest are the laws themselves"
    return answer
