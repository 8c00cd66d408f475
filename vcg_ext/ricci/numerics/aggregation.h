// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_AGGREGATION_H
#define RICCI_AGGREGATION_H

#include "../base/indexed.h"

#include <Eigen/SparseCore>

namespace ricci {

/// Rows of a sparse matrix taken together.
struct Aggregation
{
	Array<int> aggregate; ///< [row]
	Array<int> root;      ///< [aggregate] the row that it grew from

	/// Takes values by row to their sums by aggregate.
	Eigen::SparseMatrix<double> sums() const;
};

/// Takes a row and its neighbours together wherever none of them is in an aggregate yet; then adds
/// every row that is left to the neighbouring aggregate with the largest entry
/// [Vanek Mandel Brezina 1996, Algorithm 2]. On a triangulation, aggregates have about seven rows.
/// \param matrix symmetric with positive diagonal, both triangles stored; off-diagonal entries that
/// are not negative make no neighbours
Aggregation aggregated(const Eigen::SparseMatrix<double>& matrix);

} // namespace ricci

#endif
