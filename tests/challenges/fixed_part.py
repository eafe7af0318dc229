#!/usr/bin/python3
"""fixed_part.py PROGRAM FOLDER: four worlds of HIDE-1000, made, diagnosed and scored.

Holds what must never happen, however much remains unnamed: an error, an alarm where nothing is hidden, a name that
excludes the truth where the truth is in the catalogue, an amended machine that is further than the user's from what the
hidden machine did on the unseen run. The worlds must be those of keys.jsonl."""
import importlib.machinery
import importlib.util
import json
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
SEEDS = (7, 10)


def scorer():
    loader = importlib.machinery.SourceFileLoader("challenge", str(HERE.parents[1] / "script" / "challenge"))
    spec = importlib.util.spec_from_loader("challenge", loader)
    module = importlib.util.module_from_spec(spec)
    loader.exec_module(module)
    return module


def complaints(score, result, key):
    truth, answer = result["truth"], result["answer"]
    if {name: truth[name] for name in key} != key:
        yield "is another world than that of keys.jsonl"
    if answer["verdict"] == "error":
        yield f"ends in an error: {answer['message']}"
    if truth["kind"] == "none" and answer["verdict"] != "nothing":
        yield f"hides nothing; the verdict is {answer['verdict']}"
    if truth["kind"] in ("one", "two") and score.excludes_truth(truth, answer):
        yield f"hides {score.truth_names(truth)}; named {score.groups(answer)}"
    if score.groups(answer) and result["gap"]["all"] > 1.0:
        yield f"leaves {result['gap']['all']} of the error against what the hidden machine did on the unseen run"


def main():
    program, folder = Path(sys.argv[1]), Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    for old in folder.glob("*.json"):
        old.unlink()
    subprocess.run([sys.executable, HERE.parents[1] / "script" / "challenge", "--seeds", f"{SEEDS[0]}-{SEEDS[1]}",
                    "--program", program, "--into", folder, "--jobs", "2"], check=False)
    score = scorer()
    keys = [json.loads(line) for line in (HERE / "keys.jsonl").read_text().splitlines()]
    results = [json.loads(file.read_text()) for file in sorted(folder.glob("*.json"))]
    wrong = [f"seed {result['truth']['seed']} {complaint}" for result in results
             for complaint in complaints(score, result, keys[result["truth"]["seed"] - 1])]
    if len(results) != SEEDS[1] - SEEDS[0] + 1:
        wrong.append(f"{len(results)} results")
    print("\n".join(wrong))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
