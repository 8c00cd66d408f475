// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_file.h"

#include "vcg_mesh.h"

#include <wrap/io_trimesh/import.h>

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

} // namespace ricci::testing
