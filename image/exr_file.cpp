// OpenEXR, by the OpenEXR library.
#include "image/codecs.hpp"
#include "nacre/files.hpp"

#include <OpenEXR/Iex.h>
#include <OpenEXR/ImfArray.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfTestFile.h>

#include <algorithm>
#include <array>
#include <cstring>

namespace nacre {
namespace {

/// Longest name of a channel that OpenEXR writes.
constexpr std::size_t maxNameLength = 255;

class MemoryInput : public Imf::IStream {
public:
    explicit MemoryInput(std::span<const std::uint8_t> bytes) : IStream("the file"), bytes_(bytes) {}
    bool read(char* target, int count) override {
        const auto size = static_cast<std::size_t>(count);
        if (position_ > bytes_.size() || size > bytes_.size() - position_) {
            throw Iex::InputExc("the file ends early");
        }
        std::memcpy(target, bytes_.data() + position_, size);
        position_ += size;
        return position_ < bytes_.size();
    }
    std::uint64_t tellg() override { return position_; }
    void seekg(std::uint64_t position) override { position_ = position; }

private:
    std::span<const std::uint8_t> bytes_;
    std::size_t position_ = 0;
};

class MemoryOutput : public Imf::OStream {
public:
    MemoryOutput() : OStream("the file") {}
    void write(const char* source, int count) override {
        const std::size_t end = position_ + static_cast<std::size_t>(count);
        bytes_.resize(std::max(bytes_.size(), end));
        std::memcpy(bytes_.data() + position_, source, static_cast<std::size_t>(count));
        position_ = end;
    }
    std::uint64_t tellp() override { return position_; }
    void seekp(std::uint64_t position) override { position_ = position; }
    std::span<const std::uint8_t> bytes() const { return bytes_; }

private:
    std::vector<std::uint8_t> bytes_;
    std::size_t position_ = 0;
};

/// OpenEXR's reason, without the file that it is about and the full stop: a part of a sentence.
std::string reasonOf(const std::exception& error) {
    std::string text = error.what();
    constexpr std::string_view file = "\"the file\". ";
    if (const std::size_t at = text.find(file); at != std::string::npos) {
        text.erase(0, at + file.size());
    }
    std::ranges::replace(text, '\n', ' ');
    while (!text.empty() && (text.back() == ' ' || text.back() == '.')) {
        text.pop_back();
    }
    return text;
}

/// R, G, B and A first, then the others by name.
std::vector<std::string> orderedNames(const Imf::ChannelList& list) {
    std::vector<std::string> names;
    for (const char* name : {"R", "G", "B", "A"}) {
        if (list.findChannel(name) != nullptr) {
            names.emplace_back(name);
        }
    }
    for (auto channel = list.begin(); channel != list.end(); ++channel) {
        if (std::ranges::find(names, channel.name()) == names.end()) {
            names.emplace_back(channel.name());
        }
    }
    return names;
}

std::vector<std::string> wantedNames(const Imf::ChannelList& list, ExrChannels wanted) {
    std::vector<std::string> names = orderedNames(list);
    if (wanted == ExrChannels::Color && names.size() > 1) {
        std::erase_if(names,
                      [](const std::string& name) { return name != "R" && name != "G" && name != "B" && name != "A"; });
    }
    return names;
}

/// Attributes that OpenEXR reads so many bytes of, whatever the file says.
struct FixedAttribute {
    std::string_view type;
    std::uint32_t size;
};
constexpr std::array fixedAttributes{
    FixedAttribute{"box2f", 16},   FixedAttribute{"box2i", 16},      FixedAttribute{"chromaticities", 32},
    FixedAttribute{"double", 8},   FixedAttribute{"compression", 1}, FixedAttribute{"deepImageState", 1},
    FixedAttribute{"envmap", 1},   FixedAttribute{"float", 4},       FixedAttribute{"int", 4},
    FixedAttribute{"keycode", 28}, FixedAttribute{"lineOrder", 1},   FixedAttribute{"m33d", 72},
    FixedAttribute{"m33f", 36},    FixedAttribute{"m44d", 128},      FixedAttribute{"m44f", 64},
    FixedAttribute{"rational", 8}, FixedAttribute{"tiledesc", 9},    FixedAttribute{"timecode", 8},
    FixedAttribute{"v2d", 16},     FixedAttribute{"v2f", 8},         FixedAttribute{"v2i", 8},
    FixedAttribute{"v3d", 24},     FixedAttribute{"v3f", 12},        FixedAttribute{"v3i", 12}};

/// Takes what stands before the next zero.
std::string takeText(std::span<const std::uint8_t>& bytes) {
    std::string text(bytes.begin(), std::ranges::find(bytes, 0));
    bytes = bytes.subspan(std::min(text.size() + 1, bytes.size()));
    return text;
}

/// Whether the list of channels takes all of its bytes.
bool isWholeChannelList(std::span<const std::uint8_t> bytes) {
    constexpr std::size_t channelSize = 16; // after its name
    while (!bytes.empty() && bytes[0] != 0) {
        takeText(bytes);
        bytes = bytes.subspan(std::min(channelSize, bytes.size()));
    }
    return bytes.size() == 1;
}

bool hasItsSize(std::span<const std::uint8_t> value, const std::string& type) {
    const auto* fixed = std::ranges::find(fixedAttributes, type, &FixedAttribute::type);
    return (fixed == fixedAttributes.end() || fixed->size == value.size()) &&
           (type != "chlist" || isWholeChannelList(value));
}

/// Throws where an attribute of the header is larger than the file, or has another size than OpenEXR reads: it makes
/// room for what an attribute claims before it reads it.
void requireWholeHeader(std::span<const std::uint8_t> bytes, const std::string& name) {
    constexpr std::size_t start = 8; // after the magic number and the version
    bytes = bytes.subspan(std::min(start, bytes.size()));
    for (std::string attribute = takeText(bytes); !attribute.empty(); attribute = takeText(bytes)) {
        const std::string type = takeText(bytes);
        std::uint32_t size = 0;
        const bool hasSize = bytes.size() >= sizeof(size);
        for (std::size_t i = 0; hasSize && i < sizeof(size); ++i) {
            size |= std::uint32_t{bytes[i]} << (8 * i);
        }
        bytes = bytes.subspan(std::min(sizeof(size), bytes.size()));
        const bool isInFile = hasSize && size <= bytes.size();
        if (!isInFile || !hasItsSize(bytes.first(size), type)) {
            throw FileError(name + ": the OpenEXR header is damaged: its attribute \"" + attribute.substr(0, 60) +
                            (isInFile ? "\" has not the size of its type" : "\" is longer than the file"));
        }
        bytes = bytes.subspan(size);
    }
}

void requireKnownKind(MemoryInput& input, const std::string& name) {
    bool isTiled = false;
    bool isDeep = false;
    bool isMultiPart = false;
    if (!Imf::isOpenExrFile(input, isTiled, isDeep, isMultiPart)) {
        throw FileError(name + ": the OpenEXR header is damaged");
    }
    if (isMultiPart || isDeep) {
        throw FileError(name + ": multi-part and deep OpenEXR files are not supported");
    }
}

Image decode(MemoryInput& input, const std::string& name, ExrChannels wanted) {
    requireKnownKind(input, name);
    input.seekg(0);
    Imf::InputFile file(input, 0);
    const Imath::Box2i window = file.header().dataWindow();
    const Imf::ChannelList& list = file.header().channels();
    const std::vector<std::string> names = wantedNames(list, wanted);
    const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
    const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
    requireReadable(name, width, height, names.size());
    if (names.empty()) {
        throw FileError(name + ": has no channel" + (wanted == ExrChannels::Color ? " R" : ""));
    }
    if (!file.isComplete()) {
        throw FileError(name + ": the OpenEXR file is not whole: pixels are missing");
    }
    Image image = makeImage(static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), names);
    const std::size_t stride = names.size() * sizeof(float);
    Imf::FrameBuffer target;
    for (std::size_t i = 0; i < names.size(); ++i) {
        const Imf::Channel& channel = list[names[i]];
        if (channel.xSampling != 1 || channel.ySampling != 1) {
            throw FileError(name + ": channel " + names[i] +
                            " has fewer pixels than the image, which is not supported");
        }
        target.insert(names[i],
                      Imf::Slice::Make(Imf::FLOAT, image.values.data() + i, window, stride, stride * image.width));
    }
    file.setFrameBuffer(target);
    file.readPixels(window.min.y, window.max.y);
    return image;
}

void requireWritable(const std::filesystem::path& file, const Image& image) {
    const bool namesFit = std::ranges::all_of(image.channels, [&](const std::string& name) {
        return !name.empty() && name.size() <= maxNameLength && std::ranges::count(image.channels, name) == 1;
    });
    const std::size_t count = image.pixelCount() * image.channels.size();
    if (count == 0 || !namesFit || count != image.values.size()) {
        throw FileError(file.string() + ": cannot write an OpenEXR file of " + std::to_string(image.width) + " x " +
                        std::to_string(image.height) + " pixels and " + std::to_string(image.channels.size()) +
                        " channels from " + std::to_string(image.values.size()) + " values" +
                        (namesFit ? "" : ", of channels whose names are empty, too long or the same"));
    }
}

template <typename Value>
void encode(MemoryOutput& output, const Image& image, Imf::PixelType type, const std::vector<Value>& values) {
    Imf::Header header(static_cast<int>(image.width), static_cast<int>(image.height));
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::FrameBuffer source;
    const std::size_t stride = image.channels.size() * sizeof(Value);
    for (std::size_t i = 0; i < image.channels.size(); ++i) {
        header.channels().insert(image.channels[i], Imf::Channel(type));
        const auto* first = reinterpret_cast<const char*>(values.data() + i);
        source.insert(image.channels[i], Imf::Slice(type, const_cast<char*>(first), stride, stride * image.width));
    }
    Imf::OutputFile file(output, header, 0);
    file.setFrameBuffer(source);
    file.writePixels(static_cast<int>(image.height));
}

} // namespace

bool isExr(std::span<const std::uint8_t> bytes) {
    constexpr std::array<std::uint8_t, 4> magic{0x76, 0x2f, 0x31, 0x01};
    return bytes.size() >= magic.size() && std::equal(magic.begin(), magic.end(), bytes.begin());
}

Image decodeExr(std::span<const std::uint8_t> bytes, const std::string& name, ExrChannels wanted) {
    static const bool isBounded = [] { // before anything is allocated for what a header claims
        Imf::Header::setMaxImageSize(maxImageSide, maxImageSide);
        Imf::Header::setMaxTileSize(maxImageSide, maxImageSide);
        return true;
    }();
    static_cast<void>(isBounded);
    try {
        requireWholeHeader(bytes, name);
        MemoryInput input(bytes);
        return decode(input, name, wanted);
    } catch (const Iex::BaseExc& error) {
        throw FileError(name + ": the OpenEXR file cannot be decoded: " + reasonOf(error));
    }
}

void writeExr(const std::filesystem::path& file, const Image& image, ExrPrecision precision) {
    requireWritable(file, image);
    MemoryOutput output;
    try {
        if (precision == ExrPrecision::Half) {
            encode(output, image, Imf::HALF, std::vector<half>(image.values.begin(), image.values.end()));
        } else {
            encode(output, image, Imf::FLOAT, image.values);
        }
    } catch (const Iex::BaseExc& error) {
        throw FileError(file.string() + ": the OpenEXR encoder failed: " + reasonOf(error));
    }
    writeFileAtomically(file, output.bytes());
}

} // namespace nacre
