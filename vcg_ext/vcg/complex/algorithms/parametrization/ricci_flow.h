// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef __VCGLIB_RICCI_FLOW
#define __VCGLIB_RICCI_FLOW
#include <ricci/options.h>
#include <ricci/progress.h>
#include <ricci/report.h>
#include <array>
#include <string>
#include <vector>

namespace vcg {
namespace tri {

template<class MeshType>
class RicciFlow
{
public:
	struct Params : public ricci::Options
	{
		bool normalizeUV = true; ///< fit the charts into [0,1]^2; false: keep the metric's own scale
	};

	/// Everything that a run computed, indexed like the mesh's face and vertex vectors (deleted
	/// elements included, their entries meaningless).
	struct Result
	{
		ricci::Report                                        report;
		std::vector<std::string>                             notes;   ///< sentences for the log: what was done automatically
		std::vector<std::array<std::array<double, 2>, 3>>    wedgeUV; ///< [face][corner] packed, normalised if asked
		std::vector<double>                                  vertexQC;
		std::vector<double>                                  u;       ///< log-radius
		std::vector<double>                                  targetCurvature;
	};

	/// Computes; \p m is not changed in any way.
	static Result Compute(const MeshType& m, const Params& par, ricci::Progress& progress);
	/// Writes wedge UVs (texture index 0); the mesh must have wedge texcoords enabled.
	static void WriteWedgeTexCoord(MeshType& m, const Result& r);
	/// Writes the QC distortion as vertex quality and the attributes ricci_u (and, for
	/// TargetCurvature::Prescribed, ricci_target_curvature).
	static void WriteVertexQuality(MeshType& m, const Result& r);
	/// Fills the empty mesh \p flat with one vertex per (vertex, chart sector), placed at its UV, z = 0,
	/// with the wedge UVs and qualities of the result.
	static void BuildFlatMesh(const MeshType& m, const Result& r, MeshType& flat);
};

}
}
#endif
