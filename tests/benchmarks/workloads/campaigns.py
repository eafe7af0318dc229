"""W8: a campaign of lumped runs of 24 h beside a plain loop of CVODE and KLU on the same network."""
import os
import pathlib
import re
import statistics
import subprocess
import tempfile
import time

from measurement import ROOT, THERMOTWIN, Answer, Failure, bandwidth, campaign, google_benchmark, in_turn, peak_memory, ratios

FILE = ROOT / "scenarios/campaigns/v450_spectra.toml"
AGREED = 1e-4  # K, rms over nodes and samples
PEER, OURS, WHOLE = "UntunedCvodeKlu24h", "Integration24h/modes/10", "CampaignRun24h/modes"
CASES = {PEER: "untuned loop: CVODE, KLU, our right-hand side and Jacobian", "Integration24h/bdf/10": "BDF, tolerance 1e-5",
         "Integration24h/bdf/25": "BDF, tolerance 2.5e-5", OURS: "modes, tolerance 1e-5",
         "Integration24h/modes/25": "modes, tolerance 2.5e-5", "CampaignRun24h/full": "a whole run of a campaign, in full",
         WHOLE: "a whole run of a campaign, in modes"}


def million(folder):
    """The shipped campaign with ten times as many spectra: 10⁶ runs."""
    file = pathlib.Path(folder) / "million.toml"
    file.write_text(re.sub(r"= 100$", "= 1000", FILE.read_text(), flags=re.MULTILINE))
    return file


def first_result(file, folder):
    """Seconds until a result is on disk, and the peak memory [bytes] until then; then the campaign is killed."""
    begin = time.perf_counter()
    process = subprocess.Popen([THERMOTWIN, "campaign", str(file), "-q", "-o", str(folder)])
    try:
        while not any(journal.stat().st_size for journal in pathlib.Path(folder).glob("parts/*.journal")):
            if process.poll() is not None or time.perf_counter() - begin > 60:
                raise Failure(f"{file.name}: no result")
            time.sleep(0.002)
        return time.perf_counter() - begin, peak_memory(process)
    finally:
        process.kill()
        process.wait()


def in_new_folder(function, *arguments, **named):
    with tempfile.TemporaryDirectory() as folder:
        return function(*arguments, f"{folder}/made", **named)


def w8(runs, long):
    answer = Answer("campaign of lumped runs of 24 h on `v450`")
    speed_of_w8(answer, runs)
    with tempfile.TemporaryDirectory() as folder:
        file = million(folder)
        seen = in_turn(("a share of the campaign", lambda: in_new_folder(campaign, FILE, options=["--array", "0/50"]), runs),
                       ("start of a million", lambda: in_new_folder(first_result, file), runs))
    overhead = statistics.median(overhead for *_, overhead in seen["a share of the campaign"])
    answer.bar("overhead ≤ 50 µs a run", f"{1e6 * overhead:.0f} µs", overhead <= 50e-6, runs)
    seconds, peak = (statistics.median(each) for each in zip(*seen["start of a million"]))
    answer.bar("10⁶ runs start in 1 s and 200 MB", f"first result after {seconds:.2f} s, {peak / 1e6:.0f} MB",
               seconds <= 1 and peak <= 200e6, runs)
    whole_of_w8(answer, long)
    return answer


def speed_of_w8(answer, runs):
    seen = in_turn(*((name, lambda name=name: google_benchmark(f"^{name}$")[name], runs) for name in CASES))
    rows = []
    for name, title in CASES.items():
        error = seen[name][-1].get("rms_K")
        rows.append([title, f"{1e3 * statistics.median(case['seconds'] for case in seen[name]):.1f} ms",
                     f"{error:.1e} K" if error else ""])
        if error:
            answer.agree(f"24 h on `v450`, {title}", error, AGREED, "K rms")
    answer.table("24 h on `v450`, one thread", ["by", "time", "error, rms over nodes and samples"], rows)
    peer, whole, ours = ([case["seconds"] for case in seen[name]] for name in (PEER, WHOLE, OURS))
    errors = [seen[name][-1]["rms_K"] for name in (OURS, PEER)]
    ratio, low, high = ratios(peer, whole)
    answer.bar("≥ 2 × untuned CVODE + KLU, at no larger error", f"{ratio:.1f} × ({low:.1f} to {high:.1f})",
               ratio >= 2 and errors[0] <= errors[1], runs)
    case = seen[OURS][-1]
    least = 2 * 8 * case["nodes"] ** 2 * case["evaluations"]
    share = least / bandwidth()[1] / statistics.median(ours)
    answer.limit = f"{100 * share:.0f} % of one core's nearest cache (the matrix of modes, twice an evaluation), next to " \
        "nothing of memory; the rest are the laws themselves"


def whole_of_w8(answer, long):
    if not long:
        return answer.bar("all 100,000 runs", "", None, 0)
    with tempfile.TemporaryDirectory() as folder:
        process, *_ = campaign(FILE, folder, threads=os.cpu_count())
        size = sum(file.stat().st_size for file in pathlib.Path(folder).rglob("*") if file.is_file())
    answer.bar("all 100,000 runs",
               f"none failed; {process.wall / 60:.1f} min on {os.cpu_count()} threads, {size / 1e9:.1f} GB", True, 1)
