// A parsed glTF file with its bytes: tinygltf reads the structure; the container, buffers, compression and accessors
// are read here, because tinygltf 2.7 trusts ranges and has no room for the fallback buffers of
// EXT_meshopt_compression.
#pragma once

#include "scene/load_budget.hpp"
#include "scene/named_file.hpp"

#include <deque>
#include <memory>
#include <span>
#include <tiny_gltf.h>

namespace nacre::scene {

using Bytes = std::vector<std::uint8_t>;

/// Most elements of one accessor, and most bytes of one decompressed buffer view.
inline constexpr std::size_t maxGltfElements = std::size_t{1} << 28;
inline constexpr std::size_t maxGltfViewBytes = std::size_t{1} << 30;

/// Where an image's bytes are; exactly one is set.
struct GltfImage {
    std::string uri;
    int bufferView = -1;
    std::string name;
};

struct GltfFile {
    explicit GltfFile(const std::filesystem::path& file)
        : path(file), named(std::make_shared<NamedFiles>(file)), budget(std::make_shared<LoadBudget>(file.string())) {}

    std::filesystem::path path;
    tinygltf::Model model; ///< without buffers and images
    std::vector<std::span<const std::uint8_t>> buffers;
    std::deque<Bytes> decodedUris;     ///< what buffers of data uris refer to
    std::shared_ptr<NamedFiles> named; ///< what other buffers and images refer to
    std::shared_ptr<LoadBudget> budget;
    std::vector<Bytes> decodedViews; ///< per buffer view; empty unless EXT_meshopt_compression
    std::size_t mostWithoutView = 0; ///< mostGltfElementsWithoutView
    std::vector<GltfImage> images;
    std::vector<std::string> notes; ///< what the file has and nothing here reads
};

/// Most elements of an accessor without a buffer view, which nothing in the file bears out: as many as one with a view
/// has, beside which it stands.
std::size_t mostGltfElementsWithoutView(const GltfFile& file);

/// Whether a file's animations are parsed: they can be most of it.
enum class GltfAnimations { Skipped, Read };

/// The container, the structure, the buffers and the compressed buffer views. `bytes` have to stay where they are for
/// as long as the result is used.
GltfFile openGltf(const std::filesystem::path& path, std::span<const std::uint8_t> bytes, GltfAnimations animations);

/// Throws SceneError: "FILE: what".
[[noreturn]] void failGltf(const GltfFile& file, const std::string& what);

/// `items[index]`, or a SceneError that says that `field` has no such element.
template <typename T>
const T& elementOf(const GltfFile& file, const std::vector<T>& items, int index, const std::string& field) {
    if (index < 0 || static_cast<std::size_t>(index) >= items.size()) {
        failGltf(file, field + " is " + std::to_string(index) + ", but there are only " + std::to_string(items.size()));
    }
    return items[static_cast<std::size_t>(index)];
}

/// `size` bytes of `bytes` from `offset` on, or a SceneError.
std::span<const std::uint8_t> slice(const GltfFile& file, std::span<const std::uint8_t> bytes, std::uint64_t offset,
                                    std::uint64_t size, const std::string& field);

/// The bytes of a buffer view, decompressed.
std::span<const std::uint8_t> viewBytes(const GltfFile& file, int view, const std::string& field);

bool isDataUri(const std::string& uri);
/// The bytes in a data uri.
Bytes decodeDataUri(const GltfFile& file, const std::string& uri, const std::string& field);
/// The bytes of the file beside the model, or below, that any other uri stands for. Read once.
std::span<const std::uint8_t> readUri(const GltfFile& file, const std::string& uri, const std::string& field);

/// An accessor's elements as floats, normalised integers mapped to [0, 1] or [-1, 1]; `components` is what its type
/// must have (0: any). Sparse accessors are applied.
std::vector<float> readFloats(const GltfFile& file, int accessor, int components, const std::string& field);

/// A scalar accessor's elements as unsigned integers.
std::vector<std::uint32_t> readIndices(const GltfFile& file, int accessor, const std::string& field);

/// Components of an accessor's elements: 1 to 4, or 4, 9, 16 for matrices.
int componentCount(const GltfFile& file, int accessor, const std::string& field);

} // namespace nacre::scene
