#include "bench/results/series_fits.hpp"

#include <algorithm>
#include <optional>
#include <set>
#include <tuple>

namespace nacre::bench {
namespace {

// Measurements that lie on one line.
using Group = std::vector<const Measurement*>;

auto groupKey(const Measurement& measurement) {
    const bool overSizes = measurement.variable == resolutionVariable;
    return std::tuple(measurement.series, measurement.view, measurement.technique, overSizes ? 0 : measurement.width,
                      overSizes ? 0 : measurement.height);
}

std::vector<Group> groupsOf(const std::vector<Measurement>& measurements) {
    std::vector<Group> groups;
    for (const Measurement& measurement : measurements) {
        const auto group = std::find_if(groups.begin(), groups.end(), [&](const Group& candidate) {
            return groupKey(*candidate.front()) == groupKey(measurement);
        });
        (group == groups.end() ? groups.emplace_back() : *group).push_back(&measurement);
    }
    return groups;
}

// Median in µs; none where the measurement has no such quantity.
std::optional<double> findMedian(const Measurement& measurement, const std::string& quantity) {
    if (quantity != scatterQuantity) {
        const Summary* time = findTime(measurement, quantity);
        return time ? std::optional(time->median) : std::nullopt;
    }
    std::optional<double> sum;
    for (const PassResult& pass : measurement.passes) {
        if (pass.name.starts_with("scatter: ")) { // FrameReport::passes
            sum = sum.value_or(0) + pass.value.median;
        }
    }
    return sum;
}

// The quantities that every measurement of the group has.
std::vector<std::string> quantitiesOf(const Group& group) {
    std::vector<std::string> quantities{"effect", "frame", scatterQuantity};
    for (const PassResult& pass : group.front()->passes) {
        quantities.push_back(pass.name);
    }
    std::erase_if(quantities, [&](const std::string& quantity) {
        return !std::all_of(group.begin(), group.end(), [&](const Measurement* measurement) {
            return findMedian(*measurement, quantity).has_value();
        });
    });
    return quantities;
}

Fit fit(const Group& group, const std::string& quantity) {
    std::vector<double> x;
    std::vector<double> y;
    double noise = 0;
    for (const Measurement* measurement : group) {
        x.push_back(measurement->value);
        y.push_back(*findMedian(*measurement, quantity));
        noise = std::max(noise, measurement->noise);
    }
    const auto [first, last] = std::minmax_element(x.begin(), x.end());
    const auto [smallest, largest] = std::minmax_element(y.begin(), y.end());
    const Line line = fitLine(x, y);
    const Measurement& any = *group.front();
    const bool overSizes = any.variable == resolutionVariable;
    return {.series = any.series,
            .technique = any.technique,
            .width = overSizes ? 0 : any.width,
            .height = overSizes ? 0 : any.height,
            .variable = any.variable,
            .unit = any.unit,
            .quantity = quantity,
            .line = line,
            .spread = *smallest > 0 ? *largest / *smallest : 1,
            .noise = noise,
            .flat = isFlat(line, *last - *first, *smallest, *largest, noise)};
}

} // namespace

std::vector<Fit> fitSeries(const std::vector<Measurement>& measurements) {
    std::vector<Fit> fits;
    for (const Group& group : groupsOf(measurements)) {
        if (group.front()->error) {
            continue;
        }
        std::set<double> values;
        for (const Measurement* measurement : group) {
            values.insert(measurement->value);
        }
        if (values.size() < 3) {
            continue;
        }
        for (const std::string& quantity : quantitiesOf(group)) {
            fits.push_back(fit(group, quantity));
        }
    }
    return fits;
}

std::string verdictOf(const Fit& fit) {
    const bool mayBeZero = fit.line.slopeLow <= 0 && fit.line.slopeHigh >= 0;
    if (fit.noise >= tooNoisy && (fit.flat || mayBeZero)) {
        return tooNoisyToTell;
    }
    if (fit.flat) {
        return "flat";
    }
    return mayBeZero ? noLine : fit.line.slope > 0 ? "grows" : "falls";
}

std::vector<const Fit*> fitsOf(const Results& results, std::string_view series, std::string_view quantity) {
    std::vector<const Fit*> fits;
    for (const Fit& candidate : results.fits) {
        if (candidate.series == series && candidate.quantity == quantity) {
            fits.push_back(&candidate);
        }
    }
    return fits;
}

} // namespace nacre::bench
