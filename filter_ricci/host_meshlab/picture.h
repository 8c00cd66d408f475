// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef FILTER_RICCI_PICTURE_H
#define FILTER_RICCI_PICTURE_H

#include <QImage>

#include <cstddef>
#include <functional>

namespace filter_ricci::host {

/// A picture of a texture: an image of Qt, with its colour space and its resolution.
class Picture
{
public:
	/// None.
	Picture() = default;
	explicit Picture(const QImage& image) : m_image(image) {}
	/// A square to draw on, of four samples for each texel, of 16 bits or of 8.
	/// \param like whose colour space and resolution it gets; null: none
	/// \throw std::bad_alloc
	Picture(int size, bool hasWords, bool hasAlpha, const Picture* like);

	bool isNull() const { return m_image.isNull(); }
	int width() const { return m_image.width(); }
	int height() const { return m_image.height(); }
	bool hasAlpha() const { return m_image.hasAlphaChannel(); }
	/// Whether its samples have more than 8 bits.
	bool hasWords() const;

	/// Gives it the samples and the colour space of another one. \throw std::bad_alloc
	void convertFor(const Picture& other);

	/// Row by row, red, green, blue and alpha; of pictures that were converted or made so.
	const void* samples() const { return m_image.constBits(); }
	void* samples() { return m_image.bits(); }

	/// Takes bytes of a file. It may throw.
	using Sink = std::function<void(const char* data, std::size_t size)>;
	/// \return whether the file could be made \throw what \p sink does
	bool writePng(const Sink& sink) const;

	const QImage& image() const { return m_image; }

private:
	QImage m_image;
};

} // namespace filter_ricci::host

#endif
