// SPDX-License-Identifier: GPL-3.0-or-later
#include "result_check.h"

#include "../base/text.h"
#include "../base/tolerances.h"
#include "../error.h"
#include "disk_check.h"
#include "flow_check.h"
#include "map_check.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace ricci {

void requireMap(const FlatMesh& chart, const FlowResult& flow, bool bent, bool seamsFit)
{
	const double tolerance = kCheckedGap + openCurvature(flow);
	const MapCheck check = checkMap(chart, tolerance);
	if (!check.finite || (seamsFit && !(check.seamGap <= tolerance)) ||
		(check.flipped > 0 && !bent))
		failCheck(
			"seams " + numberText(check.seamGap, 3) + " of the chart apart, " +
			std::to_string(check.flipped) + " faces flipped");
}

void requireDisk(const FlatMesh& chart, const FlowResult& flow, bool bent)
{
	// The gap that an open angle leaves grows like sinh of the distance across the layout.
	double radius = 0.0;
	bool finite = true;
	for (const Point2& p : chart.place) {
		const double r = std::hypot(p[0], p[1]);
		finite = finite && std::isfinite(r);
		radius = std::max(radius, 2.0 * std::atanh(std::min(1.0, r)));
	}
	const double tolerance = kCheckedGap + openCurvature(flow) * std::sinh(2.0 * radius);
	const DiskCheck check = checkDisk(chart, tolerance);
	if (check.outside > 0 && finite) // the doubles of the disk end at a distance of about 37
		throw NotConverged(NotConverged::OutsideDisk, check.outside);
	if (check.outside > 0)
		failCheck(std::to_string(check.outside) + " points lie outside the disk");
	if (!(check.seamGap <= tolerance) || (check.flipped > 0 && !bent))
		failCheck(
			"seams " + numberText(check.seamGap, 3) + " apart in the disk, " +
			std::to_string(check.flipped) + " faces flipped");
}

} // namespace ricci
