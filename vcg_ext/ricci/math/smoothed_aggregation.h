// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_SMOOTHED_AGGREGATION_H
#define RICCI_SMOOTHED_AGGREGATION_H

#include "../base/indexed.h"

#include <Eigen/SparseCore>

namespace ricci {

/// Neighbouring rows of a sparse symmetric matrix taken together, and a space of functions with one
/// degree of freedom for each such aggregate, in which the smooth functions among all are
/// approximated well: smoothed aggregation [Vanek Mandel Brezina 1996].
struct Aggregation
{
	Array<int> aggregate; ///< [row]
	Array<int> root;      ///< [aggregate] the row that it grew from
	/// Rows by aggregates: the values of a function from its degrees of freedom. A row adds up to 1
	/// where that of the matrix adds up to 0.
	Eigen::SparseMatrix<double> prolongation;
};

/// Takes a row and its neighbours together wherever none of them is in an aggregate yet, and adds
/// every row that is left to the neighbouring aggregate with the largest entry. In two dimensions an
/// aggregate has about seven rows.
/// \param matrix symmetric with positive diagonal, both triangles stored; its off-diagonal entries
/// are not positive, but for small ones
Aggregation aggregated(const Eigen::SparseMatrix<double>& matrix);

} // namespace ricci

#endif
