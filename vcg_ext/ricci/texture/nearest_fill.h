// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_NEAREST_FILL_H
#define RICCI_NEAREST_FILL_H

#include "picture.h"

#include <vector>

namespace ricci {

/// Gives every texel that is not \p covered [texel] the samples of the nearest one that is; nothing
/// where none is. Euclidean distance between middles, found exactly in time proportional to the texels
/// [Felzenszwalb Huttenlocher 2012]. Needs 2 bytes for each texel.
template<class Sample>
void fillFromNearest(
	const std::vector<char>& covered, const PictureView<Sample>& picture, int threads);

extern template void
fillFromNearest(const std::vector<char>&, const PictureView<unsigned char>&, int);
extern template void
fillFromNearest(const std::vector<char>&, const PictureView<unsigned short>&, int);

} // namespace ricci

#endif
