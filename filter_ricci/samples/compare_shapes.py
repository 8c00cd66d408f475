# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares two shapes by their conformal invariants: compare_shapes.py MESH MESH.

Two surfaces are conformally equivalent only if their invariants agree: the modulus tau of tori (in
the fundamental domain of the modular group; a mirror image has -conj(tau)), the modulus of annuli,
the aspect of disks with four corners, which are the selected vertices of the file or those that
the filter chooses. Size, place and pose do not matter, and a bend without stretch changes nothing.
Closed surfaces of genus 0 are all equivalent.
With pip install pymeshlab_ricci-*.whl.
"""

import math
import sys

from pymeshlab import MeshSet
from pymeshlab_ricci import flatten


def invariants(path):
    """Topology and invariants of the mesh in a file."""
    documents = MeshSet()
    documents.load_new_mesh(path)
    shape = documents.get_topological_measures()
    if shape["connected_components_number"] != 1:
        sys.exit(f"{path} has several components: separate them first.")
    found = {"genus": shape["genus"], "boundary_loops": shape["number_holes"]}
    targets = {(0, 1): "Rectangle", (0, 2): "Flat everywhere", (1, 0): "Flat everywhere"}
    target = targets.get(tuple(found.values()))
    if target:
        results = flatten(documents, target_curvature=target).results
        keys = ("torus_tau_re", "torus_tau_im", "annulus_modulus", "rectangle_aspect")
        found.update({key: results[key] for key in keys if key in results})
    return found


def hyperbolic_distance(one, two):
    """Of two points of the upper half plane: the distance of two tori in their moduli space, as long
    as both lie well inside the fundamental domain."""
    return math.acosh(1 + abs(one - two) ** 2 / (2 * one.imag * two.imag))


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    shapes = [invariants(path) for path in sys.argv[1:]]
    for path, shape in zip(sys.argv[1:], shapes):
        print(path, " ".join(f"{key}={value:.6g}" for key, value in shape.items()))
    one, two = shapes
    if one.keys() != two.keys() or any(one[k] != two[k] for k in ("genus", "boundary_loops")):
        print("different topology")
    elif "torus_tau_im" in one:
        tau = [complex(s["torus_tau_re"], s["torus_tau_im"]) for s in shapes]
        print(f"distance {hyperbolic_distance(*tau):.6f}, "
              f"to the mirror image {hyperbolic_distance(tau[0], -tau[1].conjugate()):.6f}")
    elif len(one) > 2:
        key = list(one)[2]
        print(f"distance {abs(math.log(one[key] / two[key])):.6f}")
    elif one == {"genus": 0, "boundary_loops": 0}:
        print("distance 0: all closed surfaces of genus 0 are conformally equivalent")
    else:
        print("no invariants are computed for this topology")


if __name__ == "__main__":
    main()
