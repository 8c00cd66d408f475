// SPDX-License-Identifier: GPL-3.0-or-later
#include "carried_texture.h"

#include "error_sentences.h"
#include "free_memory.h"
#include "output_path.h"

#include <ricci/base/indexed.h>
#include <ricci/base/numbers.h>
#include <ricci/base/parallel.h>
#include <ricci/measure/distortion.h>
#include <ricci/texture/old_charts.h>

#include <vcg/complex/algorithms/update/color.h>

#if QT_VERSION >= QT_VERSION_CHECK(5, 14, 0)
#include <QColorSpace>
#endif
#include <QImageWriter>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <string>
#include <utility>

namespace filter_ricci {

namespace {

/// Gutters take no more of the side of the square than this for one margin.
constexpr double kMaxMargin = 0.05;

/// Names that files of meshes keep: PLY drops all other letters from names of textures.
bool isKeptByFiles(const QString& name)
{
	return std::all_of(
		name.begin(), name.end(), [](QChar c) { return c.unicode() > 32 && c.unicode() < 125; });
}

bool hasWords(const QImage& image)
{
	switch (image.format()) {
	case QImage::Format_BGR30:
	case QImage::Format_A2BGR30_Premultiplied:
	case QImage::Format_RGB30:
	case QImage::Format_A2RGB30_Premultiplied:
#if QT_VERSION >= QT_VERSION_CHECK(5, 12, 0)
	case QImage::Format_RGBX64:
	case QImage::Format_RGBA64:
	case QImage::Format_RGBA64_Premultiplied:
#endif
#if QT_VERSION >= QT_VERSION_CHECK(5, 13, 0)
	case QImage::Format_Grayscale16:
#endif
		return true;
	default:
		return false;
	}
}

std::array<float, 4> asColour(const vcg::Color4b& c)
{
	return {c[0] / 255.0f, c[1] / 255.0f, c[2] / 255.0f, c[3] / 255.0f};
}

[[noreturn]] void refuse(const std::string& sentence)
{
	throw Refusal(sentence);
}

double texels(const QImage& image)
{
	return static_cast<double>(image.width()) * image.height();
}

/// Whether writing to \p path could overwrite \p old, sooner or later: hosts may know a texture by its
/// bare name, and write it by that name when the mesh is saved.
bool mayOverwrite(const QFileInfo& path, const QFileInfo& old)
{
	const bool isSame = path.exists() && path == old; // links lead to one file
	return isSame || path.fileName().compare(old.fileName(), Qt::CaseInsensitive) == 0;
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

/// Passes what is written on to a file, with a checkpoint each time. No exception passes the library that
/// writes: one of the checkpoint makes the writing fail, and is kept.
class WatchedFile : public QIODevice
{
public:
	/// \param expected bytes, to the order of magnitude
	WatchedFile(QIODevice& file, double expected) : m_file(file), m_expected(expected)
	{
		open(QIODevice::WriteOnly | QIODevice::Unbuffered);
	}

	bool isSequential() const override { return true; }

	void rethrow() const
	{
		if (m_thrown)
			std::rethrow_exception(m_thrown);
	}

protected:
	qint64 readData(char*, qint64) override { return -1; }

	qint64 writeData(const char* data, qint64 size) override
	{
		try {
			m_bytes += static_cast<double>(size);
			ricci::advance(m_bytes / (m_bytes + m_expected), "Writing the texture");
		}
		catch (...) {
			m_thrown = std::current_exception();
			return -1;
		}
		// A disk that becomes full takes a part first; only the next call says why it takes no more.
		for (qint64 done = 0, more = 0; done < size; done += more) {
			more = m_file.write(data + done, size - done);
			if (more <= 0)
				return -1;
		}
		return size;
	}

private:
	QIODevice& m_file;
	double m_expected, m_bytes = 0.0;
	std::exception_ptr m_thrown;
};

} // namespace

CarriedTexture::CarriedTexture(const TextureSettings& settings, const MeshModel& model)
{
	const QString wanted = settings.file.trimmed();
	if (wanted.isEmpty())
		return;
	const std::string shown = "The texture " + wanted.toStdString() + " cannot be written";
	if (QFileInfo(wanted).suffix().toLower() != "png")
		refuse(shown + ": its name must end in .png.");
	const QString path = absolutePath(wanted, model.pathName());
	m_name = host::textureName(path, model.pathName());
	if (!isKeptByFiles(m_name))
		refuse(
			shown +
			": files of meshes keep no blanks, no } or ~, and no letters beyond ASCII in the "
			"names and folders of textures. Choose another name or place.");
	m_size = settings.size;
	readFaces(model);
	for (const std::string& old : model.cm.textures)
		if (mayOverwrite(path, absolutePath(QString::fromStdString(old), model.pathName())))
			refuse(shown + ": it has the name of a texture of the mesh. Choose another name.");
	loadPictures(model);
	if (m_size == 0)
		fitSize();
	const QString reason = whyNotWritable(path);
	if (!reason.isEmpty())
		refuse(shown + " (" + reason.toStdString() + "): choose another place for it.");
	requireMemory();
	m_path = path;
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
		any = any || to.picture >= 0 || vertexColours || faceColours;
	}
	if (!any)
		refuse(
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
		QImage image = host::texture(model, name);
		if (image.isNull())
			refuse(
				"The texture " + name +
				" of the mesh cannot be loaded: put its file beside the mesh and open the mesh "
				"again, or leave {carry_texture} empty.");
		m_hasAlpha = m_hasAlpha || image.hasAlphaChannel();
		m_hasWords = m_hasWords || hasWords(image);
		m_pictures[ricci::positionOf(face.picture)] = image;
	}
}

std::vector<std::array<int, 2>> CarriedTexture::pictureSizes() const
{
	std::vector<std::array<int, 2>> sizes;
	for (const QImage& picture : m_pictures)
		sizes.push_back({picture.width(), picture.height()});
	return sizes;
}

/// The side of a square of as many texels as the faces have now: a map fills no square.
void CarriedTexture::fitSize()
{
	double count = 0.0;
	for (const ricci::TexturedFace& face : m_mesh.faces)
		if (face.picture >= 0) {
			const QImage& picture = m_pictures[ricci::positionOf(face.picture)];
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
	for (const QImage& picture : m_pictures) {
		largest = std::max(largest, texels(picture));
		all += texels(picture);
	}
	const double needed = (sample + 4.0) * square + sample * all +
						  std::max(square, ricci::kBytesOfOldTexel * largest) +
						  512.0 * static_cast<double>(m_mesh.faces.size());
	const double free = freeMemory();
	if (free > 0.0 && needed > free)
		refuse(
			"{texture_size} " + std::to_string(m_size) + " needs about " +
			ricci::numberText(needed / 1e9, 2) + " GB of memory for this mesh, but " +
			ricci::numberText(free / 1e9, 2) + " GB are free: choose a smaller one.");
}

double CarriedTexture::minMargin() const
{
	return isWanted() ? std::min(2.0 * ricci::kGutterTexels / m_size, kMaxMargin) : 0.0;
}

void CarriedTexture::takeTriangles(const Flow::Result& result)
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

void CarriedTexture::makeResult()
{
	const QImage::Format format =
		m_hasWords ? (m_hasAlpha ? QImage::Format_RGBA64 : QImage::Format_RGBX64)
				   : (m_hasAlpha ? QImage::Format_RGBA8888 : QImage::Format_RGBX8888);
	m_result = QImage(m_size, m_size, format);
	if (m_result.isNull())
		throw std::bad_alloc();
	m_result.fill(m_hasAlpha ? Qt::transparent : Qt::black);
	const auto first = std::find_if(
		m_pictures.begin(), m_pictures.end(), [](const QImage& image) { return !image.isNull(); });
	if (first == m_pictures.end())
		return;
	m_result.setDotsPerMeterX(first->dotsPerMeterX());
	m_result.setDotsPerMeterY(first->dotsPerMeterY());
#if QT_VERSION >= QT_VERSION_CHECK(5, 14, 0)
	m_result.setColorSpace(first->colorSpace());
#endif
}

void CarriedTexture::convertPictures()
{
	for (QImage& picture : m_pictures) {
		ricci::checkpoint();
		if (picture.isNull())
			continue;
#if QT_VERSION >= QT_VERSION_CHECK(5, 14, 0)
		if (picture.colorSpace().isValid() && m_result.colorSpace().isValid() &&
			picture.colorSpace() != m_result.colorSpace())
			picture.convertToColorSpace(m_result.colorSpace());
#endif
		picture = std::move(picture).convertToFormat(
			m_hasWords ? QImage::Format_RGBA64 : QImage::Format_RGBA8888);
		if (picture.isNull())
			throw std::bad_alloc();
	}
}

template<class Sample>
void CarriedTexture::drawSamples()
{
	std::vector<ricci::PictureView<const Sample>> views;
	for (const QImage& picture : m_pictures)
		views.push_back(
			{picture.width(),
			 picture.height(),
			 reinterpret_cast<const Sample*>(picture.constBits())});
	ricci::carryTexture<Sample>(
		m_mesh,
		views,
		m_hasAlpha,
		{m_size, m_size, reinterpret_cast<Sample*>(m_result.bits())},
		ricci::defaultThreads());
}

void CarriedTexture::describe(Results& results) const
{
	int count = 0;
	for (const QImage& picture : m_pictures)
		count += picture.isNull() ? 0 : 1;
	const std::string side = std::to_string(m_size);
	std::string line = "Texture: " + m_path.toStdString() + ", " + side + " x " + side + " texels";
	const ricci::TexelDensity density =
		ricci::texelDensity(m_mesh, m_areas, pictureSizes(), m_size);
	if (density.ratio > 0.0) {
		line += ", from " + std::to_string(count) + (count == 1 ? " image. " : " images. ") +
				ricci::numberText(density.before, 4) + " texels for a unit of length before, " +
				ricci::numberText(density.after, 4) + " after";
		results.emplace_back("texture_scale", density.ratio);
	}
	else
		line += ", from the colours of the mesh";
	if (m_uncoloured > 0)
		line += "; " + std::to_string(m_uncoloured) +
				(m_uncoloured == 1 ? " face has neither a texture nor a colour: it is white"
								   : " faces have neither a texture nor a colour: they are white");
	ricci::logLine(line + ".");
}

void CarriedTexture::draw(const Flow::Result& result, Results& results)
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
	makeResult();
	convertPictures();
	if (m_hasWords)
		drawSamples<unsigned short>();
	else
		drawSamples<unsigned char>();
	describe(results);
	if (result.report.overlappingCharts > 0)
		ricci::logLine("Texture: where charts overlap, it shows one of the faces only.");
	m_mesh = {};
	m_pictures.clear();
}

void CarriedTexture::write()
{
	if (!isWanted())
		return;
	m_file.setFileName(m_path);
	// Without Qt's buffer: it drops what no longer fits on a full disk and reports no error.
	if (m_file.open(QIODevice::WriteOnly | QIODevice::Unbuffered)) {
		WatchedFile file(m_file, 0.25 * m_result.bytesPerLine() * m_result.height());
		QImageWriter writer(&file, "png");
		writer.setQuality(
			70); // of compression: a sixth of the default's time, files a sixth larger
		const bool written = writer.write(m_result);
		file.rethrow();
		if (written)
			return;
	}
	refuseFile();
}

void CarriedTexture::publish()
{
	if (isWanted() && !m_file.commit())
		refuseFile();
}

void CarriedTexture::refuseFile() const
{
	const bool isKnown = m_file.error() != QFileDevice::NoError;
	const std::string reason = isKnown ? m_file.errorString().toStdString() : "is the disk full?";
	refuse(
		"The texture " + m_path.toStdString() + " could not be written (" + reason +
		"): choose another place for it. The mesh is unchanged.");
}

void CarriedTexture::assignTo(MeshModel& model) const
{
	if (!isWanted())
		return;
	host::setTexture(model, m_name.toStdString(), m_result);
	// Coordinates of vertices, where there are some, belong to the old textures.
	model.clearDataMask(MeshModel::MM_VERTTEXCOORD);
	// Files of materials multiply the image by the colours of faces, which are in it or were the old images'.
	if (vcg::tri::HasPerFaceColor(model.cm))
		vcg::tri::UpdateColor<CMeshO>::PerFaceConstant(model.cm, vcg::Color4b::White);
}

} // namespace filter_ricci
