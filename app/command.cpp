#include "app/command.hpp"

#include "nacre/files.hpp"

#include <CLI/CLI.hpp>

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <iostream>
#include <system_error>

namespace nacre::app {

namespace {

const std::filesystem::path standardOutput = "-";

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& reason) {
    throw std::runtime_error(file.string() + ": cannot be written: " + reason);
}

} // namespace

void checkWritable(const std::filesystem::path& file) {
    if (file == standardOutput) {
        return;
    }
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(file, error);
    if (std::filesystem::is_directory(status)) {
        refuse(file, "it is a folder");
    }
    if (std::filesystem::exists(status) && access(file.c_str(), W_OK) != 0) {
        refuse(file, std::generic_category().message(errno));
    }
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
        return;
    }
    const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
    if (!std::filesystem::is_directory(folder, error)) {
        refuse(file, "there is no folder '" + folder.string() + "'");
    }
    std::string probe = (folder / ".nacre-XXXXXX").string();
    const int descriptor = mkstemp(probe.data());
    if (descriptor < 0) {
        refuse(file, std::generic_category().message(errno));
    }
    close(descriptor);
    unlink(probe.c_str());
}

bool isSameFile(const std::filesystem::path& one, const std::filesystem::path& other) {
    std::error_code error;
    if (std::filesystem::equivalent(one, other, error)) {
        return true;
    }
    const auto place = [](const std::filesystem::path& file, std::error_code& fault) {
        const std::filesystem::path whole = std::filesystem::absolute(file, fault);
        return fault ? whole : std::filesystem::weakly_canonical(whole, fault);
    };
    std::error_code oneFault;
    std::error_code otherFault;
    return place(one, oneFault) == place(other, otherFault) && !oneFault && !otherFault;
}

void requireDistinctFiles(std::vector<std::filesystem::path> files) {
    std::erase_if(files, [](const auto& file) { return file.empty() || file == standardOutput; });
    for (auto file = files.begin(); file != files.end(); ++file) {
        const auto twin =
            std::find_if(files.begin(), file, [&](const auto& other) { return isSameFile(*file, other); });
        if (twin != file) {
            throw UsageError("the same file is given twice: '" + twin->string() + "' and '" + file->string() + "'");
        }
    }
}

void writeText(const std::filesystem::path& file, std::string_view text) {
    if (file == standardOutput) {
        std::cout << text;
        return;
    }
    writeFileAtomically(file, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

void requireRange(double value, double low, double high, const std::string& option) {
    if (!(value >= low && value <= high)) {
        std::array<char, 128> text{};
        std::snprintf(text.data(), text.size(), " %g is outside %g to %g", value, low, high);
        throw UsageError(option + text.data());
    }
}

void requireWith(const CLI::App& command, std::initializer_list<const char*> options, const std::string& other) {
    const auto* const given = std::ranges::find_if(options, [&](const char* name) { return command.count(name) > 0; });
    if (given != options.end()) {
        throw UsageError(std::string(*given) + " requires " + other);
    }
}

PictureSize parseSize(const std::string& text) {
    const char* const end = text.data() + text.size();
    std::uint64_t width = 0;
    std::uint64_t height = 0;
    const auto first = std::from_chars(text.data(), end, width);
    const bool separated = first.ec == std::errc() && first.ptr != end && *first.ptr == 'x';
    const auto second = separated ? std::from_chars(first.ptr + 1, end, height) : first;
    if (!separated || second.ec != std::errc() || second.ptr != end) {
        throw UsageError("--size '" + text + "' is not WIDTHxHEIGHT in pixels, for example 1280x720");
    }
    if (width < 1 || height < 1 || width > maxPictureSide || height > maxPictureSide) {
        const std::string limit = std::to_string(maxPictureSide);
        throw UsageError("--size " + text + " is outside 1x1 to " + limit + 'x' + limit);
    }
    return {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
}

CLI::Option* addJsonOption(CLI::App& command, std::filesystem::path& file) {
    return command.add_option("--json", file, "Write the results as JSON; - is standard output")->type_name("FILE");
}

} // namespace nacre::app
