// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_CIRCLE_PATHS_H
#define RICCI_CIRCLE_PATHS_H

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
	/// \param parts of the surface: the vertices of one centre each; null: it is one part
	CirclePaths(CutSegments& cut, const CoarseSurface* parts);

	int partCount() const { return m_parts ? m_parts->triangulation().vertexCount() : 1; }

	/// The number of a part is that of its centre.
	Vertex partOf(Vertex v) const { return m_parts ? m_parts->centreOf(v) : Vertex(0); }

	/// Numbers the circles, see CutSegments::labelCircles(). To be called when the cut has changed.
	/// \return how many there are
	int labelCircles();

	/// The same where \p removed has been taken out and \p added put in, and nothing else has changed.
	/// \return how many sides were numbered
	std::size_t update(const std::vector<Edge>& removed, const std::vector<Edge>& added);

	/// From now on paths run only through the parts at which \p removed lies, and through those beside them.
	void findNear(const std::vector<Edge>& removed);

	/// These parts; all at first, and where there is but one.
	const std::vector<Vertex>& near() const { return m_near; }

	/// Numbers the circles, see CutSegments::splitCircles(). To be called when edges have been taken out,
	/// before paths are asked for.
	/// \return how many there are
	int splitCircles(const std::vector<Edge>& removed);

	/// The shortest path from another circle to circle 0, empty if none is shorter than \p bound.
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

	/// Vertices that searches have seen since findNear(), and halfedges with which they may have begun.
	std::size_t reached() const { return m_reached; }

private:
	using Arrival = std::pair<double, Halfedge>; // length of the path, and its last halfedge

	void addPlaces(int first);
	bool isOpen(Vertex v) const;
	Arrival startFrom(int circle, double bound, Front& front) const;
	void searchFromBoth(double bound);
	void goOn(Halfedge h, double length, double bound, Front& front, Arrival& arrival) const;
	Arrival goOn(Front& front, Vertex v, double bound) const;
	bool touch(const std::vector<Edge>& paths, Vertex centre) const;

	const Triangulation& m_t;
	const EdgeArray<double>& m_cost;
	CutSegments& m_cut;
	const CoarseSurface* m_parts;
	VertexArray<std::vector<int>> m_places;       // [part] of sides from it, and some that are gone
	std::vector<Vertex> m_near;                   // see near()
	VertexArray<char> m_isNear;                   // [part] the same
	std::vector<CutSegments::Departure> m_starts; // of the circles that are not joined to circle 0
	int m_joined = -1;                            // the circle from which the last bridge came
	std::size_t m_reached = 0;                    // see reached()
	std::vector<Front> m_fronts;                  // of two searches, and of their sums
};

} // namespace ricci

#endif
