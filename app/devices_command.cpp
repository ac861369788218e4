// `nacre devices`: the Vulkan devices of this machine.
#include "app/command.hpp"
#include "app/json_report.hpp"
#include "renderer/graphics_device.hpp"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <iostream>

namespace nacre::app {

namespace {

std::string toJson(const std::vector<renderer::DeviceDescription>& devices) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const renderer::DeviceDescription& device : devices) {
        list.push_back({{"name", device.name},
                        {"kind", device.kind},
                        {"driver", device.driver},
                        {"apiVersion", device.apiVersion},
                        {"usable", device.usable},
                        {"reason", device.reason}});
    }
    return formatReport({{"schemaVersion", 1}, {"devices", list}});
}

std::string toText(const std::vector<renderer::DeviceDescription>& devices) {
    std::string text;
    for (std::size_t index = 0; index < devices.size(); ++index) {
        const renderer::DeviceDescription& device = devices[index];
        text += std::to_string(index) + "  " + device.name + ", " + device.kind + ", Vulkan " + device.apiVersion +
                ", " + device.driver + (device.usable ? "" : "; not usable: " + device.reason) + '\n';
    }
    return text;
}

void listDevices(const std::filesystem::path& json) {
    if (!json.empty()) {
        checkWritable(json);
    }
    const std::vector<renderer::DeviceDescription> devices = renderer::listDevices();
    if (json.empty()) {
        std::cout << toText(devices);
    } else {
        writeText(json, toJson(devices));
    }
}

} // namespace

void addDevices(CLI::App& app) {
    CLI::App* command = app.add_subcommand("devices", "List the Vulkan devices of this machine");
    command->footer(R"(The number or a part of the name is what `nacre render --device` takes.

Examples:
  nacre devices
  nacre devices --json devices.json
  nacre render --device 0)");
    const auto json = std::make_shared<std::filesystem::path>();
    addJsonOption(*command, *json);
    command->callback([json] { listDevices(*json); });
}

} // namespace nacre::app
