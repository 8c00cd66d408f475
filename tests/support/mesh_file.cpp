// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_file.h"

#include "vcg_mesh.h"

#include <wrap/io_trimesh/import.h>

#include <cstdio>
#include <memory>
#include <stdexcept>

namespace ricci::testing {

SurfaceMesh readMesh(const std::string& path)
{
	using Importer = vcg::tri::io::Importer<DoubleMesh>;
	DoubleMesh mesh;
	const int status = Importer::Open(mesh, path.c_str());
	if (Importer::ErrorCritical(status))
		throw std::runtime_error(path + ": " + Importer::ErrorMsg(status));
	return fromVcg(mesh);
}

void writeObj(
	const std::string& path, const SurfaceMesh& mesh, const std::vector<std::array<Point2, 3>>& uv)
{
	std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(
		std::fopen(path.c_str(), "w"), std::fclose);
	if (!file)
		throw std::runtime_error("Cannot write " + path + ".");
	for (const Point3& p : mesh.positions)
		std::fprintf(file.get(), "v %.17g %.17g %.17g\n", p[0], p[1], p[2]);
	for (const std::array<Point2, 3>& corners : uv)
		for (const Point2& p : corners)
			std::fprintf(file.get(), "vt %.17g %.17g\n", p[0], p[1]);
	for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
		std::fputc('f', file.get());
		for (std::size_t k = 0; k < 3; ++k)
			std::fprintf(file.get(), " %d/%zu", mesh.triangles[f][k] + 1, 3 * f + k + 1);
		std::fputc('\n', file.get());
	}
	if (std::ferror(file.get()))
		throw std::runtime_error("Cannot write all of " + path + ".");
}

} // namespace ricci::testing
