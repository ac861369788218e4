#include "trace/work_file.hpp"

#include "trace/fingerprint.hpp"

namespace nacre::trace {
namespace {

constexpr std::uint64_t maxWorkBytes = std::uint64_t{32} << 30;
constexpr std::uint32_t maxTexts = 64;
constexpr std::uint32_t maxTextLength = 4096;

std::uint64_t checksumOf(std::span<const std::uint8_t> bytes) {
    Fingerprint print;
    print.add(std::as_bytes(bytes));
    return print.value();
}

} // namespace

std::filesystem::path checkpointOf(const std::filesystem::path& result) {
    return result.string() + ".checkpoint";
}

void requireSameIdentity(const std::filesystem::path& file, const Identity& found, const Identity& expected) {
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const auto& [name, value] = expected[i];
        if (i >= found.size() || found[i].first != name) {
            throw FileError(file.string() + ": says nothing of " + name);
        }
        if (found[i].second != value) {
            throw FileError(file.string() + ": is of another " + name + ", '" + found[i].second + "' in place of '" +
                            value + "'");
        }
    }
}

WorkWriter::WorkWriter(std::string_view magic, const Identity& identity) : bytes_(magic.begin(), magic.end()) {
    put(static_cast<std::uint32_t>(identity.size()));
    for (const auto& [name, value] : identity) {
        putText(name);
        putText(value);
    }
}

void WorkWriter::putText(std::string_view text) {
    put(static_cast<std::uint32_t>(text.size()));
    bytes_.insert(bytes_.end(), text.begin(), text.end());
}

void WorkWriter::save(const std::filesystem::path& file) {
    put(checksumOf(bytes_));
    writeFileAtomically(file, bytes_);
    bytes_.erase(bytes_.end() - static_cast<std::ptrdiff_t>(sizeof(std::uint64_t)), bytes_.end());
}

WorkReader::WorkReader(const std::filesystem::path& file, std::string_view magic, std::string_view what)
    : name_(file.string()), bytes_(readFile(file, maxWorkBytes)), rest_(bytes_) {
    if (bytes_.size() < magic.size() + sizeof(std::uint64_t) ||
        std::memcmp(bytes_.data(), magic.data(), magic.size()) != 0) {
        throw FileError(name_ + ": is not " + std::string(what));
    }
    rest_ = std::span(bytes_).first(bytes_.size() - sizeof(std::uint64_t));
    const std::uint64_t checksum = checksumOf(rest_);
    require(std::memcmp(&checksum, bytes_.data() + rest_.size(), sizeof checksum) == 0);
    take(magic.size());
    const auto texts = get<std::uint32_t>();
    require(texts <= maxTexts);
    for (std::uint32_t i = 0; i < texts; ++i) {
        std::string name = getText();
        std::string value = getText();
        identity_.emplace_back(std::move(name), std::move(value));
    }
}

void WorkReader::require(bool condition) const {
    if (!condition) {
        throw FileError(name_ + ": is damaged or cut off");
    }
}

std::string WorkReader::getText() {
    const auto length = get<std::uint32_t>();
    require(length <= maxTextLength);
    const std::span<const std::uint8_t> text = take(length);
    return {text.begin(), text.end()};
}

std::span<const std::uint8_t> WorkReader::take(std::size_t count) {
    require(count <= rest_.size());
    const std::span<const std::uint8_t> result = rest_.first(count);
    rest_ = rest_.subspan(count);
    return result;
}

} // namespace nacre::trace
