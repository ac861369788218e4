// Image files: what is written is what is read, files appear whole or not at all, damage is a sentence.
#include "scene/image.hpp"

#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <random>

using namespace nacre::scene;
namespace fs = std::filesystem;

namespace {

class Image : public testing::Test {
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
    } catch (const SceneError& failure) {
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

std::vector<float> radiances(std::size_t count) {
    std::vector<float> values(count);
    for (std::size_t i = 0; i < count; ++i) {
        values[i] = std::ldexp(1.0f + static_cast<float>(i % 7) / 7, static_cast<int>(i % 20) - 10);
    }
    return values;
}

TEST_F(Image, PngKeepsEveryByte) {
    for (const int channels : {3, 4}) {
        const auto pixels = pattern(5 * 3 * static_cast<std::size_t>(channels));
        writePng(folder / "a.png", 5, 3, channels, pixels);
        const Texture texture = readTexture(folder / "a.png", true);
        EXPECT_EQ(texture.width, 5u);
        EXPECT_EQ(texture.height, 3u);
        EXPECT_TRUE(texture.srgb);
        for (std::size_t i = 0; i < 15; ++i) {
            for (std::size_t c = 0; c < 4; ++c) {
                const bool given = c < static_cast<std::size_t>(channels);
                EXPECT_EQ(texture.pixels[i * 4 + c], given ? pixels[i * static_cast<std::size_t>(channels) + c] : 255);
            }
        }
    }
    EXPECT_EQ(fileCount(), 1u); // no temporary is left
}

TEST_F(Image, ExrKeepsFloatsAndRoundsHalves) {
    const std::vector<std::string> names{"R", "G", "B", "A"}; // not the file's alphabetical order
    const auto pixels = radiances(4 * 6 * 4);
    writeExr(folder / "float.exr", 6, 4, names, pixels);
    EXPECT_EQ(readFloatImage(folder / "float.exr").pixels, pixels);
    writeExr(folder / "half.exr", 6, 4, names, pixels, ExrPrecision::Half);
    const FloatImage half = readFloatImage(folder / "half.exr");
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        EXPECT_NEAR(half.pixels[i], pixels[i], std::ldexp(pixels[i], -11));
    }
    EXPECT_LT(fs::file_size(folder / "half.exr"), fs::file_size(folder / "float.exr"));
}

TEST_F(Image, ExrOfOneChannelIsGrey) {
    const std::vector<float> depth{0.5f, -2, 1e6f, 0};
    writeExr(folder / "depth.exr", 2, 2, std::vector<std::string>{"Z"}, depth);
    const FloatImage image = readFloatImage(folder / "depth.exr");
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(image.pixels[i * 4], depth[i]);
        EXPECT_EQ(image.pixels[i * 4 + 2], depth[i]);
        EXPECT_EQ(image.pixels[i * 4 + 3], 1);
    }
}

TEST_F(Image, JpegStaysNear) {
    constexpr std::uint32_t side = 64;
    std::vector<std::uint8_t> pixels;
    for (std::uint32_t i = 0; i < side * side; ++i) {
        const auto ramp = static_cast<std::uint8_t>(2 * (i % side) + 2 * (i / side));
        pixels.insert(pixels.end(), {ramp, static_cast<std::uint8_t>(255 - ramp), 128});
    }
    writeJpeg(folder / "a.jpg", side, side, pixels);
    const Texture texture = readTexture(folder / "a.jpg", true);
    ASSERT_EQ(texture.width, side);
    ASSERT_EQ(texture.height, side);
    for (std::size_t i = 0; i < std::size_t{side} * side; ++i) {
        for (std::size_t channel = 0; channel < 3; ++channel) {
            EXPECT_NEAR(texture.pixels[4 * i + channel], pixels[3 * i + channel], 8) << i;
        }
    }
    EXPECT_NE(errorOf([&] { writeJpeg(folder / "b.jpg", side, side, pattern(5)); }), "");
    EXPECT_NE(errorOf([&] { writeJpeg(folder / "b.jpg", 70000, 1, pattern(210000)); }), "");
    EXPECT_EQ(fileCount(), 1u);
}

TEST_F(Image, HdrDecodesItsSharedExponent) {
    std::string text = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n";
    text += std::string("\x80\x40\x00\x81", 4) + std::string("\x80\x80\x80\x78", 4);
    store("a.hdr", std::vector<std::uint8_t>(text.begin(), text.end()));
    const FloatImage image = readFloatImage(folder / "a.hdr");
    ASSERT_EQ(image.width, 2u);
    EXPECT_EQ(image.pixels,
              (std::vector<float>{1, 0.5f, 0, 1, std::ldexp(1.0f, -9), std::ldexp(1.0f, -9), std::ldexp(1.0f, -9), 1}));
}

TEST_F(Image, HdrDecodesRunsAndRefusesWhatIsCutOff) {
    // Ten pixels of (1, 0.5, 0): red and green as runs, blue as it is, the exponent as two runs.
    const std::string header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 10\n";
    const std::string scanline = std::string("\x02\x02\x00\x0a\x8a\x80\x8a\x40\x0a", 9) + std::string(10, '\0') +
                                 std::string("\x84\x81\x86\x81", 4);
    const auto bytesOf = [](const std::string& text) { return std::vector<std::uint8_t>(text.begin(), text.end()); };
    const std::string whole = header + scanline + scanline;
    store("runs.hdr", bytesOf(whole));
    const FloatImage image = readFloatImage(folder / "runs.hdr");
    ASSERT_EQ(image.pixels.size(), 80u);
    for (std::size_t i = 0; i < image.pixels.size(); i += 4) {
        EXPECT_EQ(std::vector<float>(&image.pixels[i], &image.pixels[i] + 4), (std::vector<float>{1, 0.5f, 0, 1}));
    }
    for (std::size_t size = header.size(); size < whole.size(); ++size) {
        store("cut.hdr", bytesOf(whole.substr(0, size)));
        const std::string row = size < header.size() + scanline.size() ? "row 0 of 2" : "row 1 of 2";
        EXPECT_NE(errorOf([&] { readFloatImage(folder / "cut.hdr"); }).find(row), std::string::npos) << size;
    }
    for (const std::string& wrong : {std::string("\x02\x02\x00\x0b", 4), std::string("\x02\x02\x00\x0a\x8b\x80", 6),
                                     std::string("\x02\x02\x00\x0a\x00", 5)}) {
        store("wrong.hdr", bytesOf(header + wrong + whole));
        EXPECT_NE(errorOf([&] { readFloatImage(folder / "wrong.hdr"); }), "");
    }
    EXPECT_NE(errorOf([&] { readTexture(folder / "runs.hdr", true); }).find("runs.hdr"), std::string::npos);
    EXPECT_NE(errorOf([&] { readTexture(folder / "cut.hdr", true); }).find("cut.hdr"), std::string::npos);
}

TEST_F(Image, RefusesSizesThatDoNotFit) {
    const auto pixels = pattern(12);
    EXPECT_NE(errorOf([&] { writePng(folder / "a.png", 0, 0, 3, {}); }), "");
    EXPECT_NE(errorOf([&] { writePng(folder / "a.png", 3, 2, 3, pixels); }), "");
    EXPECT_NE(errorOf([&] { writePng(folder / "a.png", 2, 2, 5, pixels); }), "");
    EXPECT_NE(errorOf([&] { writePng(folder / "a.png", 100000, 100000, 3, pixels); }), "");
    EXPECT_NE(errorOf([&] { writeExr(folder / "a.exr", 2, 2, std::vector<std::string>{"R"}, radiances(3)); }), "");
    EXPECT_NE(errorOf([&] { writeExr(folder / "a.exr", 2, 2, {}, {}); }), "");
    EXPECT_EQ(fileCount(), 0u);
}

TEST_F(Image, RefusesAbsurdSizesBeforeAllocating) {
    // A PNG header that claims 100000 x 100000 pixels.
    writePng(folder / "a.png", 2, 2, 3, pattern(12));
    std::vector<std::uint8_t> png = readFile(folder / "a.png");
    for (const std::size_t at : {16u, 20u}) {
        png[at + 1] = 1;
        png[at + 2] = 0x86;
        png[at + 3] = 0xa0;
    }
    const fs::path large = store("large.png", png);
    EXPECT_NE(errorOf([&] { readTexture(large, true); }).find("of at most 16384 pixels a side"), std::string::npos);
    const std::string hdr = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 90000 +X 90000\n";
    const fs::path sky = store("large.hdr", std::vector<std::uint8_t>(hdr.begin(), hdr.end()));
    EXPECT_NE(errorOf([&] { readFloatImage(sky); }).find("90000 x 90000 pixels"), std::string::npos);
}

TEST_F(Image, SaysWhyAFileCannotBeWritten) {
    const auto pixels = pattern(12);
    const fs::path missing = folder / "no" / "such" / "a.png";
    EXPECT_EQ(errorOf([&] { writePng(missing, 2, 2, 3, pixels); }),
              missing.string() + ": cannot be written: No such file or directory");
    EXPECT_EQ(errorOf([&] { writePng(folder, 2, 2, 3, pixels); }),
              folder.string() + ": cannot be written: Is a directory");
    EXPECT_EQ(errorOf([&] { writePng("/dev/full", 2, 2, 3, pixels); }),
              "/dev/full: cannot be written: No space left on device");
    writePng("/dev/null", 2, 2, 3, pixels); // stays a device
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
    EXPECT_EQ(fileCount(), 0u);
}

TEST_F(Image, WritesThroughLinks) {
    store("target.png", pattern(3));
    fs::create_symlink(folder / "target.png", folder / "link.png");
    writePng(folder / "link.png", 2, 2, 3, pattern(12));
    EXPECT_TRUE(fs::is_symlink(folder / "link.png"));
    EXPECT_EQ(readTexture(folder / "target.png", false).width, 2u);
    EXPECT_EQ(fileCount(), 2u);
}

TEST_F(Image, SaysWhyAFileCannotBeRead) {
    EXPECT_NE(errorOf([&] { readTexture(folder / "no.png", true); }).find("No such file"), std::string::npos);
    EXPECT_NE(errorOf([&] { readFloatImage(folder); }).find("is not a file"), std::string::npos);
    const fs::path text = store("text.exr", pattern(100));
    EXPECT_EQ(errorOf([&] { readFloatImage(text); }),
              text.string() + ": is neither an OpenEXR nor a Radiance .hdr image");
}

/// Every truncation and many changes: a sentence or an image, never a crash.
TEST_F(Image, SurvivesDamage) {
    writePng(folder / "a.png", 9, 7, 4, pattern(9 * 7 * 4));
    writeExr(folder / "a.exr", 9, 20, std::vector<std::string>{"R", "G", "B"}, radiances(9 * 20 * 3));
    std::mt19937 random(4);
    for (const char* name : {"a.png", "a.exr"}) {
        const std::vector<std::uint8_t> whole = readFile(folder / name);
        const bool png = std::string_view(name).ends_with("png");
        const auto read = [&](std::span<const std::uint8_t> bytes) {
            const fs::path damaged = store(std::string("damaged-") + name, bytes);
            return errorOf([&] {
                if (png) {
                    readTexture(damaged, true);
                } else {
                    readFloatImage(damaged);
                }
            });
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
