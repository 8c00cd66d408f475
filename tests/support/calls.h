// SPDX-License-Identifier: GPL-3.0-or-later
// Calls of the public functions as rows of a table, and what they give back in a form that can be compared.
#ifndef RICCI_TESTS_CALLS_H
#define RICCI_TESTS_CALLS_H

#include <ricci/parametrize.h>
#include <ricci/sphere_map.h>

#include <iosfwd>
#include <string>
#include <variant>
#include <vector>

namespace ricci::testing {

/// What mapToSphere() reads.
struct SphereOptions : Options
{
};

/// A call of parametrizeEuclidean(), parametrizeHyperbolic() or mapToSphere(), by its options.
struct Call
{
	std::string name; ///< letters and digits
	SurfaceMesh mesh;
	std::variant<Options, HyperbolicOptions, SphereOptions> options;
	VertexInput input = {};
};
std::ostream& operator<<(std::ostream& out, const Call& call);

/// Options with a change, inDisk() those of parametrizeHyperbolic().
template<class AnyOptions = Options, class Change>
AnyOptions with(const Change& change)
{
	AnyOptions options;
	change(options);
	return options;
}
template<class Change>
HyperbolicOptions inDisk(const Change& change)
{
	return with<HyperbolicOptions>(change);
}

/// Names of parametrised tests.
struct CallName
{
	template<class Info>
	std::string operator()(const Info& info) const
	{
		return info.param.name;
	}
};

/// What a call gives: a map to the plane or the disk, or one to the sphere.
struct Outcome
{
	Parametrization map;
	SphereMap sphere;
};
Outcome outcomeOf(const Call& call);

/// A number of a report, named like the results of the filter.
struct Figure
{
	enum Kind {
		Count,   ///< of what the surface and its map consist of
		Measure, ///< of the map, whatever the mesh's scale
		Cut,     ///< of seams and charts, which can be as good elsewhere
		Work,    ///< done on the way
		Length,  ///< in the mesh's scale
		Error    ///< what rounding leaves
	};
	const char* name;
	double value;
	Kind kind;
};

/// What is not known is -1.
std::vector<Figure> figuresOf(const Report& report);
std::vector<Figure> figuresOf(const SphereMap& map);
std::vector<Figure> figuresOf(const Outcome& outcome);

/// Every bit that a call gives except for u and lengths, which the mesh's scale has a part in.
std::string bitsOf(const Outcome& outcome);

} // namespace ricci::testing

#endif
