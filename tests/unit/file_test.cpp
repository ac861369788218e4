// Whole files out: a killed process leaves nothing behind, and what is replaced keeps its mode and its links.
#include "nacre/files.hpp"

#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

using namespace nacre;
namespace fs = std::filesystem;

namespace {

using Bytes = std::vector<std::uint8_t>;

class Files : public testing::Test {
protected:
    std::size_t fileCount() const { return temporary.fileCount(); }

    const nacre::tests::TemporaryFolder temporary;
    const fs::path& folder = temporary.path;
};

/// Writes more than the process may, in a child; how that ended.
int writeTooMuch(const fs::path& file, void (*whatHappens)(int)) {
    const pid_t child = ::fork();
    if (child == 0) {
        const rlimit limit{4096, 4096};
        ::setrlimit(RLIMIT_FSIZE, &limit);
        ::signal(SIGXFSZ, whatHappens);
        try {
            writeFileAtomically(file, Bytes(100'000));
        } catch (const FileError&) {
            ::_exit(1);
        }
        ::_exit(0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return status;
}

TEST_F(Files, AreGoneWhenTheProcessIsKilledWhileItWritesThem) {
    int status = writeTooMuch(folder / "a", SIG_DFL);
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGXFSZ) << status;
    EXPECT_EQ(fileCount(), 0u);
    status = writeTooMuch(folder / "a", SIG_IGN);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 1) << status;
    EXPECT_EQ(fileCount(), 0u);
}

TEST_F(Files, KeepTheirModeWhenReplaced) {
    writeFileAtomically(folder / "a", Bytes{1});
    for (const mode_t mode : {0600u, 0755u}) {
        ASSERT_EQ(::chmod((folder / "a").c_str(), mode), 0);
        writeFileAtomically(folder / "a", Bytes{2});
        struct stat status {};
        ASSERT_EQ(::stat((folder / "a").c_str(), &status), 0);
        EXPECT_EQ(status.st_mode & 07777, mode);
    }
    EXPECT_EQ(readFile(folder / "a"), Bytes{2});
    EXPECT_EQ(fileCount(), 1u);
}

TEST_F(Files, AreWrittenThroughLinksEvenToWhatIsNotThereYet) {
    fs::create_directory(folder / "elsewhere");
    fs::create_symlink("elsewhere/a", folder / "link");
    fs::create_symlink("link", folder / "link to it");
    for (const std::uint8_t value : Bytes{1, 2}) {
        writeFileAtomically(folder / "link to it", Bytes{value});
        EXPECT_TRUE(fs::is_symlink(folder / "link to it"));
        EXPECT_TRUE(fs::is_symlink(folder / "link"));
        EXPECT_EQ(readFile(folder / "elsewhere/a"), Bytes{value});
    }
    fs::create_symlink("circle", folder / "circle");
    EXPECT_THROW(writeFileAtomically(folder / "circle", Bytes{1}), FileError);
}

} // namespace
