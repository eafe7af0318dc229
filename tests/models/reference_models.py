"""Reads a table (inputs, then the response) from standard input and prints what scikit-learn makes of it.

support_vector: fitted to the first rows, as many as the last number says, it predicts all.
c_means: inputs are coordinates of points and then their memberships to start from; the response is not looked at. The
iteration is that of methods.md 4.3, in numpy.
"""

import sys

import numpy
from sklearn.decomposition import PCA
from sklearn.linear_model import Ridge
from sklearn.svm import SVR

table = numpy.loadtxt(sys.stdin)
x, y = table[:, :-1], table[:, -1]
kind, *numbers = sys.argv[1:]
numbers = [float(n) for n in numbers]

if kind == "support_vector":
    cost, g, epsilon, fitted = numbers
    rows = slice(int(fitted))
    model = SVR(kernel="rbf", C=cost, gamma=g, epsilon=epsilon, tol=1e-9).fit(x[rows], y[rows])
    result = model.predict(x)
elif kind == "principal_components":
    z = (x - x.mean(0)) / x.std(0, ddof=1)
    result = PCA(svd_solver="full").fit(z).explained_variance_
elif kind == "directions":
    z = (x - x.mean(0)) / x.std(0, ddof=1)
    rows = PCA(svd_solver="full").fit(z).components_
    signs = numpy.sign(rows[numpy.arange(len(rows)), numpy.abs(rows).argmax(1)])
    result = (rows * signs[:, None]).ravel()
elif kind == "ridge":
    (penalty,) = numbers
    z = (x - x.mean(0)) / x.std(0)
    result = Ridge(alpha=penalty * len(y), solver="svd").fit(z, y).predict(z)
elif kind == "c_means":
    clusters, exponent = int(numbers[0]), numbers[1]
    points, u = x[:, :-clusters], x[:, -clusters:].T
    change = 1.0
    while change > 1e-12:
        weights = u**exponent
        v = weights @ points / weights.sum(1, keepdims=True)
        d = numpy.linalg.norm(points[None, :, :] - v[:, None, :], axis=2)
        new = 1 / ((d[:, None, :] / d[None, :, :]) ** (2 / (exponent - 1))).sum(1)
        change, u = abs(new - u).max(), new
    result = numpy.concatenate([u.ravel(), v.ravel()])

print("\n".join(repr(float(value)) for value in result))
