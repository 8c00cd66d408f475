// SPDX-License-Identifier: GPL-3.0-or-later
#include "picture.h"

#include <limits>

namespace filter_ricci::host {

namespace {

std::size_t bytesOf(int width, int height, bool hasWords)
{
	return static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
		   (hasWords ? 8u : 4u);
}

/// \param to four channels
template<class Sample>
void spread(const Sample* from, int channels, std::size_t texels, Sample* to)
{
	const bool isGrey = channels < 3, hasAlpha = channels % 2 == 0;
	for (std::size_t i = 0; i < texels; ++i, from += channels, to += 4) {
		for (int k = 0; k < 3; ++k)
			to[k] = from[isGrey ? 0 : k];
		to[3] = hasAlpha ? from[channels - 1] : std::numeric_limits<Sample>::max();
	}
}

} // namespace

Picture::Picture(int width, int height, int channels, bool hasWords, const void* samples) :
		m_width(width), m_height(height), m_hasWords(hasWords), m_hasAlpha(channels % 2 == 0),
		m_samples(bytesOf(width, height, hasWords))
{
	const std::size_t texels = bytesOf(width, height, false) / 4;
	if (hasWords)
		spread(
			static_cast<const unsigned short*>(samples),
			channels,
			texels,
			reinterpret_cast<unsigned short*>(m_samples.data()));
	else
		spread(static_cast<const unsigned char*>(samples), channels, texels, m_samples.data());
}

Picture::Picture(int size, bool hasWords, bool hasAlpha, const Picture*) :
		m_width(size), m_height(size), m_hasWords(hasWords), m_hasAlpha(hasAlpha),
		m_samples(bytesOf(size, size, hasWords))
{
	const std::size_t width = hasWords ? 2 : 1;
	for (std::size_t i = 0; !hasAlpha && i < m_samples.size(); ++i)
		if (i / width % 4 == 3)
			m_samples[i] = 255;
}

void Picture::convertFor(const Picture& other)
{
	if (m_hasWords || !other.m_hasWords)
		return;
	std::vector<unsigned char> words(2 * m_samples.size());
	for (std::size_t i = 0; i < words.size(); ++i)
		words[i] = m_samples[i / 2]; // 257 times a byte
	m_samples.swap(words);
	m_hasWords = true;
}

} // namespace filter_ricci::host
