#include "app/json_report.hpp"

#include <nlohmann/json.hpp>

namespace nacre::app {

nlohmann::ordered_json describeScene(const std::string& name, const std::vector<std::string>& notes) {
    return {{"name", name}, {"notes", notes}};
}

std::string formatReport(const nlohmann::ordered_json& report) {
    return report.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + '\n';
}

} // namespace nacre::app
