// Work on disk while it is done, so that it can be gone on with: values in full precision, what they are of, and a
// checksum.
#pragma once

#include "nacre/files.hpp"

#include <cstring>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace nacre::trace {

/// Names and values that two runs must share so that one can go on where the other stopped.
using Identity = std::vector<std::pair<std::string, std::string>>;

/// "<result>.checkpoint".
std::filesystem::path checkpointOf(const std::filesystem::path& result);

/// Throws FileError, naming the file and the first value that differs, unless `found`, which the file has, is
/// `expected`.
void requireSameIdentity(const std::filesystem::path& file, const Identity& found, const Identity& expected);

class WorkWriter {
public:
    /// magic: the file's first line, ending in a line break; tells kinds and versions apart.
    WorkWriter(std::string_view magic, const Identity& identity);

    /// A value without padding.
    template <typename Value> void put(const Value& value) {
        const auto* bytes = reinterpret_cast<const std::uint8_t*>(&value);
        bytes_.insert(bytes_.end(), bytes, bytes + sizeof(Value));
    }
    template <typename Value> void putAll(std::span<const Value> values) {
        const auto* bytes = reinterpret_cast<const std::uint8_t*>(values.data());
        bytes_.insert(bytes_.end(), bytes, bytes + values.size_bytes());
    }

    /// Writes the file whole or not at all. Throws FileError.
    void save(const std::filesystem::path& file);

private:
    void putText(std::string_view text);

    std::vector<std::uint8_t> bytes_;
};

/// Reads in the order in which it was written. Throws FileError naming the file where that is damaged or cut off.
class WorkReader {
public:
    /// what: the file's kind, as the error calls it: "a checkpoint of `nacre reference`".
    WorkReader(const std::filesystem::path& file, std::string_view magic, std::string_view what);

    const Identity& identity() const { return identity_; }

    template <typename Value> Value get() {
        Value value;
        std::memcpy(&value, take(sizeof(Value)).data(), sizeof(Value));
        return value;
    }
    template <typename Value> void getAll(std::span<Value> values) {
        std::memcpy(values.data(), take(values.size_bytes()).data(), values.size_bytes());
    }
    void require(bool condition) const;
    /// Bytes that are still to come.
    std::size_t left() const { return rest_.size(); }

private:
    std::string getText();
    std::span<const std::uint8_t> take(std::size_t count);

    std::string name_;
    std::vector<std::uint8_t> bytes_;
    std::span<const std::uint8_t> rest_;
    Identity identity_;
};

} // namespace nacre::trace
