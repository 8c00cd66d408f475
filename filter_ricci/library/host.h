// SPDX-License-Identifier: GPL-3.0-or-later
// The library as the bridge sees it: a mesh of vcglib with what the bridge needs of PyMeshLab's, so that both give the
// same numbers, and documents of such meshes.
#ifndef FILTER_RICCI_HOST_H
#define FILTER_RICCI_HOST_H

#include "picture.h"

#include <vcg/complex/complex.h>
#include <vcg/math/matrix44.h>

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

class CVertexO;
class CEdgeO;
class CFaceO;
class CUsedTypesO :
		public vcg::UsedTypes<
			vcg::Use<CVertexO>::AsVertexType,
			vcg::Use<CEdgeO>::AsEdgeType,
			vcg::Use<CFaceO>::AsFaceType>
{
};
class CVertexO :
		public vcg::Vertex<
			CUsedTypesO,
			vcg::vertex::Coord3d,
			vcg::vertex::BitFlags,
			vcg::vertex::Normal3d,
			vcg::vertex::Qualityd,
			vcg::vertex::Color4b>
{
};
class CEdgeO : public vcg::Edge<CUsedTypesO, vcg::edge::BitFlags, vcg::edge::VertexRef>
{
};
class CFaceO :
		public vcg::Face<
			CUsedTypesO,
			vcg::face::InfoOcf,
			vcg::face::VertexRef,
			vcg::face::BitFlags,
			vcg::face::Normal3d,
			vcg::face::Color4bOcf,
			vcg::face::WedgeTexCoordfOcf>
{
};

using Scalarm = double;
using Box3m = vcg::Box3d;

class CMeshO : public vcg::tri::TriMesh<std::vector<CVertexO>, vcg::face::vector_ocf<CFaceO>>
{
public:
	CMeshO() { Tr.SetIdentity(); }
	~CMeshO() override { ClearAttributes(); } // vcglib leaves them behind

	/// As the matrix moves it.
	Box3m trBB() const
	{
		Box3m box;
		box.Add(Tr, bbox);
		return box;
	}

	vcg::Matrix44d Tr;
};

class MeshModel
{
public:
	/// Only colours and texture coordinates take memory that not every mesh has.
	enum MeshElement {
		MM_VERTNUMBER = 1,
		MM_VERTQUALITY = 2,
		MM_VERTCOLOR = 4,
		MM_VERTTEXCOORD = 8,
		MM_VERTFACETOPO = 16,
		MM_FACENUMBER = 32,
		MM_FACECOLOR = 64,
		MM_FACEFACETOPO = 128,
		MM_WEDGTEXCOORD = 256
	};

	bool hasDataMask(int elements) const { return (m_has & elements) == elements; }

	void updateDataMask(int elements)
	{
		if ((elements & MM_WEDGTEXCOORD) != 0)
			cm.face.EnableWedgeTexCoord();
		if ((elements & MM_FACECOLOR) != 0)
			cm.face.EnableColor();
		m_has |= elements;
	}

	/// Of elements that take no memory.
	void clearDataMask(int elements) { m_has &= ~elements; }

	CMeshO cm;
	std::string label, name, folder;
	std::vector<filter_ricci::host::Picture> pictures; ///< [texture of cm]
	std::vector<int> parts;                            ///< [vertex] ricci::SurfaceMesh::part

private:
	int m_has = 0;
};

/// The first mesh is the current one.
struct MeshDocument
{
	MeshModel* mm() { return meshes.empty() ? nullptr : meshes.front().get(); }

	std::vector<std::unique_ptr<MeshModel>> meshes;
};

namespace filter_ricci::host {

/// There is nothing to look at.
constexpr const char* kHistogramName = "";

inline bool hasWindow()
{
	return false;
}

inline MeshModel* addMesh(MeshDocument& md, const std::string& label)
{
	md.meshes.push_back(std::make_unique<MeshModel>());
	md.meshes.back()->label = label;
	return md.meshes.back().get();
}

inline void removeMesh(MeshDocument& md, const MeshModel* mesh)
{
	for (auto i = md.meshes.begin(); i != md.meshes.end(); ++i)
		if (i->get() == mesh) {
			md.meshes.erase(i);
			return;
		}
}

inline const std::string& label(const MeshModel& model)
{
	return model.label;
}

inline const std::string& name(const MeshModel& model)
{
	return model.name;
}

inline const std::string& folder(const MeshModel& model)
{
	return model.folder;
}

inline const std::vector<int>& parts(const MeshModel& model)
{
	return model.parts;
}

/// A layer shows the pictures of the mesh: there is no need of copies.
inline void copyTextures(const MeshModel&, MeshModel&)
{
}

/// Null for a picture that could not be loaded.
inline Picture texture(const MeshModel& model, const std::string& name)
{
	for (std::size_t i = 0; i < model.pictures.size(); ++i)
		if (model.cm.textures[i] == name)
			return model.pictures[i];
	return Picture();
}

inline void setTexture(MeshModel& model, const std::string& name, const Picture& picture)
{
	model.cm.textures.assign(1, name);
	model.pictures.assign(1, picture);
}

inline std::string
textureName(const std::filesystem::path& path, const std::filesystem::path& /*folder*/)
{
	return path.filename().u8string();
}

} // namespace filter_ricci::host

#endif
