#include "app/scene_report.hpp"

#include <nlohmann/json.hpp>

namespace nacre::app {

nlohmann::ordered_json describeScene(const std::string& name, const std::vector<std::string>& notes) {
    return {{"name", name}, {"notes", notes}};
}

} // namespace nacre::app
