"""What script/bench measured, between two markers of docs/performance.md."""
BEGIN, END = "<!-- measured by {}: begin -->", "<!-- measured by {}: end -->"


def table(head, rows):
    lines = ["|" + "|".join(f" {cell} " if str(cell) else " " for cell in line) + "|" for line in [head, *rows]]
    return "\n".join([lines[0], "|" + "---|" * len(head), *lines[1:]]) + "\n"


def put_between_markers(page, script, text):
    begin, end = BEGIN.format(script), END.format(script)
    whole = page.read_text()
    if begin not in whole or end not in whole:
        raise SystemExit(f"{page.name} lacks the line '{begin}' or '{end}'")
    before, rest = whole.split(begin)
    page.write_text(f"{before}{begin}\n\n{text}\n{end}{rest.split(end)[1]}")


def met(bar):
    return {True: "yes", False: "**no**", None: "not measured"}[bar["met"]]


def bars(kept):
    rows = []
    for name, answer in kept.items():
        for k, bar in enumerate(answer["bars"]):
            first = [name, answer["title"]] if k == 0 else ["", ""]
            rows.append([*first, bar["bar"], bar["measured"], bar["runs"] or "", met(bar)])
    return table(["", "workload", "bar", "measured (median)", "runs", "met"], rows)


def circumstances(kept):
    rows = [[name, answer["date"], answer["version"], f"{answer['seconds']:.0f} s", f"{answer['load']:.1f}",
             f"{answer['others']:.2f}", f"{answer['memory'] / 1e9:.1f}, {answer['cache'] / 1e9:.0f} GB/s"]
            for name, answer in kept.items()]
    return table(["", "measured on", "version", "took", "load before", "cores of others meanwhile",
                  "memory, nearest cache of one core"], rows)


def limits(kept):
    return "".join(f"- {name}: {answer['limit']}.\n" for name, answer in kept.items())


def agreements(kept):
    rows = [[name, a["what"], f"{a['apart']:.2g} {a['unit']}".strip(), f"{a['allowed']:g} {a['unit']}".strip(),
             "yes" if a["holds"] else "**no**"] for name, answer in kept.items() for a in answer["agreements"]]
    return table(["", "answers", "apart", "stated", "agree"], rows)


def details(kept):
    return "\n".join(f"### {name}: {one['title']}\n\n{table(one['head'], one['rows'])}"
                     for name, answer in kept.items() for one in answer["tables"])


def text_of(kept):
    """`kept`: answers by name, each with what performance.py adds of when and where."""
    machines = "; ".join(dict.fromkeys(answer["machine"] for answer in kept.values()))
    return f"""{machines}.

{bars(kept)}
{circumstances(kept)}
## How near to the limit

The least that must move, over the bandwidth of where it is, as a share of the time that we take.

{limits(kept)}
## Do all answer the same?

{agreements(kept)}
## In detail

{details(kept)}"""
