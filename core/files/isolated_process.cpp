#include "core/files/isolated_process.hpp"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fstream>
#include <poll.h>
#include <span>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace nacre {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// What the first byte that a child writes says about the others.
enum class Outcome : std::uint8_t { Result, Error };

void limitResources(const ProcessLimits& limits) {
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

bool sendAll(int pipe, std::span<const std::uint8_t> rest) {
    while (!rest.empty()) {
        const ssize_t written = ::write(pipe, rest.data(), rest.size());
        if (written < 0 && errno != EINTR) {
            return false;
        }
        rest = rest.subspan(static_cast<std::size_t>(std::max<ssize_t>(written, 0)));
    }
    return true;
}

bool sendOutcome(int pipe, Outcome outcome, std::span<const std::uint8_t> bytes) {
    const auto first = static_cast<std::uint8_t>(outcome);
    return sendAll(pipe, {&first, 1}) && sendAll(pipe, bytes);
}

[[noreturn]] void runChild(pid_t parent, int pipe, const ProcessLimits& limits, const std::function<Bytes()>& read) {
    followParent(parent);
    silence();
    limitResources(limits);
    bool isSent = false;
    try {
        isSent = sendOutcome(pipe, Outcome::Result, read());
    } catch (const std::bad_alloc&) {
        ::_exit(ENOMEM);
    } catch (const std::exception& error) {
        const std::string_view sentence = error.what();
        isSent = sendOutcome(pipe, Outcome::Error,
                             {reinterpret_cast<const std::uint8_t*>(sentence.data()), sentence.size()});
    }
    ::_exit(isSent ? 0 : EIO);
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

ProcessLimits limitsFor(std::uint64_t fileBytes) {
    ProcessLimits limits;
    limits.seconds += static_cast<unsigned>(fileBytes >> 19);
    limits.bytes += fileBytes * 64;
    return limits;
}

std::vector<std::uint8_t> runIsolated(const std::string& name, const ProcessLimits& limits,
                                      const std::function<std::vector<std::uint8_t>()>& read) {
    int pipes[2];
    if (::pipe(pipes) != 0) {
        throw FileError(name + ": cannot be read: " + std::strerror(errno));
    }
    const pid_t parent = ::getpid();
    const pid_t child = ::fork();
    if (child < 0) {
        const int error = errno;
        ::close(pipes[0]);
        ::close(pipes[1]);
        throw FileError(name + ": cannot be read: " + std::strerror(error));
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
        throw FileError(name + ": " + failure);
    }
    if (bytes.empty()) {
        throw FileError(name + ": is damaged: reading it fails");
    }
    const auto outcome = static_cast<Outcome>(bytes.front());
    bytes.erase(bytes.begin());
    if (outcome == Outcome::Error) {
        throw FileError(std::string(bytes.begin(), bytes.end()));
    }
    return bytes;
}

} // namespace nacre
