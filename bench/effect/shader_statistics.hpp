// What the driver's compiler says of the effect's passes: registers, instructions, shared memory, whatever it tells
// through VK_KHR_pipeline_executable_properties, and how long it takes. Nothing is dispatched.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

namespace nacre::bench {

struct ShaderStatistic {
    std::string name;
    std::string value;
};

/// A pass in one of its forms, compiled.
struct CompiledPass {
    std::string technique;
    std::string pass;
    std::string form; ///< precision and specialisation; empty = neither
    std::vector<ShaderStatistic> statistics;
};

/// Compiles the passes of a technique, of "transmit" or of "all", on the first device that offers the extension and
/// whose name has `device` in it, and prints each to `out` as it goes. Throws std::invalid_argument for an unknown
/// technique and std::runtime_error where there is no such device.
std::vector<CompiledPass> compilePasses(const std::string& technique, const std::string& device, std::ostream& out);

/// All figures as a table, one line each, header first.
std::string formatShaderCsv(const std::vector<CompiledPass>& passes);

} // namespace nacre::bench
