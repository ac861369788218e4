// References of views, kept in a folder: a picture is computed once, and again only where what it depends on has
// changed.
#pragma once

#include "bench/accuracy/accuracy_view.hpp"
#include "reference/reference.hpp"

#include <filesystem>
#include <functional>

namespace nacre::bench {

/// A reference and whether it had to be computed.
struct StoredReference {
    reference::Film film;
    bool wasThere = false;             ///< the folder had enough samples of it
    std::vector<std::string> warnings; ///< reference::Reference::warnings
};

/// A folder with a checkpoint for each reference, its name with a print of scene, camera, size and method, and the
/// picture as OpenEXR beside it. What is asked for with more samples than are there goes on from them.
class ReferenceStore {
public:
    /// Makes the folder where there is none. Throws std::runtime_error naming it where it cannot be made.
    explicit ReferenceStore(std::filesystem::path folder);

    /// The reference of a view; `proceed` is called between slices of work, and where it says false what was computed
    /// until then is kept and returned. `Stop::seconds` counts what earlier runs spent on it. Throws FileError for a
    /// checkpoint that cannot be read or written.
    StoredReference get(const AccuracyView& view, reference::Method method, const Size& size, reference::Stop stop,
                        const std::function<bool(const reference::Progress&)>& proceed) const;

private:
    std::filesystem::path folder_;
};

} // namespace nacre::bench
