// Keeps what was edited where a crash leaves it.
#pragma once

#include "view/model/edited_scene.hpp"

#include <QString>

#include <filesystem>
#include <optional>

namespace nacre::view {

/// What was being edited when the program ended without closing.
struct Recovered {
    QString file;                ///< where it was kept
    std::filesystem::path scene; ///< the scene's file; empty: the gallery
    QString edits;               ///< formatEdited
};

/// A file in the user's data folder, one a running program.
class Recovery {
public:
    Recovery();

    /// Throws FileError where it cannot be written.
    void save(const std::filesystem::path& scene, const EditedScene& edited);
    /// Nothing would be lost any more.
    void remove();

    /// What programs that no longer run have left, the last one.
    static std::optional<Recovered> find();
    /// Removes all that they have left.
    static void forget();

private:
    QString file_;
};

} // namespace nacre::view
