// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_LEAST_DISTORTION_H
#define RICCI_LEAST_DISTORTION_H

#include "../layout/flat_mesh.h"
#include "mean_distortion.h"

#include <Eigen/SparseCore>

namespace ricci {

/// What is near to the second derivative of a mean distortion E and easily inverted: with the
/// stiffness s of the triangles held fixed, E changes with the unknowns d like
/// sum s |f_zbar(d)|^2 = d^H N d. The real part of N is a cotangent Laplacian with the weights s of
/// the triangles: real, symmetric and positive definite, so that real and imaginary parts are solved
/// for alike. (The imaginary part vanishes inside where all s are equal.) Where a seam turns,
/// entries across it have the real part of that turn.
///
/// Systems are solved by conjugate gradients, preconditioned by symmetric Gauss-Seidel steps in
/// Eisenstat's form, which takes one pass over the matrix for both [Saad 2003, 9.2.2]. A few
/// iterations spread a step over as many rings of triangles, in time proportional to their number.
class DistortionLaplacian
{
public:
	/// \p energy must outlive it.
	explicit DistortionLaplacian(const MeanDistortion& energy);

	/// Takes the stiffness where the energy was last evaluated.
	/// \return false where a row has no positive diagonal
	bool factorize();

	/// x = matrix^-1 rhs, up to an error that leaves \p residual of what rhs is without x, both after
	/// one Gauss-Seidel step.
	/// \pre factorize() has returned true
	void solve(const Eigen::VectorXcd& rhs, Eigen::VectorXcd& x, double residual);

private:
	void solveForward(Eigen::VectorXcd& x) const;
	void solveBackward(Eigen::VectorXcd& x) const;

	const MeanDistortion& m_energy;
	const NumberedPoints& m_points;
	Array<Triangle> m_slot; // of the entry between corners k and k + 1, or -1

	// The matrix with rows and columns scaled so that its diagonal is 1: the entries below that. By
	// columns and by rows: both substitutions gather what they add up, which is faster than to scatter it.
	Eigen::SparseMatrix<double> m_below;
	Eigen::SparseMatrix<double, Eigen::RowMajor> m_belowByRows;
	Eigen::VectorXd m_scale; // of the rows

	Eigen::VectorXcd m_residual, m_direction, m_solved, m_product; // of solve()
};

/// Moves the points of a map to the plane so that the mean conformal distortion of the map on the mesh's own
/// straight triangles becomes small. A flow that flips edges finds the conformal map of the
/// surface; with straight triangles between its vertices, it is near to the best map of these triangles, not
/// the best one. No triangle that counts is flipped, the distortion never rises, and the two sides of every seam
/// stay isometric: the angles of the cones and the holonomy of the flat metric stay exactly what
/// they are (joinedPoints() says what moves, mean_distortion.h what is minimised).
///
/// All points move at once. Every step solves with a DistortionLaplacian for its direction, which limited-memory
/// BFGS improves by what the steps before have shown, as [Liu Bouaziz Kavan 2017] do for elastic bodies, and is
/// shortened until no triangle is flipped, by an exact test, and the distortion falls enough
/// [Nocedal Wright 2006, 3.1, 3.5]. A few iterations for the direction are enough: the flow's map is
/// wrong in the small, where triangles are bent, and solving Newton's equations takes as many steps,
/// each at several times the cost, for the weights change as fast as the points. The steps end when
/// what two in a row gain is not seen in a mean. All of it takes time in proportion to the triangles.
///
/// The same result to the bit with any number of threads.
/// \param flat one component. Triangles without area in the plane do not count.
/// If nothing stays, its size may change.
/// \param groups joinedPoints()
/// \param countsFlipped whether flipped triangles stay flipped, and count as reflected ones; else they do not count
/// It checks between steps whether the run has ended; then \p flat is what it was.
/// \return whether the bound on its steps has ended it: the distortion may become smaller still
/// \throw std::bad_alloc
bool leastDistortion(FlatMesh& flat, const PointGroups& groups, bool countsFlipped);

/// Moves the points of a map to the plane, so that its mean symmetric Dirichlet energy
/// |J|^2 + |J^-1|^2 by area, at its size, becomes small [Smith Schaefer 2015]: the map that trades angles for areas,
/// and stretches nothing much in any direction.
///
/// Newton's method with each triangle's Hessian made positive semidefinite [Smith de Goes Kim 2019]. Steps
/// are shortened until no triangle is flipped, by an exact test, and the energy falls enough. They end when
/// one gains less than a thousandth of what is above 4. A chart may cover itself afterwards.
/// \param flat one component. Its triangles that are not counter-clockwise do not count.
/// \param groups with joinedPoints() seams stay isometric; with allPoints() their two sides differ afterwards
/// \return whether the bound on its steps has ended it
bool leastStretch(FlatMesh& flat, const PointGroups& groups);

} // namespace ricci

#endif
