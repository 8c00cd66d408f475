/****************************************************************************
 * Elements that are appended to a mesh, all or none                         *
 * An extension of the VCG Library                                           *
 * SPDX-License-Identifier: GPL-3.0-or-later                                 *
 ****************************************************************************/
#ifndef __VCGLIB_ALLOCATE_ALL_OR_NONE
#define __VCGLIB_ALLOCATE_ALL_OR_NONE

#include <vcg/complex/allocate.h>
#include <vcg/complex/complex.h>

#include <cstddef>

namespace vcg {
namespace tri {

/// Grows a mesh so that it is as it was if memory runs out.
template<class MeshType>
class AllOrNone
{
public:
	/// Appends elements, all or none.
	static void Append(MeshType& m, size_t vertices, size_t faces)
	{
		const size_t oldVertices = m.vert.size();
		const HeldAttributes<decltype(m.vert_attr), decltype(m.vert)> ofVertices(
			m.vert_attr, m.vert, vertices);
		const HeldAttributes<decltype(m.face_attr), decltype(m.face)> ofFaces(
			m.face_attr, m.face, faces);
		if (vertices > 0)
			Allocator<MeshType>::AddVertices(m, vertices);
		try {
			if (faces > 0)
				Allocator<MeshType>::AddFaces(m, faces);
		}
		catch (...) {
			m.vert.resize(oldVertices);
			m.vn -= int(vertices);
			throw;
		}
	}

private:
	/// Takes the attributes of a vector of elements away while it grows: vcglib would resize them
	/// after the vector, and copies their names on the way, for which there may be no memory any
	/// more. They get room before, and their size when they are put back.
	template<class Attributes, class Elements>
	class HeldAttributes
	{
	public:
		HeldAttributes(Attributes& attributes, const Elements& elements, size_t added) :
				m_attributes(attributes), m_elements(elements)
		{
			for (auto& attribute : attributes) {
				attribute._handle->Resize(elements.size() + added);
				attribute._handle->Resize(elements.size());
			}
			m_held.swap(attributes);
		}
		~HeldAttributes()
		{
			m_held.swap(m_attributes);
			for (auto& attribute : m_attributes)
				attribute._handle->Resize(m_elements.size());
		}
		HeldAttributes(const HeldAttributes&) = delete;
		HeldAttributes& operator=(const HeldAttributes&) = delete;

	private:
		Attributes m_held;
		Attributes& m_attributes;
		const Elements& m_elements;
	};
};

} // namespace tri
} // namespace vcg

#endif
