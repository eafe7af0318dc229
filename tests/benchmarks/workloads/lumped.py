"""W3 and W5: lumped machines through 9 h of spectrum, beside SciPy on the same network, and with sensitivities."""
import statistics
import time

import spectrum
from measurement import THERMOTWIN, Answer, bandwidth, google_benchmark, in_turn, ratios
from workloads.block import MOVED_PER_STEP


def ours(name):
    """Seconds and counters of the integration alone."""
    return lambda: google_benchmark(f"^{name}$")[name]


def scipy(network):
    def run():
        begin = time.perf_counter()
        T = spectrum.integrate(network)
        return time.perf_counter() - begin, T

    return run


def share_of_cache(case, systems=1):
    """Of our time, what the least that all steps must move takes from the nearest cache of one core."""
    return MOVED_PER_STEP * case["nodes"] * case["steps"] * systems / bandwidth()[1] / case["seconds"]


def w3(runs, _):
    answer, rows, shares = Answer("lumped machines, 9 h of spectrum"), [], []
    for machine in spectrum.MACHINES:
        network, name = spectrum.network_of(machine), f"Spectrum/{machine}"
        seen = in_turn((f"{machine}, thermotwin", ours(name), runs), (f"{machine}, SciPy BDF", scipy(network), runs))
        cases, others = seen.values()
        we, they = [c["seconds"] for c in cases], [seconds for seconds, _ in others]
        apart = spectrum.difference(machine, THERMOTWIN, others[-1][1])
        answer.agree(f"`{machine}`, SciPy on a network of its own", apart, spectrum.TOLERATED, "K")
        ratio = ratios(they, we)[0]
        answer.bar(f"`{machine}` ≥ 300 × SciPy", f"{ratio:.0f} ×", ratio >= 300, runs)
        rows.append([f"`{machine}`", int(cases[-1]["nodes"]), int(cases[-1]["steps"]),
                     f"{1e3 * statistics.median(we):.2f} ms", f"{1e3 * statistics.median(they):.0f} ms", f"{ratio:.0f}",
                     f"{1e3 * apart:.2g} mK"])
        shares.append(100 * share_of_cache(cases[-1]))
    answer.table("Lumped machines",
                 ["machine", "nodes", "steps", "thermotwin", "SciPy BDF", "times", "apart at the end"], rows)
    answer.limit = f"{min(shares):.0f} to {max(shares):.0f} % of one core's nearest cache ({MOVED_PER_STEP} bytes a node " \
        "and step), nothing of memory; the rest are powers and roots of films and frictions, and what a step asks once"
    return answer


def w5(runs, _):
    answer = Answer("40 sensitivities on `v450`, 9 h of spectrum")
    plain, more = "Spectrum/v450", "SpectrumWithSensitivities/v450"
    seen = in_turn((plain, ours(plain), runs), (more, ours(more), runs))
    without, with_them = ([case["seconds"] for case in seen[name]] for name in (plain, more))
    ratio, low, high = ratios(with_them, without)
    times = f"{1e3 * statistics.median(with_them):.1f} ms against {1e3 * statistics.median(without):.1f} ms"
    answer.bar("≤ 6 × the run without", f"{ratio:.1f} × ({low:.1f} to {high:.1f}): {times}", ratio <= 6, runs)
    answer.limit = f"{100 * share_of_cache(seen[more][-1], 41):.0f} % of one core's nearest cache, 41 systems of " \
        f"{int(seen[more][-1]['nodes'])} nodes"
    return answer
