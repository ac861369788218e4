// Steps of a file that drive the window as a user would, and take pictures of it.
#pragma once

#include <QJsonObject>
#include <QSize>

#include <cstdint>
#include <filesystem>
#include <optional>

namespace nacre::view {

class MainWindow;

/// {"size": [WIDTH, HEIGHT], "samples": N, "steps": [STEP, ...]}: the window's size, px, and the samples of a picture
/// at rest, which may be left out, and steps, each an object with one of the keys of docs/viewer.md.
class Script {
public:
    /// Throws FileError naming what the file lacks.
    explicit Script(const std::filesystem::path& file);

    std::optional<QSize> windowSize() const;
    std::optional<std::uint32_t> samples() const;
    /// Throws std::runtime_error with a sentence that names the file, the step and what is wrong with it.
    void run(MainWindow& window) const;

private:
    std::filesystem::path file_;
    QJsonObject content_;
};

} // namespace nacre::view
