// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef FILTER_RICCI_PICTURE_H
#define FILTER_RICCI_PICTURE_H

#include <cstddef>
#include <functional>
#include <vector>

namespace filter_ricci::host {

/// A picture of a texture: its samples, whatever they mean.
class Picture
{
public:
	/// None.
	Picture() = default;
	/// \param channels 1 grey, 2 grey and alpha, 3 RGB, 4 RGB and alpha
	/// \param samples row by row, of 16 bits or of 8
	Picture(int width, int height, int channels, bool hasWords, const void* samples);
	/// A square to draw on.
	Picture(int size, bool hasWords, bool hasAlpha, const Picture* like);

	bool isNull() const { return m_samples.empty(); }
	int width() const { return m_width; }
	int height() const { return m_height; }
	bool hasAlpha() const { return m_hasAlpha; }
	/// Whether its samples have 16 bits.
	bool hasWords() const { return m_hasWords; }

	/// Gives it the samples of another one.
	void convertFor(const Picture& other);

	/// Row by row, red, green, blue and alpha.
	const void* samples() const { return m_samples.data(); }
	void* samples() { return m_samples.data(); }

	/// Takes bytes of a file.
	using Sink = std::function<void(const char* data, std::size_t size)>;
	/// Nothing: who runs the filter gets the samples, and writes what it wants.
	bool writePng(const Sink&) const { return true; }

private:
	int m_width = 0, m_height = 0;
	bool m_hasWords = false, m_hasAlpha = false;
	std::vector<unsigned char> m_samples;
};

} // namespace filter_ricci::host

#endif
