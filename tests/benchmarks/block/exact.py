"""The block's cells in closed form: conduction and films are sums of one-dimensional operators, so the modes are products
of three one-dimensional ones, and each follows constant heat exactly."""
import numpy as np

SIZE, CONDUCTIVITY, HEAT_CAPACITY, FILM = (1.0, 0.5, 0.3), 50.0, 7200.0 * 500.0, 8.0
UNTIL, WATTS = (3600.0, 5400.0, 9000.0, 14400.0), (300.0, 0.0, 500.0, 100.0)


def axis(cells, length):
    """Eigenvalues [1/s] and modes of one direction."""
    step = length / cells
    rate = CONDUCTIVITY / step**2 / HEAT_CAPACITY
    matrix = 2 * rate * np.eye(cells) - rate * (np.eye(cells, k=1) + np.eye(cells, k=-1))
    matrix[0, 0] = matrix[-1, -1] = rate + FILM / step / HEAT_CAPACITY
    return np.linalg.eigh(matrix)


def heated_cells(n):
    return [i + n[0] * (n[1] // 2 + n[1] * (n[2] - 1)) for i in range(n[0] // 4, n[0] // 4 + n[0] // 8)]


def transformed(values, modes):
    """values[z, y, x] along all three axes."""
    return np.einsum("zyx,xa,yb,zc->cba", values, *modes, optimize=True)


def rises(n, times):
    """Temperature rise [K] of all cells, x fastest, at each of the times."""
    rates, modes = zip(*(axis(c, s) for c, s in zip(n, SIZE)))
    decay = rates[2][:, None, None] + rates[1][None, :, None] + rates[0][None, None, :]
    cells = heated_cells(n)
    volume = np.prod(SIZE) / np.prod(n)
    heat = np.zeros(np.prod(n))
    heat[cells] = 1.0 / len(cells) / (HEAT_CAPACITY * volume)
    heat = transformed(heat.reshape(n[::-1]), modes)
    state, now, answers = np.zeros_like(heat), 0.0, []
    for end, watts in zip(UNTIL, WATTS):
        steady = watts * heat / decay
        for t in (t for t in times if now < t <= end):
            answers.append(transformed(steady + (state - steady) * np.exp(-decay * (t - now)), [m.T for m in modes]).ravel())
        state = steady + (state - steady) * np.exp(-decay * (end - now))
        now = end
    return np.array(answers)
