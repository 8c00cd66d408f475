// SPDX-License-Identifier: GPL-3.0-or-later
// Flattens a mesh of vcglib, a dodecahedron, and prints its wedge texture coordinates.
#include <vcg/complex/algorithms/create/platonic.h>
#include <vcg/complex/algorithms/parametrization/ricci_flow.h>

#include <cstdio>

class Vertex;
class Face;
using Types = vcg::UsedTypes<vcg::Use<Vertex>::AsVertexType, vcg::Use<Face>::AsFaceType>;
class Vertex :
		public vcg::
			Vertex<Types, vcg::vertex::Coord3d, vcg::vertex::Qualityd, vcg::vertex::BitFlags>
{
};
class Face :
		public vcg::
			Face<Types, vcg::face::VertexRef, vcg::face::WedgeTexCoord2f, vcg::face::BitFlags>
{
};
using Mesh = vcg::tri::TriMesh<std::vector<Vertex>, std::vector<Face>>;

int main()
{
	using Flow = vcg::tri::RicciFlow<Mesh>;
	Mesh mesh;
	vcg::tri::Dodecahedron(mesh);
	try {
		const Flow::Result map = Flow::Compute(mesh, Flow::Params());
		Flow::WriteWedgeTexCoord(mesh, map);
		for (Face& face : mesh.face)
			for (int k = 0; k < 3; ++k)
				std::printf("%g %g\n", face.WT(k).U(), face.WT(k).V());
		std::printf("%zu charts, distortion %g\n", map.charts.size(), map.report.qcAreaMean);
	}
	catch (const ricci::Error& error) {
		std::fprintf(stderr, "%s\n", error.what());
		return 1;
	}
}
