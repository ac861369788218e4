// PNG, by libpng. Errors come out of libpng by longjmp, so that the functions that call it own nothing.
#include "image/codecs.hpp"
#include "nacre/files.hpp"

#include <algorithm>
#include <bit>
#include <csetjmp>
#include <cstring>
#include <png.h>

namespace nacre {
namespace {

/// What libpng reads from, and what it says when it fails.
struct Source {
    std::span<const std::uint8_t> rest;
    std::string failure;
};

struct Reader {
    explicit Reader(Source& source)
        : png(png_create_read_struct(PNG_LIBPNG_VER_STRING, &source, onError, onWarning)),
          info(png != nullptr ? png_create_info_struct(png) : nullptr) {
        if (info == nullptr) {
            png_destroy_read_struct(&png, nullptr, nullptr);
            throw std::bad_alloc();
        }
        png_set_read_fn(png, &source, onRead);
    }
    ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;

    png_structp png;
    png_infop info;

private:
    [[noreturn]] static void onError(png_structp png, png_const_charp message) {
        static_cast<Source*>(png_get_error_ptr(png))->failure = message;
        png_longjmp(png, 1);
    }
    static void onWarning(png_structp, png_const_charp) {}
    static void onRead(png_structp png, png_bytep to, std::size_t count) {
        auto& source = *static_cast<Source*>(png_get_io_ptr(png));
        if (count > source.rest.size()) {
            png_error(png, "it is cut off");
        }
        std::memcpy(to, source.rest.data(), count);
        source.rest = source.rest.subspan(count);
    }
};

/// Grey, grey and alpha, RGB or RGBA of 8 or 16 bits, as this machine orders them. No gamma is applied.
bool readHeader(png_structp png, png_infop info) {
    if (setjmp(png_jmpbuf(png)) != 0) {
        return false;
    }
    png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX); // the caller says what is too large
    png_set_chunk_malloc_max(png, 1u << 24);
    png_read_info(png, info);
    png_set_expand(png);
    if constexpr (std::endian::native == std::endian::little) {
        png_set_swap(png);
    }
    png_set_interlace_handling(png);
    png_read_update_info(png, info);
    return true;
}

bool readRows(png_structp png, png_bytepp rows) {
    if (setjmp(png_jmpbuf(png)) != 0) {
        return false;
    }
    png_read_image(png, rows);
    return true;
}

void require(bool succeeded, const Source& source, const std::string& name) {
    if (!succeeded) {
        throw FileError(name + ": the PNG image cannot be decoded: " + source.failure);
    }
}

template <typename Sample> void readSamples(Reader& reader, IntegerImage& image, std::vector<Sample>& samples) {
    const std::size_t rowLength = image.width * image.channels;
    samples.resize(rowLength * image.height);
    std::vector<png_bytep> rows(image.height);
    for (std::size_t row = 0; row < rows.size(); ++row) {
        rows[row] = reinterpret_cast<png_bytep>(&samples[row * rowLength]);
    }
    if (!readRows(reader.png, rows.data())) {
        samples.clear();
    }
}

} // namespace

bool isPng(std::span<const std::uint8_t> bytes) {
    return bytes.size() >= 8 && png_sig_cmp(bytes.data(), 0, 8) == 0;
}

IntegerImage decodePng(std::span<const std::uint8_t> bytes, const std::string& name) {
    Source source{bytes, {}};
    Reader reader(source);
    require(readHeader(reader.png, reader.info), source, name);
    IntegerImage image{.width = png_get_image_width(reader.png, reader.info),
                       .height = png_get_image_height(reader.png, reader.info),
                       .channels = png_get_channels(reader.png, reader.info)};
    requireShowable(name, image.width, image.height);
    if (png_get_bit_depth(reader.png, reader.info) == 16) {
        readSamples(reader, image, image.words);
    } else {
        readSamples(reader, image, image.bytes);
    }
    require(!image.words.empty() || !image.bytes.empty(), source, name);
    return image;
}

} // namespace nacre
