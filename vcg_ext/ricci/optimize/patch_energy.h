// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_PATCH_ENERGY_H
#define RICCI_PATCH_ENERGY_H

#include "../layout/flat_mesh.h"
#include "../numerics/sparse_cholesky.h"
#include "patches.h"
#include "point_groups.h"

#include <Eigen/Core>

#include <array>
#include <complex>
#include <vector>

namespace ricci {

/// What is asked of the triangles of a patch. J is the linear map from the rest shape of a triangle, w its
/// area.
enum class PatchCost {
	Untangling,        ///< see untangle()
	SymmetricDirichlet ///< w |J|^2 (1 + 1 / det^2 J), 4 w for a rotation; infinite if flipped
};

/// The energy of a patch as a function of the displacements of its variables, two numbers for each.
class PatchEnergy
{
public:
	PatchEnergy(
		const FlatMesh& flat,
		const PointGroups& groups,
		const Patch& patch,
		const std::vector<TriangleShape>& shapes,
		PatchCost cost = PatchCost::Untangling);

	int size() const { return m_size; }

	/// Multiplies the weight of a triangle, by 0 if it is not to count.
	void stress(int triangle, double factor) { m_elements[positionOf(triangle)].weight *= factor; }

	double minDeterminant(const Eigen::VectorXd& x) const;

	/// \param eps of untangle()
	double value(const Eigen::VectorXd& x, double eps) const;

	/// Newton's step with the projected Hessian.
	/// \return false where the Hessian cannot be factored
	bool newtonStep(
		const Eigen::VectorXd& x, double eps, Eigen::VectorXd& gradient, Eigen::VectorXd& step);

private:
	using Complex = std::complex<double>;

	/// A triangle's map from its rest shape: f_z = z0 + sum c v, f_zbar = w0 + sum e v over its corners
	/// with displacements v of their variables.
	struct Element
	{
		Complex z0, w0;
		std::array<Complex, 3> c, e;
		std::array<int, 3> variable; // -1: does not move
		double weight;
	};

	/// Where the entries of a block of two by two are in a matrix.
	using Slots = std::array<Eigen::Index, 4>;

	static std::array<Complex, 2> mapAt(const Element& element, const Eigen::VectorXd& x);
	const Slots*
	add(const Element& element,
		const Eigen::VectorXd& x,
		double eps,
		Eigen::VectorXd& gradient,
		const Slots* slot);
	void addBlock(const Slots& slot, bool diagonal, Complex s, Complex t);
	double& diagonal(int column);
	void layOutMatrix();

	int m_size; // two for each variable
	PatchCost m_cost;
	std::vector<Element> m_elements;
	SparseCholesky::Matrix m_hessian; // lower triangle
	std::vector<Slots> m_slots;       // in the order of the triangles
	SparseCholesky m_solver;
};

/// The energy of a triangle with eps = 0 over its weight and least value: 1 for the rest shape, large
/// for one that is stretched out or flat; infinite where it is not counter-clockwise.
double strain(const TriangleShape& shape, const Triangle2& plane);

} // namespace ricci

#endif
