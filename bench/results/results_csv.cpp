#include "bench/results/results.hpp"

#include <charconv>

namespace nacre::bench {
namespace {

// Text with commas, quotes or line ends is quoted (RFC 4180).
std::string quoted(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) {
        return text;
    }
    std::string result = "\"";
    for (const char character : text) {
        result += character;
        if (character == '"') {
            result += '"';
        }
    }
    return result + '"';
}

// The shortest text that reads as the same number, whatever the locale.
template <typename Number> std::string text(Number value) {
    char buffer[32];
    const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, value);
    return {buffer, end};
}

void addLine(std::string& csv, const Measurement& measurement, const std::string& quantity, const Summary& time) {
    const auto& error = measurement.error;
    const std::string fields[] = {quoted(measurement.id),
                                  quoted(measurement.series),
                                  quoted(measurement.view),
                                  quoted(measurement.technique),
                                  text(measurement.width),
                                  text(measurement.height),
                                  quoted(measurement.variable),
                                  text(measurement.value),
                                  quoted(quantity),
                                  text(time.count),
                                  text(time.median),
                                  text(time.p5),
                                  text(time.p95),
                                  text(time.low),
                                  text(time.high),
                                  text(measurement.noise),
                                  text(measurement.coverage),
                                  text(measurement.footprint),
                                  text(measurement.triangles),
                                  text(measurement.lights),
                                  text(measurement.materials),
                                  text(measurement.layers),
                                  error ? text(error->psnr) : "",
                                  error ? text(error->relMse) : "",
                                  error ? text(error->energyRatio) : ""};
    const char* separator = "";
    for (const std::string& field : fields) {
        csv += separator + field;
        separator = ",";
    }
    csv += "\r\n";
}

} // namespace

std::string formatCsv(const Results& results) {
    std::string csv =
        "id,series,view,technique,width,height,variable,value,quantity,count,median,p5,p95,low,high,noise,"
        "coverage,footprint,triangles,lights,materials,layers,psnr,relMse,energyRatio\r\n";
    for (const Measurement& measurement : results.measurements) {
        addLine(csv, measurement, "frame", measurement.frame);
        addLine(csv, measurement, "effect", measurement.effect);
        addLine(csv, measurement, "copy", measurement.copy);
        addLine(csv, measurement, "recording", measurement.recording);
        for (const PassResult& pass : measurement.passes) {
            addLine(csv, measurement, "pass: " + pass.name, pass.value);
        }
    }
    return csv;
}

} // namespace nacre::bench
