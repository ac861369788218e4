#include "nacre/files.hpp"

#include <atomic>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace nacre {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& file, const std::string& what, int error) {
    throw FileError(file.string() + ": " + what + ": " + std::strerror(error));
}

class Descriptor {
public:
    explicit Descriptor(int value) : value_(value) {}
    Descriptor(Descriptor&&) = delete;
    ~Descriptor() {
        if (value_ >= 0) {
            ::close(value_);
        }
    }
    int get() const { return value_; }
    /// Closes early, because close() may be the first to report a full disk.
    int close() { return ::close(std::exchange(value_, -1)); }

private:
    int value_;
};

/// False with errno set when not everything could be written.
bool writeAll(int descriptor, std::span<const std::uint8_t> bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) {
            continue;
        }
        if (written < 0) {
            return false;
        }
        bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
    return true;
}

void writeInPlace(const fs::path& file, std::span<const std::uint8_t> bytes) {
    Descriptor descriptor(::open(file.c_str(), O_WRONLY | O_CLOEXEC));
    if (descriptor.get() < 0 || !writeAll(descriptor.get(), bytes) || descriptor.close() != 0) {
        fail(file, "cannot be written", errno);
    }
}

/// A neighbour's name that no other process or thread uses.
fs::path temporaryNeighbour(const fs::path& file) {
    static std::atomic<unsigned> counter{0};
    fs::path result = file;
    result += ".partial-" + std::to_string(::getpid()) + "-" + std::to_string(counter++);
    return result;
}

/// The file that a chain of links ends at, whether or not it is there. The chain is known to end.
fs::path followLinks(fs::path file) {
    while (fs::is_symlink(file)) {
        file = file.parent_path() / fs::read_symlink(file);
    }
    return file;
}

/// A file without a name, which the system removes when the process is killed; -1 where there is no such thing.
int openNameless(const fs::path& folder) {
    if (::access("/proc/self/fd", X_OK) != 0) { // `name` needs it
        return -1;
    }
    return ::open(folder.empty() ? "." : folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
}

/// Gives a nameless file its name; false with errno set.
bool name(int descriptor, const fs::path& file) {
    const std::string source = "/proc/self/fd/" + std::to_string(descriptor);
    return ::linkat(AT_FDCWD, source.c_str(), AT_FDCWD, file.c_str(), AT_SYMLINK_FOLLOW) == 0;
}

} // namespace

std::vector<std::uint8_t> readFile(const fs::path& file, std::uint64_t maxBytes) {
    Descriptor descriptor(::open(file.c_str(), O_RDONLY | O_CLOEXEC));
    struct stat status {};
    if (descriptor.get() < 0 || ::fstat(descriptor.get(), &status) != 0) {
        fail(file, "cannot be read", errno);
    }
    if (!S_ISREG(status.st_mode) && !S_ISFIFO(status.st_mode)) {
        throw FileError(file.string() + ": cannot be read: it is not a file");
    }
    const auto tooLarge = [&] {
        return FileError(file.string() + ": is larger than " + std::to_string(maxBytes >> 20) +
                         " MiB, the most that is read");
    };
    if (static_cast<std::uint64_t>(status.st_size) > maxBytes) {
        throw tooLarge();
    }
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(status.st_size));
    std::size_t size = 0;
    while (true) {
        if (size == bytes.size()) {
            bytes.resize(size + 65536);
        }
        const ssize_t count = ::read(descriptor.get(), bytes.data() + size, bytes.size() - size);
        if (count < 0 && errno == EINTR) {
            continue;
        }
        if (count < 0) {
            fail(file, "cannot be read", errno);
        }
        if (count == 0) {
            break;
        }
        size += static_cast<std::size_t>(count);
        if (size > maxBytes) {
            throw tooLarge();
        }
    }
    bytes.resize(size);
    return bytes;
}

void writeFileAtomically(const fs::path& file, std::span<const std::uint8_t> bytes) {
    struct stat status {};
    const bool exists = ::stat(file.c_str(), &status) == 0;
    if (!exists && errno != ENOENT) {
        fail(file, "cannot be written", errno);
    }
    if (exists && S_ISDIR(status.st_mode)) {
        fail(file, "cannot be written", EISDIR);
    }
    if (exists && !S_ISREG(status.st_mode)) {
        return writeInPlace(file, bytes);
    }
    const fs::path target = followLinks(file); // so that a link keeps pointing at what it points at
    const fs::path temporary = temporaryNeighbour(target);
    const int nameless = openNameless(target.parent_path());
    Descriptor descriptor(nameless >= 0 ? nameless // not every file system has those
                                        : ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
    if (descriptor.get() < 0) {
        fail(file, "cannot be written", errno);
    }
    if ((exists && ::fchmod(descriptor.get(), status.st_mode & 07777) != 0) || !writeAll(descriptor.get(), bytes) ||
        ::fsync(descriptor.get()) != 0 || (nameless >= 0 && !name(descriptor.get(), temporary)) ||
        descriptor.close() != 0 || ::rename(temporary.c_str(), target.c_str()) != 0) {
        const int error = errno;
        ::unlink(temporary.c_str());
        fail(file, "cannot be written", error);
    }
}

} // namespace nacre
