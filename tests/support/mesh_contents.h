// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TESTS_MESH_CONTENTS_H
#define RICCI_TESTS_MESH_CONTENTS_H

#include "bytes.h"

#include <vcg/complex/complex.h>

#include <cstdint>
#include <string>

namespace ricci::testing {

/// The first vertices of a VCG mesh, or all of them and its faces, with their flags, deleted ones included; without
/// what maps are written to.
template<class Mesh>
Bytes shapeOf(const Mesh& m, std::size_t vertices, bool faces)
{
	Bytes bytes;
	const auto put = [&](const auto& value) { bytes.add(value); };
	for (std::size_t v = 0; v < vertices; ++v) {
		for (int k = 0; k < 3; ++k) {
			put(m.vert[v].cP()[k]);
			put(m.vert[v].cN()[k]);
		}
		put(m.vert[v].cFlags());
	}
	if (!faces)
		return bytes;
	put(m.vert.size());
	put(m.face.size());
	const auto base = reinterpret_cast<std::uintptr_t>(m.vert.data());
	for (const auto& f : m.face) {
		for (int k = 0; k < 3; ++k) {
			put(reinterpret_cast<std::uintptr_t>(f.cV(k)) -
				base); // a number, wherever the vector lies
			put(f.cN()[k]);
		}
		put(f.cFlags());
	}
	return bytes;
}

/// Every bit of a VCG mesh that a filter might touch: its shape, counts, quality, colours, texture coordinates, and
/// per-vertex and per-face attributes with their names and values.
template<class Mesh>
std::string contents(const Mesh& m)
{
	Bytes bytes = shapeOf(m, m.vert.size(), true);
	const auto put = [&](const auto& value) { bytes.add(value); };
	put(m.vn);
	put(m.fn);
	for (const auto& v : m.vert) {
		put(v.cQ());
		if (vcg::tri::HasPerVertexColor(m))
			for (int k = 0; k < 4; ++k)
				put(v.cC()[k]);
	}
	for (const auto& f : m.face)
		for (int k = 0; k < 3; ++k) {
			put(f.cWT(k).U());
			put(f.cWT(k).V());
			put(f.cWT(k).N());
		}
	const auto putAttributes = [&](const auto& attributes, std::size_t count) {
		for (const auto& a : attributes) {
			bytes.all += a._name;
			put(a._sizeof);
			for (std::size_t i = 0; i < count; ++i)
				bytes.all.append(
					static_cast<const char*>(a._handle->At(i)),
					static_cast<std::size_t>(a._sizeof));
		}
	};
	putAttributes(m.vert_attr, m.vert.size());
	putAttributes(m.face_attr, m.face.size());
	return bytes.all;
}

} // namespace ricci::testing

#endif
