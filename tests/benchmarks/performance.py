#!/usr/bin/python3
"""How fast, beside programs of others on the same machine (script/bench): runs us and them in turn, sees whether all
answers agree to the stated error, and writes what it measured into docs/performance.md.

Figures are medians over --runs runs. Runs that take minutes are made with --long only, of CalculiX and of CVODES without
a preconditioner one; without it their bars are 'not measured', and what was kept of an earlier --long stays on the page.
Answers are kept in build/bench, one file for each workload. Exit code 1 when a program fails or answers disagree; a bar
that is missed is a 'no' on the page.
"""
import argparse
import dataclasses
import datetime
import json
import sys

import performance_page
from measurement import BUILD, ROOT, Failure, Neighbours, bandwidth, machine, version
from workloads import WORKLOADS

KEPT, PAGE = BUILD / "bench", ROOT / "docs/performance.md"
LONG = {"W1", "W2", "W8"}  # have parts that only --long runs


def measured(name, asked):
    print(f"{name}:", file=sys.stderr, flush=True)
    bandwidth.cache_clear()
    with Neighbours() as seen:
        memory, cache = bandwidth()
        answer = dataclasses.asdict(WORKLOADS[name](asked.runs, asked.long))
    return answer | {"date": f"{datetime.date.today():%-d %B %Y}", "version": version(), "machine": machine(),
                     "memory": memory, "cache": cache, "load": seen.load, "others": seen.processors,
                     "seconds": seen.seconds, "long": asked.long}


def keep(name, answer):
    """A short answer does not replace a long one."""
    file = KEPT / f"{name}.json"
    if name in LONG and not answer["long"] and file.exists() and json.loads(file.read_text())["long"]:
        return print(f"{name}: an earlier answer of --long stays on the page", file=sys.stderr)
    KEPT.mkdir(exist_ok=True)
    file.write_text(json.dumps(answer, indent=1, ensure_ascii=False) + "\n")


def kept():
    files = {name: KEPT / f"{name}.json" for name in WORKLOADS}
    return {name: json.loads(file.read_text()) for name, file in files.items() if file.exists()}


def report(name, answer):
    """Prints the bars; whether all answers agree."""
    print(f"{name} ({answer['seconds']:.0f} s): {answer['title']}")
    for bar in answer["bars"]:
        print(f"  {bar['bar']}: {bar['measured']}: {performance_page.met(bar).strip('*')}")
    for a in answer["agreements"]:
        if not a["holds"]:
            print(f"  answers disagree: {a['what']}: {a['apart']:.2g} {a['unit']}, stated {a['allowed']:g}", file=sys.stderr)
    return all(a["holds"] for a in answer["agreements"])


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--long", action="store_true", help="also the runs that take minutes")
    options.add_argument("--runs", type=int, default=5)
    options.add_argument("workloads", nargs="*", metavar="W1 ... W8", help="default: all")
    asked = options.parse_args()
    if unknown := set(asked.workloads) - set(WORKLOADS):
        options.error(f"there is no {', '.join(sorted(unknown))}; there are {', '.join(WORKLOADS)}")
    if asked.runs < 1:
        options.error("--runs must be at least 1")
    well = True
    for name in asked.workloads or WORKLOADS:
        try:
            answer = measured(name, asked)
        except Failure as failure:
            print(f"{name}: {failure}", file=sys.stderr)
            well = False
            continue
        keep(name, answer)
        well = report(name, answer) and well
        performance_page.put_between_markers(PAGE, "script/bench", performance_page.text_of(kept()))
    return 0 if well else 1


if __name__ == "__main__":
    sys.exit(main())
