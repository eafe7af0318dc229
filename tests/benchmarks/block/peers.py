"""The block of exact.py by programs of others: SciPy, CalculiX, ngspice. Each returns seconds and the temperature rise
[K] of all cells at the end of each piece of constant heat."""
import pathlib
import subprocess
import tempfile
import time

import numpy as np
from scipy.integrate import solve_ivp
from scipy.sparse import csc_matrix, diags, identity, kron

from exact import CONDUCTIVITY, FILM, HEAT_CAPACITY, SIZE, UNTIL, WATTS, heated_cells

OUTPUT = 60.0  # [s]


def conduction(n):
    """dT/dt = matrix T + watts · source."""
    matrix = csc_matrix((np.prod(n), np.prod(n)))
    for d in range(3):
        step = SIZE[d] / n[d]
        rate, film = CONDUCTIVITY / step**2 / HEAT_CAPACITY, FILM / step / HEAT_CAPACITY
        middle = np.full(n[d], -2.0 * rate)
        middle[0] = middle[-1] = -rate - film
        line = diags([np.full(n[d] - 1, rate), middle, np.full(n[d] - 1, rate)], [-1, 0, 1])
        parts = [identity(n[k]) if k != d else line for k in (2, 1, 0)]
        matrix = matrix + kron(kron(parts[0], parts[1]), parts[2])
    cells = heated_cells(n)
    source = np.zeros(np.prod(n))
    source[cells] = 1.0 / len(cells) / (HEAT_CAPACITY * np.prod(SIZE) / np.prod(n))
    return csc_matrix(matrix), source


def scipy_bdf(n, tolerance=1e-6):
    """The state is the rise over the room, so that the relative tolerance is one of the rise."""
    matrix, source = conduction(n)
    by_row = matrix.tocsr()
    state, now, ends = np.zeros(len(source)), 0.0, []
    begin = time.perf_counter()
    for end, watts in zip(UNTIL, WATTS):
        heat = watts * source
        answer = solve_ivp(lambda _, y: by_row @ y + heat, (now, end), state, "BDF", jac=matrix, rtol=tolerance,
                           atol=10 * tolerance, t_eval=np.arange(now + OUTPUT, end + 1, OUTPUT))
        state, now = answer.y[:, -1], end
        ends.append(state)
    return time.perf_counter() - begin, np.array(ends)


def brick_deck(n):
    corners = [c + 1 for c in n]
    step = [s / c for s, c in zip(SIZE, n)]
    node = lambda i, j, k: 1 + i + corners[0] * (j + corners[1] * k)
    lines = ["*NODE, NSET=ALL"]
    for k in range(corners[2]):
        for j in range(corners[1]):
            lines += [f"{node(i, j, k)},{i * step[0]:.9g},{j * step[1]:.9g},{k * step[2]:.9g}" for i in range(corners[0])]
    lines.append("*ELEMENT, TYPE=C3D8, ELSET=BLOCK")
    faces = {name: [] for name in ("F1", "F2", "F3", "F4", "F5", "F6")}
    element = 0
    for k in range(n[2]):
        for j in range(n[1]):
            for i in range(n[0]):
                element += 1
                ring = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
                lines.append(",".join(str(v) for v in [element, *(node(a, b, k) for a, b in ring),
                                                       *(node(a, b, k + 1) for a, b in ring)]))
                for name, at_face in (("F1", k == 0), ("F2", k == n[2] - 1), ("F3", j == 0), ("F4", i == n[0] - 1),
                                      ("F5", j == n[1] - 1), ("F6", i == 0)):
                    if at_face:
                        faces[name].append(element)
    lines += ["*MATERIAL, NAME=IRON", "*CONDUCTIVITY", f"{CONDUCTIVITY}", "*DENSITY", "7200.", "*SPECIFIC HEAT", "500.",
              "*SOLID SECTION, ELSET=BLOCK, MATERIAL=IRON", "*INITIAL CONDITIONS, TYPE=TEMPERATURE", "ALL,0."]
    cells = [c + 1 for c in heated_cells(n)]
    now = 0.0
    for end, watts in zip(UNTIL, WATTS):
        density = watts / len(cells) / np.prod(step)
        lines += ["*STEP, INC=1000", "*HEAT TRANSFER, DIRECT", f"{OUTPUT},{end - now}", "*FILM, OP=NEW"]
        lines += [f"{e},{name},0.,{FILM}" for name, elements in faces.items() for e in elements]
        lines += ["*DFLUX, OP=NEW"] + [f"{e},BF,{density:.9g}" for e in cells]
        lines += ["*NODE PRINT, NSET=ALL, FREQUENCY=10000", "NT", "*END STEP"]
        now = end
    return "\n".join(lines) + "\n"


def calculix(n):
    """240 fixed steps of implicit Euler; a cell's temperature is the mean of its brick's eight corners."""
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / "block.inp").write_text(brick_deck(n))
        begin = time.perf_counter()
        subprocess.run(["ccx", "block"], cwd=folder, check=True, capture_output=True)
        seconds = time.perf_counter() - begin
        tables, rows = [], []
        for line in (pathlib.Path(folder) / "block.dat").read_text().splitlines() + ["temperatures"]:
            if "temperatures" in line:
                if rows:
                    tables.append(rows)
                rows = []
            elif line.strip():
                rows.append(float(line.split()[1]))
    ends = []
    for rows in tables:
        T = np.array(rows).reshape(n[2] + 1, n[1] + 1, n[0] + 1)
        for axis in range(3):
            T = 0.5 * (np.take(T, range(1, T.shape[axis]), axis) + np.take(T, range(T.shape[axis] - 1), axis))
        ends.append(T.ravel())
    return seconds, np.array(ends)


def ngspice(n):
    """Resistors, capacitors and one source of current, trapezoidal rule; the time is ngspice's, of the whole program."""
    matrix, source = conduction(n)
    volume = np.prod(SIZE) / np.prod(n)
    capacity = HEAT_CAPACITY * volume
    lower = matrix.tocoo()
    lines = ["block"]
    for a, b, rate in zip(lower.row, lower.col, lower.data):
        if a < b:
            lines.append(f"R{a}_{b} n{a} n{b} {1.0 / (rate * capacity):.12g}")
    to_room = -np.asarray(matrix.sum(axis=1)).ravel() * capacity
    lines += [f"R{i} n{i} 0 {1.0 / g:.12g}" for i, g in enumerate(to_room) if g > 1e-12]
    lines += [f"C{i} n{i} 0 {capacity:.12g} ic=0" for i in range(len(source))]
    course, now = "", 0.0
    for end, watts in zip(UNTIL, WATTS):
        course += f"{now + (0.001 if now else 0.0)} {watts} {end} {watts} "
        now = end
    cells = heated_cells(n)
    lines += [f"B{i} 0 n{i} I=V(heat)/{len(cells)}" for i in cells] + [f"Vheat heat 0 PWL({course})"]
    at = " ".join(f"v(n{i})" for i in range(len(source)))
    lines += [".options reltol=1e-6 abstol=1e-6 vntol=1e-6", f".tran {OUTPUT} {UNTIL[-1]} 0 {OUTPUT} uic", ".control", "run",
              f"wrdata out {at}", "quit", ".endc", ".end"]
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / "block.cir").write_text("\n".join(lines) + "\n")
        begin = time.perf_counter()
        subprocess.run(["ngspice", "-b", "block.cir"], cwd=folder, check=True, capture_output=True)
        seconds = time.perf_counter() - begin
        table = np.loadtxt(pathlib.Path(folder) / "out.data")
    times, values = table[:, 0], table[:, 1::2]
    return seconds, np.array([[np.interp(t, times, values[:, i]) for i in range(values.shape[1])] for t in UNTIL])
