# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares two shapes by their conformal invariants: compare_shapes.py MESH MESH.

Two surfaces are conformally equivalent only if their invariants agree: the period matrix of closed
surfaces of genus 1 to 3, up to the choice of a homology basis (for genus 1 it is the modulus tau; a
mirror image has minus the conjugate), the modulus of annuli, the aspect of disks with four corners,
which are the selected vertices of the file or those that the filter chooses. Size, place and pose do
not matter, and a bend without stretch changes nothing. Closed surfaces of genus 0 are all equivalent.
With pip install ricciflow-*.whl.
"""

import math
import sys

import numpy
from pymeshlab import MeshSet
from ricciflow import flatten

# Within this distance all bases of two surfaces of the same genus are searched.
FARTHEST_SEARCH = {1: 4.0, 2: 1.0, 3: 0.4}


def invariants(path):
    """Topology and invariants of the mesh in a file."""
    documents = MeshSet()
    documents.load_new_mesh(path)
    shape = documents.get_topological_measures()
    if shape["connected_components_number"] != 1:
        sys.exit(f"{path} has several components: separate them first.")
    genus, loops = shape["genus"], shape["number_holes"]
    if (genus, loops) == (0, 0):
        return {"genus": genus, "boundary_loops": loops}
    target = {(0, 1): "Rectangle", (0, 2): "Flat everywhere"}.get((genus, loops), "Placed cones")
    result = flatten(documents, target_curvature=target).results
    found = {"genus": genus, "boundary_loops": loops}
    if "period_matrix" in result:
        numbers = numpy.reshape(result["period_matrix"], (genus, genus, 2))
        found["period_matrix"] = numbers[..., 0] + 1j * numbers[..., 1]
        found["period_error"] = result["period_error"]
    keys = ("annulus_modulus", "rectangle_aspect")
    return {**found, **{key: result[key] for key in keys if key in result}}


def energy(omega):
    """Of the real harmonic forms of a surface, as a quadratic form in their 2 g periods."""
    x, y, inverse = omega.real, omega.imag, numpy.linalg.inv(omega.imag)
    return numpy.block([[y + x @ inverse @ x, -x @ inverse], [-inverse @ x, inverse]])


def siegel_distance(one, two):
    """Of two energies, as points of the Siegel upper half space; for genus 1 the hyperbolic plane."""
    lower = numpy.linalg.inv(numpy.linalg.cholesky(two))
    logarithms = numpy.log(numpy.linalg.eigvalsh(lower @ one @ lower.T))
    return math.sqrt(0.5 * (logarithms ** 2).sum())


def short_vectors(gram, bound):
    """Integer vectors x with x gram x <= bound, as rows."""
    upper = numpy.linalg.cholesky(gram).T
    found = []

    def choose(i, x, left):
        if i < 0:
            found.append(x)
            return
        centre = -(upper[i, i + 1:] @ x[i + 1:]) / upper[i, i]
        reach = math.sqrt(left) / upper[i, i]
        for k in range(math.ceil(centre - reach), math.floor(centre + reach) + 1):
            choose(i - 1, numpy.concatenate((x[:i], [k], x[i + 1:])),
                   max(0.0, left - (upper[i, i] * (k - centre)) ** 2))

    choose(len(gram) - 1, numpy.zeros(len(gram)), bound)
    return numpy.array(found)


def distance_within(one, two, radius):
    """The least siegel_distance() over all bases of one surface's homology, infinite where it is more
    than the radius. Vectors for the basis are chosen one by one. What has been chosen must have about
    the energies of the other surface: the eigenvalues of one against the other lie within the radius."""
    size = len(one)
    product = numpy.kron([[0, 1], [-1, 0]], numpy.eye(size // 2))
    candidates = short_vectors(one, math.exp(radius) * two.diagonal().max() + 1e-9)
    energies = candidates @ one
    best = math.inf

    def choose(basis):
        nonlocal best
        i = len(basis)
        if i == size:
            best = min(best, siegel_distance(basis @ one @ basis.T, two))
            return
        fits = (candidates @ product.T @ basis.T == product[:i, i]).all(axis=1)
        grams = numpy.empty((fits.sum(), i + 1, i + 1))
        grams[:, :i, :i] = basis @ one @ basis.T
        grams[:, i, :i] = grams[:, :i, i] = energies[fits] @ basis.T
        grams[:, i, i] = (energies * candidates).sum(axis=1)[fits]
        lower = numpy.linalg.inv(numpy.linalg.cholesky(two[:i + 1, :i + 1]))
        values = numpy.linalg.eigvalsh(lower @ grams @ lower.T)
        limit = math.exp(min(radius, best) + 1e-9)
        near = (values[:, 0] >= 1 / limit) & (values[:, -1] <= limit)
        for vector in candidates[fits][near]:
            choose(numpy.vstack((basis, vector)))

    choose(numpy.empty((0, size)))
    return best if best <= radius else math.inf


def period_distance(one, two):
    """Of two period matrices, over all bases, as text."""
    one, two = energy(one), energy(two)
    farthest = siegel_distance(one, two)  # in the bases that the filter has chosen
    limit = FARTHEST_SEARCH.get(len(one) // 2, 0.0)
    for share in (0.05, 0.2, 0.5, 1.0) if limit > 0 else ():
        distance = distance_within(one, two, share * limit)
        if math.isfinite(distance):
            return f"{distance:.6f}"
    return f"{farthest:.6f} at most"


def as_text(value):
    if isinstance(value, numpy.ndarray):
        return "; ".join(" ".join(f"{number:.6g}" for number in row) for row in value)
    return f"{value:.6g}"


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    shapes = [invariants(path) for path in sys.argv[1:]]
    for path, shape in zip(sys.argv[1:], shapes):
        print(path, " ".join(f"{key}={as_text(value)}" for key, value in shape.items()))
    one, two = shapes
    if one.keys() != two.keys() or any(one[k] != two[k] for k in ("genus", "boundary_loops")):
        print("different topology")
    elif "period_matrix" in one:
        matrices = [shape["period_matrix"] for shape in shapes]
        print(f"distance {period_distance(*matrices)}, "
              f"to the mirror image {period_distance(matrices[0], -matrices[1].conj())}; "
              f"the meshes' errors are {one['period_error']:.2g} and {two['period_error']:.2g}")
    elif len(one) > 2:
        key = list(one)[2]
        print(f"distance {abs(math.log(one[key] / two[key])):.6f}")
    elif one == {"genus": 0, "boundary_loops": 0}:
        print("distance 0: all closed surfaces of genus 0 are conformally equivalent")
    else:
        print("no invariants are computed for this topology")


if __name__ == "__main__":
    main()
