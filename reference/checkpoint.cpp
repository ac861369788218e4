#include "reference/checkpoint.hpp"

namespace nacre::reference {
namespace {

constexpr std::string_view checkpointMagic = "nacre reference checkpoint 1\n";
constexpr std::uint32_t maxFilmSide = 16384;

void putFilm(trace::WorkWriter& writer, const Film& film) {
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

Film getFilm(trace::WorkReader& reader) {
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

void saveCheckpoint(const std::filesystem::path& file, const Checkpoint& checkpoint) {
    trace::WorkWriter writer(checkpointMagic, checkpoint.identity);
    writer.put(checkpoint.part.index);
    writer.put(checkpoint.part.count);
    putFilm(writer, checkpoint.film);
    writer.save(file);
}

Checkpoint loadCheckpoint(const std::filesystem::path& file) {
    trace::WorkReader reader(file, checkpointMagic, "a checkpoint of `nacre reference`");
    Checkpoint checkpoint;
    checkpoint.identity = reader.identity();
    checkpoint.part.index = reader.get<std::uint32_t>();
    checkpoint.part.count = reader.get<std::uint32_t>();
    reader.require(checkpoint.part.index >= 1 && checkpoint.part.index <= checkpoint.part.count);
    checkpoint.film = getFilm(reader);
    reader.require(reader.left() == 0);
    return checkpoint;
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
        trace::requireSameIdentity(file, one.identity, whole.identity);
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
