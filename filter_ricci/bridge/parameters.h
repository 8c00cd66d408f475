// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef FILTER_RICCI_PARAMETERS_H
#define FILTER_RICCI_PARAMETERS_H

#include "bridge.h"

#include <vcg/complex/algorithms/parametrization/ricci_flow.h>

namespace filter_ricci {

using Flow = vcg::tri::RicciFlow<CMeshO>;

/// Where the surface is opened before the flow.
enum class Seams {
	Shortest,      ///< nowhere: only along what the flow needs
	Texture,       ///< where the texture coordinates that the mesh has jump
	SelectedEdges, ///< sides of faces
	SelectedFaces  ///< around them
};

/// Texels.
constexpr int kMinTextureSize = 16, kMaxTextureSize = 16384;

struct TextureSettings
{
	QString file;    ///< empty: none
	int size = 2048; ///< texels; 0: as many as the old ones need, which are so as fine as they were
};

/// What both filters have.
struct RunSettings
{
	Seams seams = Seams::Shortest;
	bool colorize = false;
	bool flatLayer = false;
	double timeLimit = 0.0; ///< seconds, 0: none
	QString report;         ///< file, empty: none
	TextureSettings texture;
};

struct Settings : RunSettings
{
	Flow::Params flow;
	bool sphereLayer = false;
};

struct HyperbolicSettings : RunSettings
{
	Flow::HyperbolicParams flow;
	int coverRings = 0;
	bool axes = false;
	bool canonicalPolygon = false;
};

/// Reads the parameters and checks them all. Scripts can hold any number for a choice, and no host
/// checks the range of a number.
/// \throw Refusal for what the algorithm does not know (choices, time limit, rings), and
/// ricci::InvalidOption
Settings readSettings(const RichParameterList& par);
HyperbolicSettings readHyperbolicSettings(const RichParameterList& par);

} // namespace filter_ricci

#endif
