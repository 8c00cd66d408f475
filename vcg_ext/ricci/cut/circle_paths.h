// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_CIRCLE_PATHS_H
#define RICCI_CIRCLE_PATHS_H

#include "../math/adjacency.h"
#include "../math/shortest_paths.h"
#include "coarse_surface.h"
#include "cut_segments.h"

#include <utility>
#include <vector>

namespace ricci {

/// Shortest paths between the circles of a cut (see CutSegments::labelCircles()), inside the surface
/// opened along it. Of equally short ones always the same is taken.
class CirclePaths
{
public:
	using Front = SearchFront<Vertex, Halfedge>;

	/// \param cut may change between the calls
	/// \param parts where findNear() is to have an effect; else null
	CirclePaths(CutSegments& cut, const CoarseSurface* parts);

	/// From now on paths run only through the parts of the surface (the vertices of one centre of
	/// CoarseSurface) at which \p removed lies, and through those beside them.
	void findNear(const std::vector<Edge>& removed);

	/// These parts.
	const std::vector<Vertex>& near() const { return m_near; }

	/// Numbers the circles, see CutSegments::splitCircles(). To be called when edges have been taken out,
	/// before paths are asked for.
	/// \return how many there are
	int splitCircles(const std::vector<Edge>& removed);

	/// The shortest path from circle 0 to another, empty if none is shorter than \p bound.
	std::vector<Edge> shortestBridge(double bound);

	/// Paths that join the circles 0 .. \p circles - 1 one after another, each as short as can be. Empty if
	/// they are not shorter than \p bound together. The cut is left as it is, but the numbers are not.
	std::vector<Edge> joinCircles(int circles, double bound);

	/// The three paths from the circles 0, 1, 2 to one vertex that are shortest together, empty if they
	/// are not shorter than \p bound.
	std::vector<Edge> bestTripod(double bound);

	double costOf(const std::vector<Edge>& edges) const;

	/// Appends the edges of the path by which \p front has come from the cut to \p v.
	void appendPath(const Front& front, Vertex v, std::vector<Edge>& edges) const;

	/// Vertices that the last searches have seen, and places where they may have begun.
	std::size_t reached() const;

private:
	/// A halfedge by which a path may leave a circle.
	struct Start
	{
		Halfedge halfedge;
		int circle;
	};

	bool isOpen(Vertex v) const;
	void findStarts();
	template<class Chosen>
	void startFrom(const Chosen& chosen, double bound, Front& front) const;
	void searchFromBoth(int first, int second, int last, double bound);
	std::pair<double, Halfedge> goOn(Front& front, Vertex v, int circle, double limit) const;
	bool touch(const std::vector<Edge>& paths, Vertex centre) const;

	const Triangulation& m_t;
	const EdgeArray<double>& m_cost;
	CutSegments& m_cut;
	const CoarseSurface* m_parts;
	std::vector<Vertex> m_near;          // see near()
	VertexArray<char> m_isNear;          // [part] the same
	Adjacency<Vertex, Vertex> m_members; // [part] its vertices
	std::vector<Start> m_starts;
	int m_arrival = -1;          // the circle at the end of the last bridge
	std::vector<Front> m_fronts; // of the searches from up to three circles
};

} // namespace ricci

#endif
