// Image files: what is written is what is read, files appear whole or not at all, damage is a sentence.
#include "core/files/isolated_process.hpp"
#include "image/image_file.hpp"

#include "nacre/files.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <turbojpeg.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <random>

using namespace nacre;
namespace fs = std::filesystem;

namespace {

class ImageFile : public testing::Test {
protected:
    std::size_t fileCount() const { return temporary.fileCount(); }
    fs::path store(const std::string& name, std::span<const std::uint8_t> bytes) const {
        std::ofstream(folder / name, std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
        return folder / name;
    }

    const nacre::tests::TemporaryFolder temporary;
    const fs::path& folder = temporary.path;
};

template <typename Action> std::string errorOf(Action action) {
    try {
        action();
    } catch (const FileError& failure) {
        return failure.what();
    }
    return "";
}

std::vector<std::uint8_t> pattern(std::size_t size) {
    std::vector<std::uint8_t> bytes(size);
    for (std::size_t i = 0; i < size; ++i) {
        bytes[i] = static_cast<std::uint8_t>(i * 37 + i / 5);
    }
    return bytes;
}

/// A picture whose every value is one of 256 steps.
Image steps(std::uint32_t width, std::uint32_t height, std::vector<std::string> channels = {"R", "G", "B"}) {
    Image image = makeImage(width, height, std::move(channels), Encoding::Srgb);
    const auto bytes = pattern(image.values.size());
    std::ranges::transform(bytes, image.values.begin(), [](std::uint8_t byte) { return float(byte) / 255; });
    return image;
}

std::vector<float> radiances(std::size_t count) {
    std::vector<float> values(count);
    for (std::size_t i = 0; i < count; ++i) {
        values[i] = std::ldexp(1.0f + static_cast<float>(i % 7) / 7, static_cast<int>(i % 20) - 10);
    }
    return values;
}

/// A picture of radiances.
Image glow(std::uint32_t width, std::uint32_t height, std::vector<std::string> channels = {"R", "G", "B"}) {
    Image image{width, height, std::move(channels), {}};
    image.values = radiances(image.pixelCount() * image.channels.size());
    return image;
}

TEST_F(ImageFile, PngKeepsEveryByte) {
    for (const std::vector<std::string>& channels :
         {std::vector<std::string>{"Y"}, {"R", "G", "B"}, {"R", "G", "B", "A"}}) {
        const Image image = steps(5, 3, channels);
        writePng(folder / "a.png", image);
        EXPECT_EQ(readImage(folder / "a.png"), image);
    }
    EXPECT_EQ(fileCount(), 1u); // no temporary is left
}

TEST_F(ImageFile, PngOfLinearValuesIsEncoded) {
    const Image linear{4, 1, {"Y"}, {0, 0.2158605f, 1, 7}}; // ((128/255 + 0.055) / 1.055)^2.4
    writePng(folder / "a.png", linear);
    EXPECT_EQ(readImage(folder / "a.png").values, (std::vector<float>{0, 128 / 255.0f, 1, 1}));
}

TEST_F(ImageFile, TexturesHaveFourBytesAPixel) {
    const Image image = steps(5, 3);
    writePng(folder / "a.png", image);
    const ByteImage bytes = decodeBytes(readFile(folder / "a.png"), "a.png");
    ASSERT_EQ(bytes.rgba.size(), 60u);
    for (std::size_t i = 0; i < 60; ++i) {
        const float expected = i % 4 == 3 ? 1 : image.values[i / 4 * 3 + i % 4];
        EXPECT_EQ(float(bytes.rgba[i]) / 255, expected);
    }
}

TEST_F(ImageFile, PngOf16BitsIsRead) {
    // A grey PNG of 2 x 1 pixels of 16 bits, values 0x1234 and 0xffff.
    const std::vector<std::uint8_t> png{
        0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44, 0x52, 0x00, 0x00,
        0x00, 0x02, 0x00, 0x00, 0x00, 0x01, 0x10, 0x00, 0x00, 0x00, 0x00, 0x81, 0xd9, 0xfc, 0x15, 0x00, 0x00, 0x00,
        0x0d, 0x49, 0x44, 0x41, 0x54, 0x78, 0x9c, 0x63, 0x10, 0x32, 0xf9, 0xff, 0x1f, 0x00, 0x03, 0xe6, 0x02, 0x45,
        0x2e, 0x42, 0x96, 0x75, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
    const Image image = readImage(store("deep.png", png));
    EXPECT_EQ(image.channels, (std::vector<std::string>{"Y"}));
    EXPECT_EQ(image.values, (std::vector<float>{0x1234 / 65535.0f, 1}));
}

TEST_F(ImageFile, JpegIsReadAsItWasWritten) {
    const Image image = steps(16, 16);
    writeJpeg(folder / "a.jpg", image, 100);
    const Image read = readImage(folder / "a.jpg");
    EXPECT_EQ(read.channels, (std::vector<std::string>{"R", "G", "B"}));
    ASSERT_EQ(read.values.size(), image.values.size());
    double difference = 0;
    for (std::size_t i = 0; i < image.values.size(); ++i) {
        difference += std::abs(read.values[i] - image.values[i]) / static_cast<double>(image.values.size());
    }
    EXPECT_LT(difference, 0.02);
    std::vector<std::uint8_t> cut = readFile(folder / "a.jpg");
    cut.resize(cut.size() / 2);
    EXPECT_NE(errorOf([&] { decodeBytes(cut, "cut.jpg"); }).find("cut.jpg: the JPEG image cannot be decoded"),
              std::string::npos);
}

/// A JPEG of one colour of ink, which says so with Adobe's marker.
std::vector<std::uint8_t> inkJpeg(const std::array<std::uint8_t, 4>& cmyk) {
    std::vector<std::uint8_t> samples;
    for (int i = 0; i < 64; ++i) {
        samples.insert(samples.end(), cmyk.begin(), cmyk.end());
    }
    unsigned char* encoded = nullptr;
    unsigned long size = 0;
    const tjhandle compressor = tjInitCompress();
    tjCompress2(compressor, samples.data(), 8, 0, 8, TJPF_CMYK, &encoded, &size, TJSAMP_444, 100, 0);
    const std::vector<std::uint8_t> bytes(encoded, encoded + size);
    tjFree(encoded);
    tjDestroy(compressor);
    return bytes;
}

TEST_F(ImageFile, JpegOfInkIsWhatTheInkLeaves) {
    // Adobe's programs store what ink leaves: full cyan is 0.
    const ByteImage adobe = decodeBytes(inkJpeg({0, 255, 255, 255}), "ink");
    EXPECT_NEAR(adobe.rgba[0], 0, 3);
    EXPECT_NEAR(adobe.rgba[1], 255, 3);
    const ByteImage dark = decodeBytes(inkJpeg({255, 255, 255, 128}), "ink");
    EXPECT_NEAR(dark.rgba[2], 128, 3);
    // Without the marker the same numbers are shares of ink, and not turned into other ones: no cyan, half magenta and
    // yellow, no black.
    std::vector<std::uint8_t> plain = inkJpeg({255, 255, 255, 0});
    const std::array<std::uint8_t, 2> marker{0xff, 0xee};
    const auto found = std::search(plain.begin(), plain.end(), marker.begin(), marker.end());
    ASSERT_NE(found, plain.end());
    plain.erase(found, found + 2 + (found[2] << 8 | found[3]));
    const ByteImage ink = decodeBytes(plain, "ink");
    EXPECT_NEAR(ink.rgba[0], 255, 3);
    EXPECT_NEAR(ink.rgba[1], 127, 3);
    EXPECT_NEAR(ink.rgba[2], 127, 3);
}

TEST_F(ImageFile, PicturesThatAreCutOffAreRefused) {
    writePng(folder / "a.png", steps(64, 64));
    std::vector<std::uint8_t> png = readFile(folder / "a.png");
    for (const std::size_t size : {png.size() / 2, std::size_t{20}, std::size_t{9}}) {
        const std::vector<std::uint8_t> cut(png.begin(), png.begin() + static_cast<std::ptrdiff_t>(size));
        EXPECT_NE(errorOf([&] { decodeBytes(cut, "cut.png"); }).find("cut.png: the PNG image cannot be decoded"),
                  std::string::npos)
            << size;
    }
}

TEST_F(ImageFile, ImagesOfFormatsThatNobodyAskedForAreNotRead) {
    const std::string pnm = "P6 2 2 65535\n" + std::string(24, 'x');
    EXPECT_NE(errorOf([&] {
                  decodeBytes(std::span(reinterpret_cast<const std::uint8_t*>(pnm.data()), pnm.size()), "a.ppm");
              }).find("a.ppm: is not a PNG, JPEG, WebP, BMP or TGA image"),
              std::string::npos);
}

TEST_F(ImageFile, ExrKeepsFloatsAndRoundsHalves) {
    const Image image = glow(4, 6, {"R", "G", "B", "A"}); // not the file's alphabetical order
    writeExr(folder / "float.exr", image);
    EXPECT_EQ(readImage(folder / "float.exr"), image);
    EXPECT_EQ(readRadiance(folder / "float.exr"), image);
    writeExr(folder / "half.exr", image, ExrPrecision::Half);
    const Image half = readImage(folder / "half.exr");
    for (std::size_t i = 0; i < image.values.size(); ++i) {
        EXPECT_NEAR(half.values[i], image.values[i], std::ldexp(image.values[i], -11));
    }
    EXPECT_LT(fs::file_size(folder / "half.exr"), fs::file_size(folder / "float.exr"));
}

TEST_F(ImageFile, ExrKeepsAllChannelsByName) {
    const Image image = glow(3, 2, {"variance.G", "B", "G", "Z", "R", "variance.B", "variance.R"});
    writeExr(folder / "a.exr", image);
    const Image read = readImage(folder / "a.exr");
    EXPECT_EQ(read.channels, (std::vector<std::string>{"R", "G", "B", "Z", "variance.B", "variance.G", "variance.R"}));
    EXPECT_EQ(selectChannels(read, image.channels), image);
    EXPECT_EQ(readRadiance(folder / "a.exr").channels, (std::vector<std::string>{"R", "G", "B", "A"}));
}

TEST_F(ImageFile, ExrOfOneChannelIsGrey) {
    const std::vector<float> depth{0.5f, -2, 1e6f, 0};
    writeExr(folder / "depth.exr", {2, 2, {"Z"}, depth});
    const Image image = readRadiance(folder / "depth.exr");
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(image.values[i * 4], depth[i]);
        EXPECT_EQ(image.values[i * 4 + 2], depth[i]);
        EXPECT_EQ(image.values[i * 4 + 3], 1);
    }
    EXPECT_EQ(readImage(folder / "depth.exr").values, depth);
}

TEST_F(ImageFile, ExrWithoutColoursIsNoRadiance) {
    writeExr(folder / "a.exr", glow(2, 2, {"X", "Y"}));
    EXPECT_EQ(errorOf([&] { readRadiance(folder / "a.exr"); }), (folder / "a.exr").string() + ": has no channel R");
    writeExr(folder / "a.exr", glow(2, 2, {"R", "G"}));
    EXPECT_EQ(errorOf([&] { readRadiance(folder / "a.exr"); }), (folder / "a.exr").string() + ": has no channel B");
}

TEST_F(ImageFile, HdrKeepsValuesToEightBitsOfTheLargest) {
    const Image image = glow(9, 4);
    writeHdr(folder / "a.hdr", image);
    const Image read = readImage(folder / "a.hdr");
    EXPECT_EQ(read.channels, image.channels);
    for (std::size_t pixel = 0; pixel < image.values.size(); pixel += 3) {
        const float largest = std::max({image.values[pixel], image.values[pixel + 1], image.values[pixel + 2]});
        for (std::size_t i = pixel; i < pixel + 3; ++i) {
            EXPECT_NEAR(read.values[i], image.values[i], largest / 127);
        }
    }
}

TEST_F(ImageFile, IsWrittenByTheEndingOfItsName) {
    for (const char* name : {"a.png", "a.jpg", "a.exr", "a.hdr"}) {
        writeImage(folder / name, glow(3, 2));
        EXPECT_EQ(readImage(folder / name).width, 3u) << name;
    }
    EXPECT_NE(errorOf([&] { writeImage(folder / "a.tif", glow(3, 2)); }).find("ends in .png"), std::string::npos);
}

TEST_F(ImageFile, JpegStaysNear) {
    constexpr std::uint32_t side = 64;
    Image image = makeImage(side, side, {"R", "G", "B"}, Encoding::Srgb);
    for (std::uint32_t i = 0; i < side * side; ++i) {
        const float ramp = static_cast<float>(2 * (i % side) + 2 * (i / side)) / 255;
        std::ranges::copy(std::array{ramp, 1 - ramp, 0.5f}, image.values.begin() + 3 * i);
    }
    writeJpeg(folder / "a.jpg", image);
    const Image read = readImage(folder / "a.jpg");
    ASSERT_EQ(read.width, side);
    ASSERT_EQ(read.height, side);
    for (std::size_t i = 0; i < image.values.size(); ++i) {
        EXPECT_NEAR(read.values[i], image.values[i], 8 / 255.0) << i;
    }
    EXPECT_NE(errorOf([&] { writeJpeg(folder / "b.jpg", {side, side, image.channels, radiances(5)}); }), "");
    EXPECT_NE(errorOf([&] { writeJpeg(folder / "b.jpg", glow(70000, 1)); }), "");
    EXPECT_NE(errorOf([&] { writeJpeg(folder / "b.jpg", glow(2, 2, {"Y"})); }), "");
    EXPECT_EQ(fileCount(), 1u);
}

TEST_F(ImageFile, HdrDecodesItsSharedExponent) {
    std::string text = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n";
    text += std::string("\x80\x40\x00\x81", 4) + std::string("\x80\x80\x80\x78", 4);
    store("a.hdr", std::vector<std::uint8_t>(text.begin(), text.end()));
    const Image image = readRadiance(folder / "a.hdr");
    ASSERT_EQ(image.width, 2u);
    EXPECT_EQ(image.values,
              (std::vector<float>{1, 0.5f, 0, 1, std::ldexp(1.0f, -9), std::ldexp(1.0f, -9), std::ldexp(1.0f, -9), 1}));
}

TEST_F(ImageFile, HdrDecodesRunsAndRefusesWhatIsCutOff) {
    // Ten pixels of (1, 0.5, 0): red and green as runs, blue as it is, the exponent as two runs.
    const std::string header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 10\n";
    const std::string scanline = std::string("\x02\x02\x00\x0a\x8a\x80\x8a\x40\x0a", 9) + std::string(10, '\0') +
                                 std::string("\x84\x81\x86\x81", 4);
    const auto bytesOf = [](const std::string& text) { return std::vector<std::uint8_t>(text.begin(), text.end()); };
    const std::string whole = header + scanline + scanline;
    store("runs.hdr", bytesOf(whole));
    const Image image = readRadiance(folder / "runs.hdr");
    ASSERT_EQ(image.values.size(), 80u);
    for (std::size_t i = 0; i < image.values.size(); i += 4) {
        EXPECT_EQ(std::vector<float>(&image.values[i], &image.values[i] + 4), (std::vector<float>{1, 0.5f, 0, 1}));
    }
    for (std::size_t size = header.size(); size < whole.size(); ++size) {
        store("cut.hdr", bytesOf(whole.substr(0, size)));
        const std::string row = size < header.size() + scanline.size() ? "row 0 of 2" : "row 1 of 2";
        EXPECT_NE(errorOf([&] { readRadiance(folder / "cut.hdr"); }).find(row), std::string::npos) << size;
    }
    for (const std::string& wrong : {std::string("\x02\x02\x00\x0b", 4), std::string("\x02\x02\x00\x0a\x8b\x80", 6),
                                     std::string("\x02\x02\x00\x0a\x00", 5)}) {
        store("wrong.hdr", bytesOf(header + wrong + whole));
        EXPECT_NE(errorOf([&] { readRadiance(folder / "wrong.hdr"); }), "");
    }
    EXPECT_NE(errorOf([&] { decodeBytes(readFile(folder / "runs.hdr"), "runs.hdr"); }).find("runs.hdr"),
              std::string::npos);
    EXPECT_NE(errorOf([&] { decodeBytes(readFile(folder / "cut.hdr"), "cut.hdr"); }).find("cut.hdr"),
              std::string::npos);
}

TEST_F(ImageFile, HdrSaysWhatIsWrongWithItsHeader) {
    const auto errorWith = [this](const std::string& text) {
        store("header.hdr", std::vector<std::uint8_t>(text.begin(), text.end()));
        return errorOf([&] { readRadiance(folder / "header.hdr"); });
    };
    const std::string pixel("\x80\x40\x00\x81", 4);
    EXPECT_EQ(errorWith("#?RGBE\nEXPOSURE=1\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n" + pixel), "");
    EXPECT_NE(errorWith("#?RADIANCE\n\n-Y 1 +X 1\n" + pixel).find("has no line FORMAT=32-bit_rle_rgbe"),
              std::string::npos);
    for (const std::string size :
         {"+Y 1 +X 1", "-Y 1", "-Y 1 +X", "-Y -1 +X 1", "-Y 1 +X 1 ", "", "-Y 99999999999999999999 +X 1"}) {
        const std::string error = errorWith("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n" + size + "\n" + pixel);
        EXPECT_NE(error.find("gives the size as \"" + size + "\", must be"), std::string::npos) << error;
    }
}

// stb_image, which reads these, runs in a process of its own: what ends it is a sentence here.
TEST_F(ImageFile, BitmapsAreDecodedElsewhere) {
    std::vector<std::uint8_t> tga{0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 1, 0, 24, 0x20};
    tga.insert(tga.end(), {1, 2, 3, 4, 5, 6});
    const ByteImage image = decodeBytes(tga, "a.tga");
    EXPECT_EQ(image.width, 2u);
    EXPECT_EQ(image.height, 1u);
    EXPECT_EQ(image.rgba, (std::vector<std::uint8_t>{3, 2, 1, 255, 6, 5, 4, 255}));
    tga[13] = tga[15] = 8; // 2050 x 2049
    EXPECT_EQ(errorOf([&] { decodeBytes(tga, "a.tga"); }),
              "a.tga: the BMP or TGA image is cut off: 24 bytes cannot hold 2050 x 2049 pixels");
    tga[13] = tga[15] = 0;
    tga[12] = 0; // no width
    EXPECT_EQ(errorOf([&] { decodeBytes(tga, "a.tga"); }),
              "a.tga: is not a PNG, JPEG, WebP, BMP or TGA image that can be read");
    EXPECT_EQ(errorOf([] { nacre::runIsolated("a.bmp", {}, []() -> std::vector<std::uint8_t> { std::abort(); }); }),
              "a.bmp: is damaged: reading it fails with \"Aborted\"");
}

// Rows from the bottom up, and, with a negative height, from the top down.
TEST_F(ImageFile, BitmapsHaveTheirRowsEitherWay) {
    for (const std::uint8_t sign : {std::uint8_t{0}, std::uint8_t{0xff}}) {
        std::vector<std::uint8_t> bmp{'B', 'M', 62, 0, 0, 0, 0, 0, 0, 0, 54, 0, 0, 0, 40, 0, 0, 0, 1, 0, 0, 0};
        bmp.push_back(sign == 0 ? 2 : 0xfe); // 2 or -2
        bmp.insert(bmp.end(), {sign, sign, sign, 1, 0, 24, 0});
        bmp.resize(54);
        bmp.insert(bmp.end(), {1, 2, 3, 0, 4, 5, 6, 0});
        const ByteImage image = decodeBytes(bmp, "a.bmp");
        EXPECT_EQ(image.height, 2u);
        EXPECT_EQ(image.rgba[0], sign == 0 ? 6 : 3);
        EXPECT_EQ(image.rgba[4], sign == 0 ? 3 : 6);
    }
}

// OpenEXR would make room for two gigabytes.
TEST_F(ImageFile, ExrMayNotClaimLongAttributes) {
    writeExr(folder / "a.exr", glow(2, 2));
    std::vector<std::uint8_t> exr = readFile(folder / "a.exr");
    const std::string attribute("lineOrder\0lineOrder\0\1\0\0\0", 24);
    const auto found = std::search(exr.begin(), exr.end(), attribute.begin(), attribute.end());
    ASSERT_NE(found, exr.end());
    found[23] = 0x70;
    EXPECT_EQ(errorOf([&] { decodeImage(exr, "a.exr"); }),
              "a.exr: the OpenEXR header is damaged: its attribute \"lineOrder\" is longer than the file");
    found[23] = 0;
    found[20] = 2;
    EXPECT_EQ(errorOf([&] { decodeImage(exr, "a.exr"); }),
              "a.exr: the OpenEXR header is damaged: its attribute \"lineOrder\" has not the size of its type");
}

TEST_F(ImageFile, RefusesSizesThatDoNotFit) {
    const std::vector<std::string> rgb{"R", "G", "B"};
    const std::vector<float> values = radiances(12);
    EXPECT_NE(errorOf([&] { writePng(folder / "a.png", {0, 0, rgb, {}}); }), "");
    EXPECT_NE(errorOf([&] { writePng(folder / "a.png", {3, 2, rgb, values}); }), "");
    EXPECT_NE(errorOf([&] { writePng(folder / "a.png", {3, 2, {"Y", "A"}, values}); }), "");
    EXPECT_NE(errorOf([&] { writePng(folder / "a.png", {100000, 100000, rgb, values}); }), "");
    EXPECT_NE(errorOf([&] { writeExr(folder / "a.exr", {2, 2, rgb, radiances(3)}); }), "");
    EXPECT_NE(errorOf([&] { writeExr(folder / "a.exr", {2, 2, {}, {}}); }), "");
    EXPECT_NE(errorOf([&] { writeExr(folder / "a.exr", {2, 2, {"R", "R", ""}, values}); }), "");
    EXPECT_NE(errorOf([&] { writeHdr(folder / "a.hdr", {2, 2, {"R"}, radiances(4)}); }), "");
    EXPECT_EQ(fileCount(), 0u);
}

TEST_F(ImageFile, RefusesAbsurdSizesBeforeAllocating) {
    // A PNG header that claims 100000 x 100000 pixels.
    writePng(folder / "a.png", steps(2, 2));
    std::vector<std::uint8_t> png = readFile(folder / "a.png");
    for (const std::size_t at : {16u, 20u}) {
        png[at + 1] = 1;
        png[at + 2] = 0x86;
        png[at + 3] = 0xa0;
    }
    const std::uint32_t checksum = 0x27309c9f;
    for (std::size_t i = 0; i < 4; ++i) {
        png[29 + i] = static_cast<std::uint8_t>(checksum >> (24 - 8 * i));
    }
    const fs::path large = store("large.png", png);
    EXPECT_NE(errorOf([&] { readImage(large); }).find("image of 100000 x 100000 pixels cannot be read"),
              std::string::npos);
    const std::string hdr = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 90000 +X 90000\n";
    const fs::path sky = store("large.hdr", std::vector<std::uint8_t>(hdr.begin(), hdr.end()));
    EXPECT_NE(errorOf([&] { readRadiance(sky); }).find("90000 x 90000 pixels"), std::string::npos);
}

TEST_F(ImageFile, SaysWhyAFileCannotBeWritten) {
    const Image image = steps(2, 2);
    const fs::path missing = folder / "no" / "such" / "a.png";
    EXPECT_EQ(errorOf([&] { writePng(missing, image); }),
              missing.string() + ": cannot be written: No such file or directory");
    EXPECT_EQ(errorOf([&] { writePng(folder, image); }), folder.string() + ": cannot be written: Is a directory");
    EXPECT_EQ(errorOf([&] { writePng("/dev/full", image); }), "/dev/full: cannot be written: No space left on device");
    writePng("/dev/null", image); // stays a device
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
    EXPECT_EQ(fileCount(), 0u);
}

TEST_F(ImageFile, WritesThroughLinks) {
    store("target.png", pattern(3));
    fs::create_symlink(folder / "target.png", folder / "link.png");
    writePng(folder / "link.png", steps(2, 2));
    EXPECT_TRUE(fs::is_symlink(folder / "link.png"));
    EXPECT_EQ(readImage(folder / "target.png").width, 2u);
    EXPECT_EQ(fileCount(), 2u);
}

TEST_F(ImageFile, SaysWhyAFileCannotBeRead) {
    EXPECT_NE(errorOf([&] { readImage(folder / "no.png"); }).find("No such file"), std::string::npos);
    EXPECT_NE(errorOf([&] { readRadiance(folder); }).find("is not a file"), std::string::npos);
    const fs::path text = store("text.exr", pattern(100));
    EXPECT_EQ(errorOf([&] { readRadiance(text); }),
              text.string() + ": is neither an OpenEXR nor a Radiance .hdr image");
}

/// Every truncation and many changes: a sentence or an image, never a crash.
TEST_F(ImageFile, SurvivesDamage) {
    writePng(folder / "a.png", steps(9, 7, {"R", "G", "B", "A"}));
    writeExr(folder / "a.exr", glow(9, 20));
    std::mt19937 random(4);
    for (const char* name : {"a.png", "a.exr"}) {
        const std::vector<std::uint8_t> whole = readFile(folder / name);
        const auto read = [&](std::span<const std::uint8_t> bytes) {
            const fs::path damaged = store(std::string("damaged-") + name, bytes);
            return errorOf([&] { readImage(damaged); });
        };
        for (std::size_t size = 0; size < whole.size(); ++size) {
            const std::string sentence = read(std::span(whole).first(size));
            EXPECT_TRUE(size + 16 > whole.size() || !sentence.empty()) << name << " " << size;
        }
        for (int round = 0; round < 500; ++round) {
            std::vector<std::uint8_t> bytes = whole;
            bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
            read(bytes);
        }
    }
}

} // namespace
