// SPDX-License-Identifier: GPL-3.0-or-later
#include "carried_texture.h"

#include "error_sentences.h"
#include "free_memory.h"

#include <ricci/base/indexed.h>
#include <ricci/base/numbers.h>
#include <ricci/base/parallel.h>
#include <ricci/measure/distortion.h>
#include <ricci/texture/old_charts.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>

namespace filter_ricci {

namespace {

using Flow = vcg::tri::RicciFlow<CMeshO>;

/// Gutters take no more of the side of the square than this for one margin.
constexpr double kMaxMargin = 0.05;

/// Names that files of meshes keep: PLY drops all other letters from names of textures.
bool isKeptByFiles(const std::string& name)
{
	return std::all_of(name.begin(), name.end(), [](char c) { return c > 32 && c < 125; });
}

std::array<float, 4> asColour(const vcg::Color4b& c)
{
	return {c[0] / 255.0f, c[1] / 255.0f, c[2] / 255.0f, c[3] / 255.0f};
}

double texels(const host::Picture& image)
{
	return static_cast<double>(image.width()) * image.height();
}

/// Whether writing to \p path could overwrite \p old, sooner or later: hosts may know a texture by its
/// bare name, and write it by that name when the mesh is saved.
bool mayOverwrite(const std::filesystem::path& path, const std::filesystem::path& old)
{
	std::error_code isMissing;
	if (std::filesystem::equivalent(path, old, isMissing)) // links lead to one file
		return true;
	return lower(path.filename().u8string()) == lower(old.filename().u8string());
}

/// Barycentric coordinates of a point in a face of the mesh.
ricci::Point3 inFace(const ricci::SurfacePoint& p, const ricci::Triangle& face)
{
	ricci::Point3 weights{0, 0, 0};
	double sum = 0.0;
	for (std::size_t i = 0; i < 4; ++i)
		for (std::size_t k = 0; k < 3; ++k)
			if (p.weight[i] != 0.0 && p.vertex[i] == face[k]) {
				weights[k] += p.weight[i];
				sum += p.weight[i];
				break;
			}
	for (double& w : weights)
		w = sum > 0.0 ? w / sum : 1.0 / 3.0;
	return weights;
}

} // namespace

CarriedTexture::CarriedTexture(const TextureSettings& settings, const MeshModel& model)
{
	const std::string& wanted = settings.file;
	if (wanted.empty())
		return;
	const std::string shown = "The texture " + wanted + " cannot be written";
	const std::string folder = host::folder(model);
	const std::filesystem::path path = absolutePath(wanted, folder);
	if (endingOf(path) != "png")
		throw Refusal(shown + ": its name must end in .png.");
	m_name = host::textureName(path, absolutePath("", folder));
	if (!isKeptByFiles(m_name))
		throw Refusal(
			shown + ": mesh files cannot hold spaces, } or ~, or letters beyond ASCII in the names "
					"and folders of textures. Choose another name or folder.");
	m_size = settings.size;
	readFaces(model);
	for (const std::string& old : model.cm.textures)
		if (mayOverwrite(path, absolutePath(old, folder)))
			throw Refusal(
				shown + ": it has the name of a texture of the mesh. Choose another name.");
	loadPictures(model);
	if (m_size == 0)
		fitSize();
	OutputFile file(path, "The texture");
	requireMemory();
	m_file = std::move(file);
}

void CarriedTexture::readFaces(const MeshModel& model)
{
	const CMeshO& m = model.cm;
	const bool wedges = vcg::tri::HasPerWedgeTexCoord(m);
	const bool places = wedges || vcg::tri::HasPerVertexTexCoord(m);
	const bool vertexColours = model.hasDataMask(MeshModel::MM_VERTCOLOR);
	const bool faceColours = vcg::tri::HasPerFaceColor(m);
	m_mesh.faces.resize(m.face.size());
	m_areas.resize(m.face.size(), 0.0);
	m_hasPicture.resize(m.face.size(), 0);
	m_pictures.resize(m.textures.size());
	bool any = false;
	for (std::size_t f = 0; f < m.face.size(); ++f) {
		const CFaceO& face = m.face[f];
		ricci::TexturedFace& to = m_mesh.faces[f];
		if (face.IsD() || !Flow::HasItsVertices(m, face))
			continue; // damaged ones, which the run will refuse
		m_areas[f] = ricci::triangleArea(
			{Flow::PlaceOf(m, *face.cV(0)),
			 Flow::PlaceOf(m, *face.cV(1)),
			 Flow::PlaceOf(m, *face.cV(2))});
		int texture = -1;
		for (std::size_t k = 0; k < 3; ++k) {
			const int corner = static_cast<int>(k);
			to.vertices[k] = static_cast<int>(vcg::tri::Index(m, face.cV(corner)));
			if (places) {
				const auto& at = wedges ? face.cWT(corner) : face.cV(corner)->cT();
				to.uv[k] = {static_cast<double>(at.U()), static_cast<double>(at.V())};
				texture = k == 0 ? at.N() : texture;
			}
			to.colour[k] = {1, 1, 1, 1};
			if (vertexColours)
				to.colour[k] = asColour(face.cV(corner)->cC());
			else if (faceColours)
				to.colour[k] = asColour(face.cC());
		}
		const int count = static_cast<int>(m.textures.size());
		if (places && !wedges && count > 0 && (texture < 0 || texture >= count))
			texture = 0; // files give vertices no number of a texture
		if (texture >= 0 && texture < count)
			to.picture = texture;
		else if (vertexColours || faceColours)
			for (const std::array<float, 4>& colour : to.colour)
				m_hasAlpha = m_hasAlpha || colour[3] < 1.0f;
		else
			++m_uncoloured;
		m_hasPicture[f] = to.picture >= 0 ? 1 : 0;
		any = any || to.picture >= 0 || vertexColours || faceColours;
	}
	if (!any)
		throw Refusal(
			m.textures.empty()
				? "{carry_texture} needs something to draw, but the mesh has neither a texture nor "
				  "colours."
			: places
				? "{carry_texture} needs something to draw, but no face of the mesh has one of "
				  "its textures, and there are no colours."
				: "{carry_texture} needs old texture coordinates, but the mesh has none, and no "
				  "colours either.");
}

void CarriedTexture::loadPictures(const MeshModel& model)
{
	for (const ricci::TexturedFace& face : m_mesh.faces) {
		if (face.picture < 0 || !m_pictures[ricci::positionOf(face.picture)].isNull())
			continue;
		const std::string& name = model.cm.textures[ricci::positionOf(face.picture)];
		host::Picture image = host::texture(model, name);
		if (image.isNull())
			throw Refusal(
				"The texture " + name +
				" of the mesh cannot be loaded: put its file beside the mesh and open the mesh "
				"again, or leave {carry_texture} empty.");
		m_hasAlpha = m_hasAlpha || image.hasAlpha();
		m_hasWords = m_hasWords || image.hasWords();
		m_pictures[ricci::positionOf(face.picture)] = std::move(image);
	}
}

std::vector<std::array<int, 2>> CarriedTexture::pictureSizes() const
{
	std::vector<std::array<int, 2>> sizes;
	for (const host::Picture& picture : m_pictures)
		sizes.push_back({picture.width(), picture.height()});
	return sizes;
}

/// The side of a square of as many texels as the faces have now: a map fills no square.
void CarriedTexture::fitSize()
{
	double count = 0.0;
	for (const ricci::TexturedFace& face : m_mesh.faces)
		if (face.picture >= 0) {
			const host::Picture& picture = m_pictures[ricci::positionOf(face.picture)];
			const ricci::Triangle2 t = ricci::oldTexels(face, picture.width(), picture.height());
			count += 0.5 * std::abs(ricci::doubledArea(t[0], t[1], t[2]));
		}
	m_fits = count > 0.0;
	m_size = m_fits ? static_cast<int>(std::clamp(
						  std::ceil(std::sqrt(count)),
						  static_cast<double>(kMinTextureSize),
						  static_cast<double>(kMaxTextureSize)))
					: TextureSettings().size;
}

void CarriedTexture::requireMemory() const
{
	const double sample = m_hasWords ? 8.0 : 4.0, square = static_cast<double>(m_size) * m_size;
	double largest = 0.0, all = 0.0;
	for (const host::Picture& picture : m_pictures) {
		largest = std::max(largest, texels(picture));
		all += texels(picture);
	}
	const double needed = (sample + 4.0) * square + sample * all +
						  std::max(square, ricci::kBytesOfOldTexel * largest) +
						  512.0 * static_cast<double>(m_mesh.faces.size());
	const double free = freeMemory();
	if (free > 0.0 && needed > free)
		throw Refusal(
			"{texture_size} " + std::to_string(m_size) + " needs about " +
			ricci::numberText(needed / 1e9, 2) + " GB of memory for this mesh, but " +
			ricci::numberText(free / 1e9, 2) + " GB are free: choose a smaller one.");
}

double CarriedTexture::minMargin() const
{
	return isWanted() ? std::min(2.0 * ricci::kGutterTexels / m_size, kMaxMargin) : 0.0;
}

void CarriedTexture::takeTriangles(const ricci::Parametrization& result)
{
	const ricci::FlatMesh& map = result.mesh;
	m_mesh.triangles.reserve(ricci::positionOf(map.size()));
	for (const int f : map.points.indices()) {
		ricci::CarriedTriangle triangle;
		triangle.uv = map.at(f);
		triangle.face = map.face[f];
		for (std::size_t k = 0; k < 3; ++k)
			triangle.corners[k] = inFace(
				map.source[map.vertices[f][k]],
				m_mesh.faces[ricci::positionOf(triangle.face)].vertices);
		m_mesh.triangles.push_back(triangle);
	}
}

void CarriedTexture::convertPictures()
{
	const auto first = std::find_if(m_pictures.begin(), m_pictures.end(), [](const auto& picture) {
		return !picture.isNull();
	});
	m_result = host::Picture(
		m_size, m_hasWords, m_hasAlpha, first == m_pictures.end() ? nullptr : &*first);
	for (host::Picture& picture : m_pictures) {
		ricci::checkpoint();
		if (!picture.isNull())
			picture.convertFor(m_result);
	}
}

template<class Sample>
void CarriedTexture::drawSamples()
{
	std::vector<ricci::PictureView<const Sample>> views;
	for (const host::Picture& picture : m_pictures)
		views.push_back(
			{picture.width(), picture.height(), static_cast<const Sample*>(picture.samples())});
	ricci::carryTexture<Sample>(
		m_mesh,
		views,
		m_hasAlpha,
		{m_size, m_size, static_cast<Sample*>(m_result.samples())},
		ricci::defaultThreads());
}

void CarriedTexture::describe(Results& results) const
{
	int count = 0;
	for (const host::Picture& picture : m_pictures)
		count += picture.isNull() ? 0 : 1;
	const std::string side = std::to_string(m_size);
	std::string line = "Texture: " + m_file.name() + ", " + side + " x " + side + " texels";
	const ricci::TexelDensity density =
		ricci::texelDensity(m_mesh, m_areas, pictureSizes(), m_size);
	if (density.ratio > 0.0) {
		line += ", from " + std::to_string(count) + (count == 1 ? " image. " : " images. ") +
				ricci::numberText(density.before, 4) + " texels per unit of length before, " +
				ricci::numberText(density.after, 4) + " after";
		results.push_back(
			{"texture_scale", density.ratio, "Texels per unit of length, new over old"});
	}
	else
		line += ", from the colours of the mesh";
	if (m_uncoloured > 0)
		line += "; " + std::to_string(m_uncoloured) +
				(m_uncoloured == 1 ? " face has neither a texture nor a colour: it is white"
								   : " faces have neither a texture nor a colour: they are white");
	ricci::logLine(line + ".");
}

void CarriedTexture::draw(const ricci::Parametrization& result, Results& results)
{
	if (!isWanted())
		return;
	const ricci::DefaultFloatingPoint defaultEnvironment;
	ricci::advance(0.0, "Drawing the texture");
	takeTriangles(result);
	if (m_fits) {
		const double ratio = ricci::texelDensity(m_mesh, m_areas, pictureSizes(), m_size).ratio;
		if (ratio > 0.0)
			m_size = static_cast<int>(std::clamp(
				std::ceil(m_size / ratio),
				static_cast<double>(m_size),
				static_cast<double>(kMaxTextureSize)));
		requireMemory();
	}
	convertPictures();
	if (m_hasWords)
		drawSamples<unsigned short>();
	else
		drawSamples<unsigned char>();
	ricci::advance(1.0, "Drawing the texture");
	describe(results);
	if (result.report.overlappingCharts > 0)
		ricci::logLine("Texture: where charts overlap, it shows only one of the faces.");
	m_mesh = {};
	m_pictures.clear();
}

void CarriedTexture::write()
{
	if (!isWanted())
		return;
	double bytes = 0.0;
	const double expected =
		0.25 * (m_hasWords ? 8.0 : 4.0) * static_cast<double>(m_size) * m_size; // roughly
	const bool isDone = m_result.writePng([&](const char* data, std::size_t size) {
		bytes += static_cast<double>(size);
		ricci::advance(bytes / (bytes + expected), "Writing the texture");
		m_file.write({data, size});
	});
	if (!isDone)
		m_file.refuse(kDiskFull);
}

void CarriedTexture::publish()
{
	m_file.publish();
}

void CarriedTexture::assignTo(MeshModel& model, const std::vector<int>& origin) const
{
	if (!isWanted())
		return;
	host::setTexture(model, m_name, m_result);
	// Coordinates of vertices, where there are some, belong to the old textures.
	model.clearDataMask(MeshModel::MM_VERTTEXCOORD);
	if (vcg::tri::HasPerFaceColor(model.cm))
		for (std::size_t f = 0; f < origin.size(); ++f)
			if (m_hasPicture[ricci::positionOf(origin[f])] == 0)
				model.cm.face[f].C() = vcg::Color4b(vcg::Color4b::White);
}

} // namespace filter_ricci
