# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares two shapes by their conformal invariants. one_mesh.py has to lie beside this file.

    python compare_shapes.py PLUGIN MESH MESH

Two surfaces are conformally equivalent only if their invariants agree: the modulus tau of tori (in
the fundamental domain of the modular group; a mirror image has -conj(tau)), the modulus of annuli,
the aspect of disks with four corners, which are the selected vertices of the file or those that the
filter chooses. Size, place and pose do not matter, and a bend without stretch changes nothing. Closed
surfaces of genus 0 are all equivalent.
"""

import math
import sys

import pymeshlab

from one_mesh import FILTER


def invariants(path):
    """Topology and invariants of the mesh in a file."""
    documents = pymeshlab.MeshSet(verbose=False)
    documents.load_new_mesh(path)
    shape = documents.get_topological_measures()
    if shape["connected_components_number"] != 1:
        sys.exit(f"{path} has several components: separate them first.")
    genus, loops = shape["genus"], shape["number_holes"]
    if (genus, loops) == (0, 0):
        return {"genus": genus, "boundary_loops": loops}
    target = "Rectangle" if (genus, loops) == (0, 1) else "Automatic"
    result = documents.apply_filter(FILTER, target_curvature=target)
    keys = ("torus_tau_re", "torus_tau_im", "annulus_modulus", "rectangle_aspect")
    return {"genus": genus, "boundary_loops": loops,
            **{key: result[key] for key in keys if key in result}}


def hyperbolic_distance(one, two):
    """Of two points of the upper half plane: the distance of two tori in their moduli space, as long
    as both lie well inside the fundamental domain."""
    return math.acosh(1 + abs(one - two) ** 2 / (2 * one.imag * two.imag))


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    pymeshlab.load_plugin(sys.argv[1])
    shapes = [invariants(path) for path in sys.argv[2:]]
    for path, shape in zip(sys.argv[2:], shapes):
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
