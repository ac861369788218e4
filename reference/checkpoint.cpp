#include "reference/checkpoint.hpp"

#include "nacre/files.hpp"
#include "reference/fingerprint.hpp"

#include <cstring>

namespace nacre::reference {
namespace {

constexpr std::string_view checkpointMagic = "nacre reference checkpoint 1\n";
constexpr std::uint64_t maxCheckpointBytes = std::uint64_t{32} << 30;
constexpr std::uint32_t maxFilmSide = 16384;
constexpr std::uint32_t maxTexts = 64;
constexpr std::uint32_t maxTextLength = 4096;

class Writer {
public:
    template <typename Value> void put(const Value& value) {
        const auto* bytes = reinterpret_cast<const std::uint8_t*>(&value);
        bytes_.insert(bytes_.end(), bytes, bytes + sizeof(Value));
    }
    void putText(std::string_view text) {
        put(static_cast<std::uint32_t>(text.size()));
        putBytes(text);
    }
    void putBytes(std::string_view text) { bytes_.insert(bytes_.end(), text.begin(), text.end()); }
    const std::vector<std::uint8_t>& bytes() const { return bytes_; }

private:
    std::vector<std::uint8_t> bytes_;
};

class Reader {
public:
    Reader(std::span<const std::uint8_t> bytes, std::string name) : bytes_(bytes), name_(std::move(name)) {}
    template <typename Value> Value get() {
        Value value;
        std::memcpy(&value, take(sizeof(Value)).data(), sizeof(Value));
        return value;
    }
    std::string getText() {
        const auto length = get<std::uint32_t>();
        require(length <= maxTextLength);
        const std::span<const std::uint8_t> text = take(length);
        return {text.begin(), text.end()};
    }
    std::span<const std::uint8_t> take(std::size_t count) {
        require(count <= bytes_.size());
        const std::span<const std::uint8_t> result = bytes_.first(count);
        bytes_ = bytes_.subspan(count);
        return result;
    }
    void require(bool condition) const {
        if (!condition) {
            throw FileError(name_ + ": is damaged or cut off");
        }
    }
    std::size_t left() const { return bytes_.size(); }

private:
    std::span<const std::uint8_t> bytes_;
    std::string name_;
};

void putFilm(Writer& writer, const Film& film) {
    writer.put(film.width);
    writer.put(film.height);
    writer.put(film.seconds);
    writer.put(film.incidents.paths);
    writer.put(film.incidents.lost);
    writer.put(film.incidents.overlapped);
    writer.put(film.incidents.cut);
    for (std::size_t i = 0; i < film.pixels.size(); ++i) {
        writer.put(film.pixels[i].sum);
        writer.put(film.pixels[i].squares);
        writer.put(film.pixels[i].count);
        writer.put(film.materials[i]);
        writer.put(film.coverage[i]);
    }
}

Film getFilm(Reader& reader) {
    const auto width = reader.get<std::uint32_t>();
    const auto height = reader.get<std::uint32_t>();
    reader.require(width > 0 && height > 0 && width <= maxFilmSide && height <= maxFilmSide);
    constexpr std::size_t pixelBytes = 2 * sizeof(glm::dvec3) + 2 * sizeof(std::uint32_t) + sizeof(float);
    reader.require(reader.left() / pixelBytes >= std::size_t{width} * height);
    Film film(width, height);
    film.seconds = reader.get<double>();
    film.incidents.paths = reader.get<std::uint64_t>();
    film.incidents.lost = reader.get<std::uint64_t>();
    film.incidents.overlapped = reader.get<std::uint64_t>();
    film.incidents.cut = reader.get<std::uint64_t>();
    for (std::size_t i = 0; i < film.pixels.size(); ++i) {
        film.pixels[i].sum = reader.get<glm::dvec3>();
        film.pixels[i].squares = reader.get<glm::dvec3>();
        film.pixels[i].count = reader.get<std::uint32_t>();
        film.materials[i] = reader.get<std::uint32_t>();
        film.coverage[i] = reader.get<float>();
    }
    return film;
}

std::string partText(const Part& part) {
    return std::to_string(part.index) + "/" + std::to_string(part.count);
}

} // namespace

std::filesystem::path checkpointOf(const std::filesystem::path& picture) {
    return picture.string() + ".checkpoint";
}

void saveCheckpoint(const std::filesystem::path& file, const Checkpoint& checkpoint) {
    Writer writer;
    writer.putBytes(checkpointMagic);
    writer.put(static_cast<std::uint32_t>(checkpoint.identity.size()));
    for (const auto& [name, value] : checkpoint.identity) {
        writer.putText(name);
        writer.putText(value);
    }
    writer.put(checkpoint.part.index);
    writer.put(checkpoint.part.count);
    putFilm(writer, checkpoint.film);
    Fingerprint print;
    print.add(std::as_bytes(std::span(writer.bytes())));
    writer.put(print.value());
    writeFileAtomically(file, writer.bytes());
}

Checkpoint loadCheckpoint(const std::filesystem::path& file) {
    const std::vector<std::uint8_t> bytes = readFile(file, maxCheckpointBytes);
    if (bytes.size() < checkpointMagic.size() + sizeof(std::uint64_t) ||
        std::memcmp(bytes.data(), checkpointMagic.data(), checkpointMagic.size()) != 0) {
        throw FileError(file.string() + ": is not a checkpoint of `nacre reference`");
    }
    const std::span<const std::uint8_t> content = std::span(bytes).first(bytes.size() - sizeof(std::uint64_t));
    Fingerprint print;
    print.add(std::as_bytes(content));
    Reader reader(bytes, file.string());
    reader.take(checkpointMagic.size());
    Reader tail{std::span(bytes).last(sizeof(std::uint64_t)), file.string()};
    reader.require(tail.get<std::uint64_t>() == print.value());
    Checkpoint checkpoint;
    const auto texts = reader.get<std::uint32_t>();
    reader.require(texts <= maxTexts);
    for (std::uint32_t i = 0; i < texts; ++i) {
        const std::string name = reader.getText();
        checkpoint.identity.emplace_back(name, reader.getText());
    }
    checkpoint.part.index = reader.get<std::uint32_t>();
    checkpoint.part.count = reader.get<std::uint32_t>();
    reader.require(checkpoint.part.index >= 1 && checkpoint.part.index <= checkpoint.part.count);
    checkpoint.film = getFilm(reader);
    reader.require(reader.left() == sizeof(std::uint64_t));
    return checkpoint;
}

void requireSameIdentity(const std::filesystem::path& file, const Checkpoint& checkpoint,
                         const std::vector<std::pair<std::string, std::string>>& identity) {
    for (std::size_t i = 0; i < identity.size(); ++i) {
        const auto& [name, value] = identity[i];
        if (i >= checkpoint.identity.size() || checkpoint.identity[i].first != name) {
            throw FileError(file.string() + ": says nothing of " + name);
        }
        if (checkpoint.identity[i].second != value) {
            throw FileError(file.string() + ": is of another " + name + ", '" + checkpoint.identity[i].second +
                            "' in place of '" + value + "'");
        }
    }
}

Checkpoint merge(const std::vector<std::filesystem::path>& files) {
    Checkpoint whole;
    std::vector<bool> present;
    for (const std::filesystem::path& file : files) {
        const Checkpoint one = loadCheckpoint(file);
        if (present.empty()) {
            whole.identity = one.identity;
            whole.film = Film(one.film.width, one.film.height);
            present.resize(one.part.count);
        }
        requireSameIdentity(file, one, whole.identity);
        if (one.part.count != present.size() || one.film.width != whole.film.width ||
            one.film.height != whole.film.height) {
            throw FileError(file.string() + ": is part " + partText(one.part) + ", the first file one of " +
                            std::to_string(present.size()));
        }
        if (present[one.part.index - 1]) {
            throw FileError(file.string() + ": is part " + partText(one.part) + ", which another file is too");
        }
        present[one.part.index - 1] = true;
        whole.film.incidents += one.film.incidents;
        whole.film.seconds += one.film.seconds;
        for (std::uint32_t pixel = 0; pixel < whole.film.pixels.size(); ++pixel) {
            if (one.part.has(pixel)) {
                whole.film.pixels[pixel] = one.film.pixels[pixel];
                whole.film.materials[pixel] = one.film.materials[pixel];
                whole.film.coverage[pixel] = one.film.coverage[pixel];
            }
        }
    }
    for (std::size_t i = 0; i < present.size(); ++i) {
        if (!present[i]) {
            throw FileError("part " + std::to_string(i + 1) + "/" + std::to_string(present.size()) +
                            " is not among the files to merge");
        }
    }
    return whole;
}

} // namespace nacre::reference
