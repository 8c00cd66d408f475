// SPDX-License-Identifier: GPL-3.0-or-later
#include "picture.h"

#include <QIODevice>
#include <QImageWriter>
#if QT_VERSION >= QT_VERSION_CHECK(5, 14, 0)
#include <QColorSpace>
#endif

#include <exception>
#include <new>
#include <utility>

namespace filter_ricci::host {

namespace {

/// Passes what is written on. No exception passes the library that writes: one of the sink makes the writing
/// fail, and is kept.
class SinkDevice : public QIODevice
{
public:
	explicit SinkDevice(const Picture::Sink& sink) : m_sink(sink)
	{
		open(QIODevice::WriteOnly | QIODevice::Unbuffered);
	}

	bool isSequential() const override { return true; }

	void rethrow() const
	{
		if (m_thrown)
			std::rethrow_exception(m_thrown);
	}

protected:
	qint64 readData(char*, qint64) override { return -1; }

	qint64 writeData(const char* data, qint64 size) override
	{
		try {
			m_sink(data, static_cast<std::size_t>(size));
			return size;
		}
		catch (...) {
			m_thrown = std::current_exception();
			return -1;
		}
	}

private:
	const Picture::Sink& m_sink;
	std::exception_ptr m_thrown;
};

} // namespace

Picture::Picture(int size, bool hasWords, bool hasAlpha, const Picture* like)
{
	const QImage::Format format =
		hasWords ? (hasAlpha ? QImage::Format_RGBA64 : QImage::Format_RGBX64)
				 : (hasAlpha ? QImage::Format_RGBA8888 : QImage::Format_RGBX8888);
	m_image = QImage(size, size, format);
	if (m_image.isNull())
		throw std::bad_alloc();
	m_image.fill(hasAlpha ? Qt::transparent : Qt::black);
	if (like == nullptr)
		return;
	m_image.setDotsPerMeterX(like->m_image.dotsPerMeterX());
	m_image.setDotsPerMeterY(like->m_image.dotsPerMeterY());
#if QT_VERSION >= QT_VERSION_CHECK(5, 14, 0)
	m_image.setColorSpace(like->m_image.colorSpace());
#endif
}

bool Picture::hasWords() const
{
	switch (m_image.format()) {
	case QImage::Format_BGR30:
	case QImage::Format_A2BGR30_Premultiplied:
	case QImage::Format_RGB30:
	case QImage::Format_A2RGB30_Premultiplied:
#if QT_VERSION >= QT_VERSION_CHECK(5, 12, 0)
	case QImage::Format_RGBX64:
	case QImage::Format_RGBA64:
	case QImage::Format_RGBA64_Premultiplied:
#endif
#if QT_VERSION >= QT_VERSION_CHECK(5, 13, 0)
	case QImage::Format_Grayscale16:
#endif
		return true;
	default:
		return false;
	}
}

void Picture::convertFor(const Picture& other)
{
#if QT_VERSION >= QT_VERSION_CHECK(5, 14, 0)
	if (m_image.colorSpace().isValid() && other.m_image.colorSpace().isValid() &&
		m_image.colorSpace() != other.m_image.colorSpace())
		m_image.convertToColorSpace(other.m_image.colorSpace());
#endif
	m_image = std::move(m_image).convertToFormat(
		other.hasWords() ? QImage::Format_RGBA64 : QImage::Format_RGBA8888);
	if (m_image.isNull())
		throw std::bad_alloc();
}

bool Picture::writePng(const Sink& sink) const
{
	SinkDevice device(sink);
	QImageWriter writer(&device, "png");
	writer.setQuality(70); // of compression: a sixth of the default's time, files a sixth larger
	const bool written = writer.write(m_image);
	device.rethrow();
	return written;
}

} // namespace filter_ricci::host
