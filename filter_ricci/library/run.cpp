// SPDX-License-Identifier: GPL-3.0-or-later
#include "run.h"

#include "bridge.h"

#include <vcg/complex/algorithms/update/bounding.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>
#include <map>
#include <new>
#include <utility>

namespace filter_ricci {

namespace {

/// Beyond these, products of lengths exceed the memory of any machine.
constexpr int64_t kMaxLength = std::numeric_limits<int32_t>::max();
constexpr double kMaxBytes = 1e15;

std::size_t bytesOf(int32_t type)
{
	switch (type) {
	case RICCI_BOOL:
	case RICCI_UINT8:
		return 1;
	case RICCI_UINT16:
		return 2;
	case RICCI_INT32:
	case RICCI_FLOAT32:
		return 4;
	case RICCI_INT64:
	case RICCI_FLOAT64:
		return 8;
	default:
		throw Misuse("There is no array type " + std::to_string(type) + ": see ricci_type.");
	}
}

std::size_t entriesOf(const ricci_array& array)
{
	std::size_t count = 1;
	for (int32_t k = 0; k < array.dimensions; ++k)
		count *= static_cast<std::size_t>(array.shape[k]);
	return count;
}

std::string shapeText(const ricci_array& array)
{
	std::string text;
	for (int32_t k = 0; k < std::min(array.dimensions, 3); ++k)
		text += (k == 0 ? "" : " x ") + std::to_string(array.shape[k]);
	return text.empty() ? "one number" : text;
}

/// \throw Misuse for an array that is none
LibraryRun::Array copied(const std::string& name, const ricci_array& given)
{
	const std::size_t width = bytesOf(given.type);
	double bytes = static_cast<double>(width);
	bool isShape = given.dimensions >= 0 && given.dimensions <= 3;
	for (int32_t k = 0; isShape && k < given.dimensions; ++k) {
		isShape = given.shape[k] >= 0 && given.shape[k] <= kMaxLength;
		bytes *= static_cast<double>(given.shape[k]);
	}
	if (!isShape)
		throw Misuse(
			"The array " + name +
			" has an invalid shape: arrays have up to 3 dimensions, each of 0 to " +
			std::to_string(kMaxLength) + " entries.");
	if (bytes > 0.0 && given.data == nullptr)
		throw Misuse(
			"The array " + name + " is null, but " + shapeText(given) + " entries are expected.");
	if (bytes > kMaxBytes)
		throw std::bad_alloc();
	const auto* const data = static_cast<const unsigned char*>(given.data);
	LibraryRun::Array array{name, given, {}};
	if (bytes > 0.0)
		array.bytes.assign(data, data + width * entriesOf(given));
	array.shape.data = nullptr;
	return array;
}

/// What ricci_set_array() takes.
struct Kind
{
	const char* name;
	const char* shape; ///< V and F: the numbers of vertices and faces
	bool isWhole;      ///< indices, or truth values
};

constexpr Kind kKinds[] = {
	{"vertices", "V x 3", false},
	{"faces", "F x 3", true},
	{"faux", "F x 3", true},
	{"selected_vertices", "V", true},
	{"selected_edges", "F x 3", true},
	{"selected_faces", "F", true},
	{"quality", "V", false},
	{"part", "V", true},
	{"uv", "F x 3 x 2", false},
	{"picture_of_face", "F", true},
	{"vertex_colors", "V x 4", false},
	{"face_colors", "F x 4", false},
	{"matrix", "4 x 4", false}};

/// The array whose length is that of one of the kind; null if its length is a number.
const char* lengthOf(const Kind& kind)
{
	return *kind.shape == 'V' ? "vertices" : *kind.shape == 'F' ? "faces" : nullptr;
}

bool hasShape(const Kind& kind, const ricci_array& array)
{
	std::string wanted = kind.shape;
	if (lengthOf(kind) != nullptr)
		wanted.replace(0, 1, std::to_string(array.shape[0]));
	return shapeText(array) == wanted;
}

unsigned char colour(double value)
{
	return static_cast<unsigned char>(
		std::fmin(std::fmax(std::round(value), 0.0), 255.0)); // NaN: 0
}

class Listener : public ricci::Progress
{
public:
	Listener(ricci_listener listener, void* context) : m_listener(listener), m_context(context) {}

	void log(const std::string& line) override { m_listener(m_context, -1.0, line.c_str()); }

	void warn(const std::string& line) { m_listener(m_context, -2.0, line.c_str()); }

	bool update(double fraction, const std::string& what) override
	{
		return m_listener(m_context, fraction, what.c_str()) != 0;
	}

private:
	ricci_listener m_listener;
	void* m_context;
};

template<class Number>
constexpr ricci_type kTypeOf = RICCI_UINT8;
template<>
constexpr ricci_type kTypeOf<bool> = RICCI_BOOL;
template<>
constexpr ricci_type kTypeOf<unsigned short> = RICCI_UINT16;
template<>
constexpr ricci_type kTypeOf<int32_t> = RICCI_INT32;
template<>
constexpr ricci_type kTypeOf<double> = RICCI_FLOAT64;

/// Appends arrays to the outputs of a run.
class Outputs
{
public:
	explicit Outputs(std::vector<LibraryRun::Array>& outputs) : m_outputs(outputs) {}

	/// \param value called for each entry in turn, with its place
	template<class Number, class Value>
	void add(const std::string& name, std::initializer_list<std::size_t> shape, const Value& value)
	{
		LibraryRun::Array array{name, {}, {}};
		array.shape.type = kTypeOf<Number>;
		array.shape.dimensions = static_cast<int32_t>(shape.size());
		std::transform(shape.begin(), shape.end(), array.shape.shape, [](std::size_t n) {
			return static_cast<int64_t>(n);
		});
		const std::size_t count = entriesOf(array.shape);
		array.bytes.resize(count * sizeof(Number));
		for (std::size_t i = 0; i < count; ++i) {
			const Number number = static_cast<Number>(value(i));
			std::memcpy(array.bytes.data() + i * sizeof(Number), &number, sizeof(Number));
		}
		m_outputs.push_back(std::move(array));
	}

	/// What meshes and layers have.
	void mesh(const std::string& before, const MeshModel& model)
	{
		const CMeshO& m = model.cm;
		add<double>(before + "vertices", {m.vert.size(), 3}, [&](std::size_t i) {
			return m.vert[i / 3].cP()[static_cast<int>(i % 3)];
		});
		add<int32_t>(before + "faces", {m.face.size(), 3}, [&](std::size_t i) {
			return vcg::tri::Index(m, m.face[i / 3].cV(static_cast<int>(i % 3)));
		});
		if (vcg::tri::HasPerWedgeTexCoord(m))
			add<double>(before + "uv", {m.face.size(), 3, 2}, [&](std::size_t i) {
				const auto& at = m.face[i / 6].cWT(static_cast<int>(i / 2 % 3));
				return i % 2 == 0 ? at.u() : at.v();
			});
		if (model.hasDataMask(MeshModel::MM_VERTQUALITY))
			add<double>(
				before + "quality", {m.vert.size()}, [&](std::size_t i) { return m.vert[i].cQ(); });
	}

	/// Of vertices or faces.
	template<class Elements>
	void colours(const std::string& name, const Elements& elements)
	{
		add<unsigned char>(name, {elements.size(), 4}, [&](std::size_t i) {
			return elements[i / 4].cC()[static_cast<int>(i % 4)];
		});
	}

	void layer(const MeshModel& layer)
	{
		std::string kind = lower(layer.label.substr(0, layer.label.find(' ')));
		kind = (kind == "universal" ? "cover" : kind == "canonical" ? "polygon" : kind) + ".";
		mesh(kind, layer);
		if (layer.hasDataMask(MeshModel::MM_VERTCOLOR))
			colours(kind + "colors", layer.cm.vert);
		add<int32_t>(kind + "edges", {layer.cm.edge.size(), 2}, [&](std::size_t i) {
			return vcg::tri::Index(layer.cm, layer.cm.edge[i / 2].cV(static_cast<int>(i % 2)));
		});
		add<double>(kind + "matrix", {4, 4}, [&](std::size_t i) {
			return layer.cm.Tr[static_cast<int>(i / 4)][static_cast<int>(i % 4)];
		});
	}

	void attribute(const char* name, const char* own, CMeshO& m)
	{
		auto values = vcg::tri::Allocator<CMeshO>::FindPerVertexAttribute<double>(m, own);
		add<double>(name, {m.vert.size()}, [&](std::size_t i) { return values[i]; });
	}

	void picture(const host::Picture& picture)
	{
		const auto size = static_cast<std::size_t>(picture.width());
		const std::size_t channels = picture.hasAlpha() ? 4 : 3;
		const auto write = [&](auto sample) {
			using Sample = decltype(sample);
			const auto* const samples = static_cast<const Sample*>(picture.samples());
			add<Sample>("picture", {size, size, channels}, [&](std::size_t i) {
				return samples[4 * (i / channels) + i % channels];
			});
		};
		if (picture.hasWords())
			write(static_cast<unsigned short>(0));
		else
			write(static_cast<unsigned char>(0));
	}

	void result(const std::string& name, const Value& value)
	{
		if (const auto* const row = std::get_if<std::vector<double>>(&value))
			add<double>(name, {row->size()}, [&](std::size_t i) { return (*row)[i]; });
		else if (const bool* const is = std::get_if<bool>(&value))
			add<bool>(name, {}, [&](std::size_t) { return *is; });
		else if (const int* const whole = std::get_if<int>(&value))
			add<int32_t>(name, {}, [&](std::size_t) { return *whole; });
		else
			add<double>(name, {}, [&](std::size_t) { return std::get<double>(value); });
	}

private:
	std::vector<LibraryRun::Array>& m_outputs;
};

} // namespace

double LibraryRun::Array::operator[](std::size_t i) const
{
	const auto as = [&](auto number) {
		std::memcpy(&number, bytes.data() + i * sizeof(number), sizeof(number));
		return static_cast<double>(number);
	};
	switch (shape.type) {
	case RICCI_UINT16:
		return as(uint16_t());
	case RICCI_INT32:
		return as(int32_t());
	case RICCI_INT64:
		return as(int64_t());
	case RICCI_FLOAT32:
		return as(0.0f);
	case RICCI_FLOAT64:
		return as(0.0);
	default:
		return as(uint8_t());
	}
}

void LibraryRun::setParameter(const std::string& name, const std::string& value)
{
	Parameter* const parameter = findParameter(m_parameters, name);
	if (parameter == nullptr)
		throw Misuse(noSuchParameter(m_filter, name));
	const std::string problem = setFromText(*parameter, value);
	if (!problem.empty())
		throw Misuse(problem);
}

void LibraryRun::setArray(const std::string& name, const ricci_array* given)
{
	const auto kind = std::find_if(
		std::begin(kKinds), std::end(kKinds), [&](const Kind& k) { return name == k.name; });
	if (kind == std::end(kKinds))
		throw Misuse("A mesh has no array '" + name + "': ricci_c.h names those it has.");
	if (given == nullptr) {
		m_inputs.erase(name);
		return;
	}
	Array array = copied(name, *given);
	if (!hasShape(*kind, array.shape))
		throw Misuse(
			"The array " + name + " must have the shape " + kind->shape + ", not " +
			shapeText(array.shape) + ".");
	if (kind->isWhole && (given->type == RICCI_FLOAT32 || given->type == RICCI_FLOAT64))
		throw Misuse("The array " + name + " must have whole numbers or truth values.");
	m_inputs[name] = std::move(array);
}

void LibraryRun::setText(const std::string& name, const std::string& text)
{
	if (name != "name" && name != "folder")
		throw Misuse("A mesh has no text '" + name + "': it has a name and a folder.");
	(name == "name" ? m_name : m_folder) = text;
}

void LibraryRun::addPicture(const std::string& name, const ricci_array* given)
{
	host::Picture picture;
	if (given != nullptr) {
		const Array array = copied(name, *given);
		const int64_t* const shape = array.shape.shape;
		if (array.shape.dimensions != 3 || shape[0] < 1 || shape[1] < 1 || shape[2] < 1 ||
			shape[2] > 4 || (given->type != RICCI_UINT8 && given->type != RICCI_UINT16))
			throw Misuse(
				"The picture " + name +
				" must have rows, columns and 1 to 4 channels of bytes or 16-bit words, not " +
				shapeText(array.shape) + ".");
		picture = host::Picture(
			static_cast<int>(shape[1]),
			static_cast<int>(shape[0]),
			static_cast<int>(shape[2]),
			given->type == RICCI_UINT16,
			array.bytes.data());
	}
	m_pictureNames.reserve(m_pictureNames.size() + 1);
	m_pictures.push_back(std::move(picture));
	m_pictureNames.push_back(name);
}

void LibraryRun::setListener(ricci_listener listener, void* context)
{
	m_listener = listener == nullptr ? nobody : listener;
	m_context = context;
}

const LibraryRun::Array* LibraryRun::input(const char* name) const
{
	const auto found = m_inputs.find(name);
	return found == m_inputs.end() ? nullptr : &found->second;
}

void LibraryRun::checkLengths() const
{
	for (const char* needed : {"vertices", "faces"})
		if (input(needed) == nullptr)
			throw Misuse(
				std::string("There is no array ") + needed + ": a mesh has vertices and faces.");
	for (const Kind& kind : kKinds) {
		const Array* const array = input(kind.name);
		const char* const like = lengthOf(kind);
		if (array != nullptr && like != nullptr &&
			array->shape.shape[0] != input(like)->shape.shape[0])
			throw Misuse(
				"The array " + array->name + " has " + std::to_string(array->shape.shape[0]) +
				" entries, but there are " + std::to_string(input(like)->shape.shape[0]) + " " +
				like + ".");
	}
}

void LibraryRun::fill(MeshDocument& document) const
{
	MeshModel& model = *host::addMesh(document, m_name);
	model.name = m_name;
	model.folder = m_folder;
	model.cm.textures = m_pictureNames;
	model.pictures = m_pictures;
	CMeshO& m = model.cm;
	const Array &places = *input("vertices"), &corners = *input("faces");
	const auto vertices = static_cast<std::size_t>(places.shape.shape[0]),
			   faces = static_cast<std::size_t>(corners.shape.shape[0]);
	std::size_t damaged = 0;
	for (std::size_t i = 0; i < 3 * faces; i += 3) {
		const auto isNone = [&](std::size_t c) {
			return corners[c] < 0.0 || corners[c] >= static_cast<double>(vertices);
		};
		damaged += isNone(i) || isNone(i + 1) || isNone(i + 2) ? 1 : 0;
	}
	if (damaged > 0)
		throw ricci::InvalidMesh(ricci::InvalidMesh::DamagedFaces, damaged);
	vcg::tri::Allocator<CMeshO>::AddVertices(m, vertices);
	vcg::tri::Allocator<CMeshO>::AddFaces(m, faces);
	for (const auto& [name, element] :
		 {std::pair("quality", MeshModel::MM_VERTQUALITY),
		  std::pair("uv", MeshModel::MM_WEDGTEXCOORD),
		  std::pair("vertex_colors", MeshModel::MM_VERTCOLOR),
		  std::pair("face_colors", MeshModel::MM_FACECOLOR)})
		if (input(name) != nullptr)
			model.updateDataMask(element);

	/// use(element, its array, place of its first entry) for each, where there is the array.
	const auto each = [&](const char* name, auto& elements, std::size_t entries, auto use) {
		if (const Array* const array = input(name))
			for (std::size_t i = 0; i < elements.size(); ++i)
				use(elements[i], *array, entries * i);
	};
	each("vertices", m.vert, 3, [](CVertexO& v, const Array& a, std::size_t i) {
		v.P() = vcg::Point3d(a[i], a[i + 1], a[i + 2]);
	});
	each("faces", m.face, 3, [&](CFaceO& f, const Array& a, std::size_t i) {
		for (int k = 0; k < 3; ++k)
			f.V(k) = &m.vert[static_cast<std::size_t>(a[i + static_cast<std::size_t>(k)])];
	});
	/// The numbers of the sides that are marked.
	const auto eachSide = [&](const char* name, auto mark) {
		each(name, m.face, 3, [&](CFaceO& f, const Array& a, std::size_t i) {
			for (int k = 0; k < 3; ++k)
				if (a[i + static_cast<std::size_t>(k)] != 0.0)
					mark(f, k);
		});
	};
	eachSide("faux", [](CFaceO& f, int k) { f.SetF(k); });
	eachSide("selected_edges", [](CFaceO& f, int k) { f.SetFaceEdgeS(k); });
	const auto select = [](auto& element, const Array& a, std::size_t i) {
		if (a[i] != 0.0)
			element.SetS();
	};
	each("selected_vertices", m.vert, 1, select);
	each("selected_faces", m.face, 1, select);
	std::map<double, int> parts;
	each("part", m.vert, 1, [&](CVertexO&, const Array& a, std::size_t i) {
		const auto [part, isNew] = parts.try_emplace(a[i], static_cast<int>(parts.size()));
		model.parts.push_back(part->second);
	});
	each("quality", m.vert, 1, [](CVertexO& v, const Array& a, std::size_t i) { v.Q() = a[i]; });
	each("uv", m.face, 6, [](CFaceO& f, const Array& a, std::size_t i) {
		for (int k = 0; k < 3; ++k, i += 2) {
			f.WT(k).U() = static_cast<float>(a[i]);
			f.WT(k).V() = static_cast<float>(a[i + 1]);
			f.WT(k).N() = 0;
		}
	});
	if (input("uv") != nullptr)
		each("picture_of_face", m.face, 1, [&](CFaceO& f, const Array& a, std::size_t i) {
			const bool is = a[i] >= 0.0 && a[i] < static_cast<double>(m_pictures.size());
			for (int k = 0; k < 3; ++k)
				f.WT(k).N() = is ? static_cast<short>(a[i]) : static_cast<short>(-1);
		});
	const auto paint = [](auto& element, const Array& a, std::size_t i) {
		element.C() =
			vcg::Color4b(colour(a[i]), colour(a[i + 1]), colour(a[i + 2]), colour(a[i + 3]));
	};
	each("vertex_colors", m.vert, 4, paint);
	each("face_colors", m.face, 4, paint);
	if (const Array* const matrix = input("matrix"))
		for (int i = 0; i < 16; ++i)
			m.Tr[i / 4][i % 4] = (*matrix)[static_cast<std::size_t>(i)];
	vcg::tri::UpdateBounding<CMeshO>::Box(m);
}

void LibraryRun::execute()
{
	m_outputs.clear();
	checkLengths();
	MeshDocument document;
	fill(document);
	Listener listener(m_listener, m_context);
	const Outcome outcome = applyFilter(m_filter, m_parameters, document, listener);
	for (std::size_t i = 1; i < outcome.sentences.size(); ++i)
		listener.warn(outcome.sentences[i]);

	std::vector<Array> arrays;
	Outputs outputs(arrays);
	MeshModel& model = *document.mm();
	CMeshO& m = model.cm;
	const std::size_t faces = m.face.size();
	outputs.mesh("", model);
	outputs.add<int32_t>(
		"face_of_origin", {faces}, [&](std::size_t f) { return outcome.origin[f]; });
	outputs.add<int32_t>("chart", {faces}, [&](std::size_t f) { return outcome.chart[f]; });
	if (input("faux") != nullptr)
		outputs.add<bool>("faux", {faces, 3}, [&](std::size_t i) {
			return m.face[i / 3].IsF(static_cast<int>(i % 3));
		});
	outputs.attribute("log_radius", "ricci_u", m);
	outputs.attribute("target_curvature", "ricci_target_curvature", m);
	if (model.hasDataMask(MeshModel::MM_VERTCOLOR))
		outputs.colours("vertex_colors", m.vert);
	if (model.hasDataMask(MeshModel::MM_FACECOLOR))
		outputs.colours("face_colors", m.face);
	if (!valueOf<std::string>(m_parameters, "carry_texture").empty())
		outputs.picture(model.pictures.front());
	for (const Result& result : outcome.results)
		outputs.result("results." + result.key, result.value);
	for (std::size_t i = 1; i < document.meshes.size(); ++i)
		outputs.layer(*document.meshes[i]);
	m_outputs.swap(arrays);
}

} // namespace filter_ricci
