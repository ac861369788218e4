// Keeps what was edited where a crash leaves it.
#pragma once

#include "view/model/edited_scene.hpp"

#include <QString>

#include <optional>
#include <vector>

namespace nacre::view {

/// What was being edited when the program ended without closing.
struct Recovered {
    QString scene; ///< the scene's file; empty: the gallery
    std::vector<Material> materials;
};

/// A file in the user's data folder, one a running program.
class Recovery {
public:
    Recovery();

    /// Throws FileError where it cannot be written.
    void save(const QString& scene, const EditedScene& edited);
    /// Nothing would be lost any more.
    void remove();

    /// What programs that no longer run have left, the last one; forgets it and the others.
    static std::optional<Recovered> take();

private:
    QString file_;
};

} // namespace nacre::view
