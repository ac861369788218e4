// Local thickness at many places of a scene's surfaces, place by place. The result depends on scene, places and
// settings alone, not on threads, interruptions or how often it was resumed.
#pragma once

#include "bake/chords.hpp"
#include "trace/work_file.hpp"

#include <functional>
#include <memory>

namespace nacre::bake {

struct ThicknessSettings {
    std::uint32_t samples = 256; ///< [≥ 1] chords a place
    std::uint64_t seed = 1;
    unsigned threads = 0; ///< 0 = all cores
};

/// What is known so far.
struct ThicknessState {
    std::vector<float> millimetres; ///< of the first places
    std::uint64_t escaped = 0;      ///< rays that flew away through gaps
    double seconds = 0;             ///< spent until now
};

class ThicknessBake {
public:
    /// `scene` must outlive it. Throws SceneError for a scene that does not fit together.
    ThicknessBake(const scene::Scene& scene, std::vector<trace::Hit> places, ThicknessLaw law,
                  const ThicknessSettings& settings);
    ~ThicknessBake();

    const ThicknessState& state() const;
    std::size_t placeCount() const;
    bool isComplete() const { return state().millimetres.size() == placeCount(); }
    /// Goes on from an earlier run with the same scene, places and settings.
    void resume(ThicknessState state);

    /// Adds places until all are done or `proceed`, which is asked about every third of a second, says false.
    void run(const std::function<bool()>& proceed);

    /// What the user should know about the scene; a sentence each.
    std::vector<std::string> warnings() const;

private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

/// Writes the state whole or not at all. Throws FileError.
void saveThickness(const std::filesystem::path& file, const trace::Identity& identity, const ThicknessState& state);

/// Throws FileError, naming the file, when it is damaged, of another identity, or has more than `places` values.
ThicknessState loadThickness(const std::filesystem::path& file, const trace::Identity& identity, std::size_t places);

} // namespace nacre::bake
