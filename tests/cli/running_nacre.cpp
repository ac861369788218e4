#include "running_nacre.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>

namespace nacre::test {

namespace {

namespace fs = std::filesystem;

void redirect(const fs::path& file, int descriptor) {
    const int opened = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    dup2(opened, descriptor);
}

[[noreturn]] void becomeNacre(const std::vector<std::string>& arguments, const fs::path& folder, const fs::path& logs,
                              const Environment& environment) {
    redirect(logs / "output", STDOUT_FILENO);
    redirect(logs / "error", STDERR_FILENO);
    std::error_code error;
    fs::current_path(folder, error);
    for (const auto& [name, value] : environment) {
        setenv(name.c_str(), value.c_str(), 1);
    }
    std::vector<char*> argv{const_cast<char*>(NACRE_COMMAND)};
    for (const std::string& argument : arguments) {
        argv.push_back(const_cast<char*>(argument.c_str()));
    }
    argv.push_back(nullptr);
    execv(argv.front(), argv.data());
    _exit(127);
}

} // namespace

const char* const largeObj = "v 0 0 0\nv 100 0 0\nv 0 100 0\nv 0 0 100\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

const char* const cubeObj = R"(v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v 0 0 1
v 1 0 1
v 1 1 1
v 0 1 1
f 1 4 3 2
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
)";

RunningNacre::RunningNacre(const std::vector<std::string>& arguments, const fs::path& folder,
                           const Environment& environment)
    : process_(fork()) {
    if (process_ == 0) {
        becomeNacre(arguments, folder, logs_.path, environment);
    }
}

void RunningNacre::send(int signal) const {
    kill(process_, signal);
}

Outcome RunningNacre::wait() const {
    int status = 0;
    waitpid(process_, &status, 0);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), readText(logs_.path / "output"), error()};
}

std::string RunningNacre::error() const {
    return readText(logs_.path / "error");
}

Outcome runNacre(const std::vector<std::string>& arguments, const fs::path& folder, const Environment& environment) {
    return RunningNacre(arguments, folder, environment).wait();
}

std::vector<std::string> complaints(const Outcome& outcome) {
    std::vector<std::string> lines;
    std::istringstream text(outcome.error);
    for (std::string line; std::getline(text, line);) {
        if (!line.ends_with(" …") && !line.starts_with("nacre: note: ")) {
            lines.push_back(line);
        }
    }
    return lines;
}

void expectComplaint(const Outcome& outcome, int exitCode, const std::vector<std::string>& parts) {
    EXPECT_EQ(outcome.exitCode, exitCode) << outcome.error;
    const std::vector<std::string> lines = complaints(outcome);
    ASSERT_EQ(lines.size(), 1U) << outcome.error;
    EXPECT_TRUE(lines[0].starts_with("nacre: ")) << lines[0];
    for (const std::string& part : parts) {
        EXPECT_NE(lines[0].find(part), std::string::npos) << "'" << part << "' is not in: " << lines[0];
    }
}

std::string readText(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

void writeText(const fs::path& file, const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
}

std::vector<std::string> CommandTest::files() const {
    std::vector<std::string> names;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder())) {
        names.push_back(fs::relative(entry.path(), folder()).string());
    }
    std::ranges::sort(names);
    return names;
}

} // namespace nacre::test
