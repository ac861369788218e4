#include "scene/import_isolated.hpp"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fstream>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <type_traits>
#include <unistd.h>

namespace nacre::scene {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// Appends values to bytes.
class Writer {
public:
    template <typename T> void operator()(const T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        append(&value, sizeof(T));
    }
    void operator()(const std::string& text) { array(text.data(), text.size()); }
    template <typename T> void operator()(const std::vector<T>& values) {
        if constexpr (std::is_trivially_copyable_v<T>) {
            array(values.data(), values.size());
        } else {
            (*this)(values.size());
            for (const T& value : values) {
                exchange(*this, value);
            }
        }
    }
    Bytes bytes;

private:
    template <typename T> void array(const T* values, std::size_t count) {
        (*this)(count);
        append(values, count * sizeof(T));
    }
    void append(const void* data, std::size_t size) {
        const auto* begin = static_cast<const std::uint8_t*>(data);
        bytes.insert(bytes.end(), begin, begin + size);
    }
};

/// Takes values from bytes, in the same order. The bytes are from a child that may have gone astray: sizes are checked.
class Reader {
public:
    explicit Reader(std::span<const std::uint8_t> bytes) : rest_(bytes) {}

    template <typename T> void operator()(T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        take(&value, 1);
    }
    void operator()(std::string& text) {
        text.resize(count(1));
        take(text.data(), text.size());
    }
    template <typename T> void operator()(std::vector<T>& values) {
        values.resize(count(std::is_trivially_copyable_v<T> ? sizeof(T) : 1));
        if constexpr (std::is_trivially_copyable_v<T>) {
            take(values.data(), values.size());
        } else {
            for (T& value : values) {
                exchange(*this, value);
            }
        }
    }

private:
    std::size_t count(std::size_t elementSize) {
        std::size_t result = 0;
        (*this)(result);
        if (result > rest_.size() / elementSize) {
            throw std::length_error("damaged result");
        }
        return result;
    }
    template <typename T> void take(T* values, std::size_t number) {
        if (number * sizeof(T) > rest_.size()) {
            throw std::length_error("damaged result");
        }
        if (number > 0) {
            std::memcpy(static_cast<void*>(values), rest_.data(), number * sizeof(T));
        }
        rest_ = rest_.subspan(number * sizeof(T));
    }
    std::span<const std::uint8_t> rest_;
};

// exchange(archive, value): the members that cross, in one order for both directions.
template <typename A, typename T>
requires std::is_same_v<std::remove_const_t<T>, std::string>
void exchange(A& archive, T& text) {
    archive(text);
}
template <typename A, typename T>
requires std::is_same_v<std::remove_const_t<T>, Mesh>
void exchange(A& archive, T& mesh) {
    archive(mesh.name), archive(mesh.vertices), archive(mesh.indices), archive(mesh.surface);
}
template <typename A, typename T>
requires std::is_same_v<std::remove_const_t<T>, Texture>
void exchange(A& archive, T& texture) {
    archive(texture.name), archive(texture.width), archive(texture.height), archive(texture.srgb);
    archive(texture.wrapU), archive(texture.wrapV), archive(texture.nearest), archive(texture.pixels);
}
template <typename A, typename T>
requires std::is_same_v<std::remove_const_t<T>, Surface>
void exchange(A& archive, T& s) {
    archive(s.name), archive(s.baseColor), archive(s.metallic), archive(s.roughness), archive(s.specular);
    archive(s.normalScale), archive(s.emission), archive(s.baseColorTexture), archive(s.normalTexture);
    archive(s.metallicRoughnessTexture), archive(s.thicknessTexture), archive(s.emissionTexture);
    archive(s.uvTransform), archive(s.alphaMask);
    archive(s.alphaCutoff), archive(s.doubleSided), archive(s.thickness), archive(s.material);
}
template <typename A, typename T>
requires std::is_same_v<std::remove_const_t<T>, Instance>
void exchange(A& archive, T& instance) {
    archive(instance.name), archive(instance.mesh), archive(instance.transform);
}
template <typename A, typename T>
requires std::is_same_v<std::remove_const_t<T>, Light>
void exchange(A& archive, T& l) {
    archive(l.name), archive(l.kind), archive(l.color), archive(l.intensity), archive(l.position);
    archive(l.direction), archive(l.range), archive(l.innerConeAngle), archive(l.outerConeAngle);
    archive(l.castsShadow);
}
template <typename A, typename T>
requires std::is_same_v<std::remove_const_t<T>, Camera>
void exchange(A& archive, T& c) {
    archive(c.name), archive(c.position), archive(c.target), archive(c.up), archive(c.projection);
    archive(c.verticalFieldOfView), archive(c.orthographicHeight), archive(c.offCenter), archive(c.nearPlane);
    archive(c.farPlane);
}
template <typename A, typename T>
requires std::is_same_v<std::remove_const_t<T>, Scene>
void exchange(A& archive, T& scene) {
    archive(scene.name), archive(scene.meshes), archive(scene.textures), archive(scene.surfaces);
    archive(scene.instances), archive(scene.lights), archive(scene.cameras), archive(scene.metersPerUnit);
    archive(scene.exposure), archive(scene.inputs), archive(scene.notes);
}

enum class Outcome : std::uint8_t { Scene, Error };

void limitResources(const ImportLimits& limits) {
    std::uint64_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    const rlim_t memory = pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)) + limits.bytes;
    const rlimit memoryLimit{memory, memory};
    const rlimit timeLimit{limits.seconds, limits.seconds + 1}; // the first ends it with SIGXCPU
    const rlimit noCoreFile{0, 0};
    ::setrlimit(RLIMIT_AS, &memoryLimit);
    ::setrlimit(RLIMIT_CPU, &timeLimit);
    ::setrlimit(RLIMIT_CORE, &noCoreFile);
}

/// Silences the libraries' own last words: the parent says what happened.
void silence() {
    std::fclose(stderr);
    for (const int signal : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL}) {
        ::signal(signal, SIG_DFL);
    }
}

/// Ends the child when its parent ends, however that happens.
void followParent(pid_t parent) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) { // has ended already
        ::_exit(EIO);
    }
}

[[noreturn]] void runChild(pid_t parent, int pipe, const ImportLimits& limits, const std::function<Scene()>& read) {
    followParent(parent);
    silence();
    limitResources(limits);
    Writer writer;
    try {
        const Scene scene = read();
        writer(Outcome::Scene);
        exchange(writer, scene);
    } catch (const std::bad_alloc&) {
        ::_exit(ENOMEM);
    } catch (const std::exception& error) {
        writer.bytes.clear();
        writer(Outcome::Error);
        writer(std::string(error.what()));
    }
    std::span<const std::uint8_t> rest = writer.bytes;
    while (!rest.empty()) {
        const ssize_t written = ::write(pipe, rest.data(), rest.size());
        if (written < 0 && errno != EINTR) {
            ::_exit(EIO);
        }
        rest = rest.subspan(static_cast<std::size_t>(std::max<ssize_t>(written, 0)));
    }
    ::_exit(0);
}

/// Everything the child writes until it closes the pipe; false when the time is up.
bool readUntil(int pipe, std::chrono::steady_clock::time_point deadline, Bytes& bytes) {
    Bytes block(std::size_t{1} << 20);
    while (true) {
        const auto left =
            std::chrono::duration_cast<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now());
        pollfd waiting{pipe, POLLIN, 0};
        const int ready = left.count() > 0 ? ::poll(&waiting, 1, static_cast<int>(left.count())) : 0;
        if (ready == 0) {
            return false;
        }
        const ssize_t count = ready > 0 ? ::read(pipe, block.data(), block.size()) : -1;
        if (count < 0 && errno != EINTR) {
            return true; // what is missing is noticed by the reader
        }
        if (count == 0) {
            return true;
        }
        bytes.insert(bytes.end(), block.begin(), block.begin() + std::max<ssize_t>(count, 0));
    }
}

/// Why a child ended without a result; empty when it has one.
std::string failureOf(int status, bool inTime) {
    if (!inTime || (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)) {
        return "takes too long to read; it is probably damaged";
    }
    if (WIFSIGNALED(status)) {
        return "is damaged: reading it fails with \"" + std::string(::strsignal(WTERMSIG(status))) + "\"";
    }
    if (WEXITSTATUS(status) == ENOMEM) {
        return "needs more memory than its size explains; it is probably damaged";
    }
    return WEXITSTATUS(status) == 0 ? "" : "is damaged: reading it fails";
}

} // namespace

ImportLimits limitsFor(std::uint64_t fileBytes) {
    ImportLimits limits;
    limits.seconds += static_cast<unsigned>(fileBytes >> 19);
    limits.bytes += fileBytes * 64;
    return limits;
}

Scene runIsolated(const std::string& name, const ImportLimits& limits, const std::function<Scene()>& read) {
    int pipes[2];
    if (::pipe(pipes) != 0) {
        throw SceneError(name + ": cannot be read: " + std::strerror(errno));
    }
    const pid_t parent = ::getpid();
    const pid_t child = ::fork();
    if (child < 0) {
        const int error = errno;
        ::close(pipes[0]);
        ::close(pipes[1]);
        throw SceneError(name + ": cannot be read: " + std::strerror(error));
    }
    if (child == 0) {
        ::close(pipes[0]);
        runChild(parent, pipes[1], limits, read);
    }
    ::close(pipes[1]);
    Bytes bytes;
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(limits.seconds) * 3;
    const bool inTime = readUntil(pipes[0], deadline, bytes);
    ::close(pipes[0]);
    if (!inTime) {
        ::kill(child, SIGKILL);
    }
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    if (const std::string failure = failureOf(status, inTime); !failure.empty()) {
        throw SceneError(name + ": " + failure);
    }
    Scene scene;
    std::string message;
    try {
        Reader reader(bytes);
        Outcome outcome{};
        reader(outcome);
        if (outcome == Outcome::Scene) {
            exchange(reader, scene);
        } else {
            reader(message);
        }
    } catch (const std::length_error&) {
        throw SceneError(name + ": is damaged: reading it fails");
    }
    if (!message.empty()) {
        throw SceneError(message);
    }
    return scene;
}

} // namespace nacre::scene
