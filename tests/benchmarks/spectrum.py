#!/usr/bin/python3
"""spectrum.py --check PROGRAM [MACHINE...]: v450, g200 and vmc850 through 9 h of spectrum by SciPy's BDF, on the same
network as the program's.

The network is read from the same machine file by code of its own, so that agreement of the two answers is a check of
both. The right-hand side is vectorised NumPy; the relative tolerance is 1e-6. PROGRAM is run once for each machine: exit
code 1 where any node differs by more than 1 mK at the end. script/bench times both (W3 of docs/performance.md).
"""
import argparse
import math
import pathlib
import re
import subprocess
import sys
import tempfile
import tomllib

import h5py
import numpy as np
from scipy.integrate import solve_ivp

ROOT = pathlib.Path(__file__).resolve().parents[2]
MACHINES = ["v450", "g200", "vmc850"]
SPECTRUM = [(25, 3600), (50, 3600), (75, 3600), (100, 3600), (0, 1800), (75, 5400), (50, 3600), (100, 3600), (0, 3600)]
AIR = 295.15
TOLERATED = 1e-3  # K
FULL_FEED, DUTY = 0.27, 0.88  # m/s, of vmc850 at 100 %
UNITS = {"mm": 1e-3, "mm2": 1e-6, "m2": 1.0, "kg": 1.0, "W/K": 1.0, "W": 1.0, "J/K": 1.0, "kJ/K": 1e3, "N": 1.0,
         "N m": 1.0, "N m/A": 1.0, "ohm": 1.0, "K": 1.0, "rpm": 2 * math.pi / 60, "L/min": 1e-3 / 60, "m/min": 1 / 60,
         "W/(m2 K)": 1.0, "W/(m K)": 1.0, "kg/m3": 1.0, "J/(kg K)": 1.0, "1/K": 1.0, "": 1.0}
OILS = {22: (0.0870e-6, 748.0), 32: (0.0813e-6, 808.0), 68: (0.0710e-6, 929.0)}  # Vogel and Cameron, physics.md 1.2
REFERENCE_SPEED = 1200 * 2 * math.pi / 60


def number(text):
    if not isinstance(text, str):
        return float(text)
    match = re.match(r"([-+0-9.e]+) ?(.*)", text)
    return float(match[1]) * UNITS[match[2]]


class Network:
    """Nodes in the order of the file; places like `shaft[40 mm .. 80 mm]` become weighted nodes."""

    def __init__(self, machine):
        self.materials = {m["name"]: m for m in machine["material"]}
        spindle, self.axis = machine.get("spindle"), machine.get("axis", [None])[0]
        self.full_speed = number(spindle["maximum_speed"]) if spindle else \
            2 * math.pi * FULL_FEED / number(self.axis["lead"]) * DUTY
        self.capacity, self.bodies, self.links, self.to_air = [], {}, [], []
        for body in machine["lump"]:
            heat = body.get("heat_capacity")
            c = number(heat) if heat else number(body["mass"]) * number(self.materials[body["material"]]["specific_heat"])
            self.bodies[body["name"]] = (len(self.capacity), 1, 0.0, 0.0)
            self.capacity.append(c)
        for bar in machine.get("bar", []):
            self.add_bar(bar)
        for joint in machine["joint"]:
            self.connect(joint["from"], joint["to"], conductance(joint))
        self.films = {kind: [] for kind in ("room", "fan", "rotating_cylinder", "constant")}
        for film in machine["film"]:
            places = self.place(film["on"])
            area = number(film["area"]) if "area" in film else self.area(film["on"])
            size = number(film.get("diameter", 1.0))
            for node, share in places:
                self.films[film["correlation"]].append((node, share * area, size, number(film.get("coefficient", 0.0))))
        self.films = {k: np.array(v).T for k, v in self.films.items() if v}
        self.bearings = [self.bearing(b) for b in machine.get("bearing", [])]
        self.motors = [(self.place(m["at"])[0][0], number(m.get("constant", 0)), number(m.get("hysteresis", 0)),
                        number(m.get("eddy", 0))) for m in machine.get("motor_loss", [])]
        self.belts = [(self.place(b["pulley"]), self.place(b["motor"]), number(b["loss"])) for b in machine.get("belt", [])]
        self.switched = [(self.node(h["at"]), number(h["power"])) for h in machine.get("heat", [])
                         if h["while_on"] == "spindle.running"]  # coolant stays off
        self.flows = [(self.node(f["through"]), 2 * number(f["flow"]) * number(f["density"]) * number(f["specific_heat"]),
                       AIR + number(f["inlet_offset"])) for f in machine.get("coolant_flow", [])]
        self.wet = [(self.node(e["from"]), number(e["area"]) * number(e["coefficient"]) / (1.19 * 1007) * e["lewis"] * 2.45e6)
                    for e in machine.get("evaporation", [])]
        self.feed = self.feed_drive(machine) if "ball_nut" in machine else None
        n = len(self.capacity)
        self.capacity = np.array(self.capacity)
        self.matrix = np.zeros((n, n))
        for a, b, g in self.links:
            self.matrix[a, b] += g
            self.matrix[b, a] += g
            self.matrix[a, a] -= g
            self.matrix[b, b] -= g

    def node(self, body):
        return self.bodies[body][0]

    def add_bar(self, bar):
        metal, cells, length = self.materials[bar["material"]], bar["cells"], number(bar["length"])
        section = math.pi / 4 * (number(bar.get("section_diameter", bar["outer_diameter"])) ** 2 - number(bar.get("inner_diameter", 0.0)) ** 2)
        step, first = length / cells, len(self.capacity)
        self.bodies[bar["name"]] = (first, cells, length, number(bar["outer_diameter"]))
        self.capacity += [number(metal["density"]) * number(metal["specific_heat"]) * section * step] * cells
        g = number(metal["conductivity"]) * section / step
        self.links += [(first + i, first + i + 1, g) for i in range(cells - 1)]

    def stretch(self, text):
        inside = re.search(r"\[(.*)\]", text)
        first, cells, length, diameter = self.bodies[text.split("[")[0]]
        if not inside:
            return first, cells, length, 0.0, length
        ends = [number(part.strip()) for part in inside[1].split("..")]
        return first, cells, length, ends[0], ends[-1]

    def place(self, text):
        first, cells, length, low, high = self.stretch(text)
        if cells == 1:
            return [(first, 1.0)]
        step = length / cells
        if low == high:
            return [(first + int(low / step), 1.0)]
        overlap = [max(0.0, min(high, (i + 1) * step) - max(low, i * step)) for i in range(cells)]
        return [(first + i, o / (high - low)) for i, o in enumerate(overlap) if o > 1e-12]

    def area(self, text):
        _, _, _, low, high = self.stretch(text)
        return math.pi * self.bodies[text.split("[")[0]][3] * (high - low)

    def connect(self, a, b, g):
        for i, share_i in self.place(a):
            for j, share_j in self.place(b):
                self.links.append((i, j, g * share_i * share_j))

    def bearing(self, b):
        self.connect(b["inner"], b["outer"], number(b["conductance"]))
        load = b.get("load_factor", 5e-4) * b.get("load_ratio", 0.003) ** b.get("load_exponent", 0.38) \
            * number(b["torque_load"]) * number(b["pitch_diameter"])
        inner, outer = (np.array(list(zip(*self.place(b[k])))) for k in ("inner", "outer"))
        return inner, outer, b["count"], b["grease_factor"], number(b["pitch_diameter"]), load

    def feed_drive(self, machine):
        """Nut, support bearings and motor of a ball-screw axis (physics.md 1.8, 1.9, 2.10, 2.11)."""
        nut, motor = machine["ball_nut"][0], machine["feed_motor"][0]
        first, cells, length, _ = self.bodies[nut["screw"]]
        lead, window = number(nut["lead"]), number(nut["nut_length"])
        weights = time_under(window, number(self.axis["stroke_from"]), number(self.axis["stroke_to"]),
                             np.linspace(0.0, length, cells + 1))
        slope = lead / (math.pi * number(nut["nominal_diameter"]))
        preload = 0.05 / math.sqrt(slope) * number(nut["preload"]) * lead / (2 * math.pi)
        load = number(nut["axial_load"]) * lead / (2 * math.pi) * (1 / nut["efficiency"] - 1)
        supports = []
        for support in machine["support_bearing"]:
            self.connect(support["shaft"], support["ring"], number(support["conductance"]))
            supports.append((self.place(support["shaft"])[0][0], self.node(support["ring"]), number(support["drag_torque"]),
                             support["oil"]))
        return (self.node(nut["nut"]), slice(first, first + cells), weights, preload, load, nut["viscous_share"], nut["oil"],
                supports, self.node(motor["at"]), number(motor["resistance"]), number(motor["torque_constant"]),
                number(motor["constant_torque"]), motor["peak_factor"], number(motor["hysteresis"]), number(motor["eddy"]))

    def add_feed_heat(self, q, T, speed):
        nut, screw, weights, preload, load, viscous, oil, supports, motor, R, k, constant, peak, hysteresis, eddy = self.feed
        between = (1.0 + 1.2 * math.sqrt(speed / REFERENCE_SPEED)) * weights * (T[screw] - T[nut])
        q[screw] -= between
        q[nut] += between.sum()
        if speed == 0:
            return
        torque = preload * (1 - viscous + viscous * flow_ratio(oil, 0.5 * (T[nut] + weights @ T[screw]), speed) ** 0.5) + load
        q[nut] += 0.5 * torque * speed
        q[screw] += 0.5 * torque * speed * weights
        for shaft, ring, drag, grade in supports:
            heat = drag * (0.3 + 0.7 * flow_ratio(grade, 0.5 * (T[shaft] + T[ring]), speed) ** (2 / 3)) * speed
            q[shaft] += 0.5 * heat
            q[ring] += 0.5 * heat
            torque += drag * (0.3 + 0.7 * flow_ratio(grade, T[ring], speed) ** (2 / 3))
        ratio = speed / REFERENCE_SPEED
        q[motor] += peak * 3 * R * (1 + 0.0039 * (T[motor] - 293.15)) * ((torque + constant) / k) ** 2 \
            + hysteresis * ratio + eddy * ratio**2

    def rate(self, T, speed):
        q = self.matrix @ T
        ratio = speed / self.full_speed
        for kind, (node, area, size, coefficient) in self.films.items():
            node = node.astype(int)
            dT = T[node] - AIR
            if kind == "rotating_cylinder":
                h = rotating_cylinder(T[node], size, speed)
            elif kind == "constant" or (kind == "fan" and speed > 0):
                h = coefficient
            else:
                h = 1.7 * 1.3 * (dT * dT + 1e-4) ** (1 / 6) + 0.9 * 0.8 * 4 * 5.670374419e-8 * (0.5 * (T[node] + AIR)) ** 3
            np.add.at(q, node, -h * area * dT)
        for node, factor in self.wet:
            q[node] -= factor * (vapour_density(T[node]) - 0.5 * vapour_density(AIR))
        if self.feed:
            self.add_feed_heat(q, T, speed)
        if speed > 0:
            for node, power in self.switched:
                q[node] += power
            for node, rate, inlet in self.flows:
                q[node] += rate * (inlet - T[node])
            for (i, wi), (o, wo), count, f0, d, load in self.bearings:
                i, o = i.astype(int), o.astype(int)
                mean = 0.5 * (wi @ T[i] + wo @ T[o]) - 273.15
                viscosity = kinematic_viscosity(22, mean + 273.15)
                heat = count * (4500.9 * f0 * (viscosity * speed) ** (2 / 3) * d**3 + load) * speed
                q[i] += 0.5 * heat * wi
                q[o] += 0.5 * heat * wo
            for node, constant, hysteresis, eddy in self.motors:
                q[node] += constant + hysteresis * ratio + eddy * ratio**2
            for pulley, motor, loss in self.belts:
                for places, share in ((pulley, 0.35), (motor, 0.325)):
                    for node, weight in places:
                        q[node] += share * weight * loss * ratio
        return q / self.capacity


def conductance(joint):
    if "conductance" in joint:
        return number(joint["conductance"])
    contact = number(joint["coefficient"]) * number(joint["area"])
    return 1 / (1 / contact + (1 / number(joint["in_series"]) if "in_series" in joint else 0.0))


def time_under(window, low, high, edges):
    """The share of its time that a window spends over each cell, its centre equally often everywhere from low to high."""
    ends = np.array([low - window / 2, low + window / 2, high - window / 2, high + window / 2])
    top = 1 / (high - low)

    def up_to(edge):
        x = np.append(ends[ends < edge], edge)
        height = np.interp(x, ends, [0.0, top, top, 0.0])
        return (0.5 * (height[1:] + height[:-1]) * np.diff(x)).sum()

    return np.diff([up_to(edge) for edge in edges])


def kinematic_viscosity(grade, T):
    scale, temperature = OILS[grade]
    return scale * math.exp(temperature / (T - 273.15 + 95))


def flow_ratio(grade, T, speed):
    return kinematic_viscosity(grade, T) / kinematic_viscosity(grade, 313.15) * speed / REFERENCE_SPEED


def vapour_density(T):
    return 611.2 * math.exp(17.62 * (T - 273.15) / (T - 273.15 + 243.12)) / (461.5 * T)


def rotating_cylinder(T, diameter, speed):
    film = 0.5 * (T + AIR) - 273.15
    k = 0.02425 + (0.02987 - 0.02425) / 75 * film
    nu = 1.35e-5 + (2.078e-5 - 1.35e-5) / 75 * film
    Pr = 0.71
    forced = 0.133 * (speed * diameter**2 / (2 * nu)) ** (2 / 3) * Pr ** (1 / 3)
    dT = np.sqrt((T - AIR) ** 2 + 1e-4)
    Ra = 9.80665 / (film + 273.15) * dT * diameter**3 / nu**2 * Pr
    free = (0.6 + 0.387 * Ra ** (1 / 6) / (1 + (0.559 / Pr) ** (9 / 16)) ** (8 / 27)) ** 2
    return (forced**3 + free**3) ** (1 / 3) * k / diameter


def network_of(machine):
    return Network(tomllib.loads((ROOT / f"twin/machines/{machine}.toml").read_text()))


def integrate(network):
    T, t = np.full(len(network.capacity), AIR), 0.0
    for share, duration in SPECTRUM:
        speed = share / 100 * network.full_speed
        grid = np.arange(t, t + duration + 1, 60.0)
        # Temperatures count from the room, so that the relative tolerance is that of the rise.
        answer = solve_ivp(lambda _, rise: network.rate(AIR + rise, speed), (t, t + duration), T - AIR, "BDF", t_eval=grid,
                           rtol=1e-6, atol=1e-5)
        T, t = AIR + answer.y[:, -1], t + duration
    return T


def experiment(machine):
    total = sum(d for _, d in SPECTRUM)
    head = f'machine = "{machine}"\nduration = "{total} s"\n[ambient]\nmean = "22 degC"\n'
    if machine != "vmc850":
        blocks = ", ".join(f'{{duration = "{d} s", of_maximum = "{s} %"}}' for s, d in SPECTRUM)
        return head + f"[spindle]\nblocks = [{blocks}]\n"
    blocks = ", ".join(f'{{duration = "{d} s", feed = "{60 * FULL_FEED * s / 100} m/min"}}' for s, d in SPECTRUM)
    return head + f'[[axes]]\naxis = "z"\nduty = {DUTY}\nblocks = [{blocks}]\n'


def difference(machine, program, T):
    """The largest of any node at the end [K], from a run of the program."""
    with tempfile.TemporaryDirectory() as folder:
        file, run = pathlib.Path(folder) / "spectrum.toml", pathlib.Path(folder) / "run.h5"
        file.write_text(experiment(machine))
        subprocess.run([str(program), "run", str(file), "--quiet", "--nodes", "-o", str(run)], check=True)
        with h5py.File(run) as data:
            return np.abs(T - 273.15 - data["nodes/temperature"][-1]).max()


def check(machine, program):
    apart = difference(machine, program, integrate(network_of(machine)))
    print(f"{machine}: the program and the network in NumPy differ by {apart:.1e} K")
    return apart <= TOLERATED


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", metavar="PROGRAM", required=True)
    parser.add_argument("machines", nargs="*", default=MACHINES)
    asked = parser.parse_args()
    return 0 if all([check(machine, asked.check) for machine in asked.machines]) else 1


if __name__ == "__main__":
    sys.exit(main())
