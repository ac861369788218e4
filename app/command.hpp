// What the subcommands of `nacre` share.
#pragma once

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
class Option;
} // namespace CLI

namespace nacre::app {

/// The command was called wrongly; ends the program with exit code 2. Every other exception ends it with 1.
struct UsageError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Each adds one subcommand, with its options and what it runs.
void addRender(CLI::App& app);
void addReference(CLI::App& app);
void addBake(CLI::App& app);
void addCompare(CLI::App& app);
void addMaterial(CLI::App& app);
void addDevices(CLI::App& app);
void addBench(CLI::App& app);
void addView(CLI::App& app);

/// Throws std::runtime_error, naming the file, where `file` cannot be written: its folder is missing or not writable,
/// or it is a folder itself. "-" is standard output. Leaves nothing behind.
void checkWritable(const std::filesystem::path& file);

/// Whether both names lead to one file, if need be through links.
bool isSameFile(const std::filesystem::path& one, const std::filesystem::path& other);

/// Throws UsageError where two of the files are the same, so that no output replaces an input or another output. Empty
/// names and "-" are not looked at.
void requireDistinctFiles(std::vector<std::filesystem::path> files);

/// Writes `text` to `file`, whole or not at all; "-" is standard output.
void writeText(const std::filesystem::path& file, std::string_view text);

/// Throws UsageError, naming the option and its value, unless that is in [low, high].
void requireRange(double value, double low, double high, const std::string& option);

/// Throws UsageError for the first of these options that was given: they mean nothing without `other`.
void requireWith(const CLI::App& command, std::initializer_list<const char*> options, const std::string& other);

struct PictureSize {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
};

/// Largest width and height of a picture, px.
inline constexpr std::uint32_t maxPictureSide = 16384;

/// "WIDTHxHEIGHT" of --size. Throws UsageError.
PictureSize parseSize(const std::string& text);

/// "--json" of every subcommand that has results.
CLI::Option* addJsonOption(CLI::App& command, std::filesystem::path& file);

} // namespace nacre::app
