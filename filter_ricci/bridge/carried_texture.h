// SPDX-License-Identifier: GPL-3.0-or-later
// The parameters "carry_texture" and "texture_size": what the mesh shows at its old texture coordinates,
// drawn as one picture for the new ones.
#ifndef FILTER_RICCI_CARRIED_TEXTURE_H
#define FILTER_RICCI_CARRIED_TEXTURE_H

#include "bridge.h"
#include "output_file.h"

#include <ricci/base/task.h>
#include <ricci/texture/carry_texture.h>

#include <vcg/complex/algorithms/parametrization/ricci_flow.h>

#include <array>
#include <string>
#include <vector>

namespace filter_ricci {

/// A run's new texture. Before publish() no file has changed, before assignTo() no mesh.
class CarriedTexture
{
public:
	/// Loads the textures that the mesh has, and finds the new file writable.
	/// \throw Refusal if anything is missing; nothing has been written then
	CarriedTexture(const TextureSettings& settings, const MeshModel& model);

	/// Otherwise the functions below do nothing.
	bool isWanted() const { return m_file.isWanted(); }

	/// Width and height, in texels.
	int size() const { return m_size; }

	/// Share of the square that charts must be apart, so that the gutters of two fit between them; for
	/// small pictures less, so that charts keep most of the room.
	double minMargin() const;

	/// Draws the picture into memory and adds its result.
	/// \throw ricci::Stopped, std::bad_alloc
	void draw(const ricci::Parametrization& result, Results& results);

	/// Writes the file beside its place, where the host writes pictures.
	/// \throw Refusal if there is no room for it, ricci::Stopped
	void write();

	/// Moves the written file to its place.
	/// \throw Refusal if that cannot be done
	void publish();

	/// Makes it the only texture of a mesh. What faces without a texture showed is in it, so their own colours become
	/// white: files of materials multiply the texture by them. Others keep this tint.
	/// \param origin [face] that it is a piece of
	void assignTo(MeshModel& model, const std::vector<int>& origin) const;

private:
	void readFaces(const MeshModel& model);
	void loadPictures(const MeshModel& model);
	void requireMemory() const;

	std::vector<std::array<int, 2>> pictureSizes() const;
	void fitSize();
	void takeTriangles(const ricci::Parametrization& result);
	void convertPictures();
	template<class Sample>
	void drawSamples();
	void describe(Results& results) const;

	OutputFile m_file;
	std::string m_name;  ///< that the mesh gets
	int m_size = 0;      ///< if it is to fit, the least that it may become before the map is known
	bool m_fits = false; ///< it is to have texels as fine as the old ones
	ricci::CarriedMesh m_mesh;   // its faces are those of the mesh, its triangles those of the map
	std::vector<double> m_areas; // [face]
	std::vector<char> m_hasPicture;        // [face]
	std::vector<host::Picture> m_pictures; // [texture of the mesh] null where no face has it
	bool m_hasAlpha = false, m_hasWords = false;
	int m_uncoloured = 0; ///< faces with neither texture nor colour
	host::Picture m_result;
};

} // namespace filter_ricci

#endif
