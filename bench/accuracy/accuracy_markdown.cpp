#include "bench/accuracy/accuracy_markdown.hpp"

#include "bench/accuracy/accuracy_text.hpp"

#include <algorithm>
#include <functional>

namespace nacre::bench {
namespace {

/// Whose figures are given in full: the effect's default.
constexpr const char* detailedTechnique = "bank";

std::string row(const std::vector<std::string>& cells) {
    std::string text = "|";
    for (const std::string& cell : cells) {
        text += ' ' + cell + " |";
    }
    return text + '\n';
}

std::string heading(const std::vector<std::string>& cells) {
    std::vector<std::string> rule(cells.size(), "--:");
    rule.front() = "---";
    return row(cells) + row(rule);
}

const AccuracyCell* find(const AccuracyViewResult& view, const std::string& method, const std::string& technique) {
    const auto cell = std::ranges::find_if(view.cells, [&](const AccuracyCell& candidate) {
        return candidate.reference == method && candidate.technique == technique;
    });
    return cell == view.cells.end() ? nullptr : &*cell;
}

const AccuracyReference& referenceOf(const AccuracyViewResult& view, const std::string& method) {
    return *std::ranges::find(view.references, method, &AccuracyReference::method);
}

std::vector<std::string> techniquesOf(const AccuracyResults& results) {
    std::vector<std::string> names;
    for (const AccuracyCell& cell : results.views.front().cells) {
        if (std::ranges::find(names, cell.technique) == names.end()) {
            names.push_back(cell.technique);
        }
    }
    return names;
}

std::string energies(const AccuracyFigures& figures) {
    return formatEnergy(figures.energy[0]) + ' ' + formatEnergy(figures.energy[1]) + ' ' +
           formatEnergy(figures.energy[2]);
}

/// One column for each technique, and `last` with its title.
std::string byTechnique(const AccuracyResults& results, const std::string& method,
                        const std::function<std::string(const AccuracyCell&)>& figure, const std::string& lastTitle,
                        const std::function<std::string(const AccuracyReference&)>& last) {
    const std::vector<std::string> techniques = techniquesOf(results);
    std::vector<std::string> cells{"view"};
    cells.insert(cells.end(), techniques.begin(), techniques.end());
    cells.push_back(lastTitle);
    std::string text = heading(cells);
    for (const AccuracyViewResult& view : results.views) {
        cells = {view.name};
        for (const std::string& technique : techniques) {
            const AccuracyCell* cell = find(view, method, technique);
            cells.push_back(cell != nullptr ? figure(*cell) : "");
        }
        cells.push_back(last(referenceOf(view, method)));
        text += row(cells);
    }
    return text + '\n';
}

std::string inFull(const AccuracyResults& results, const std::string& method, const std::string& technique) {
    std::string text = heading({"view", "PSNR, dB", "energy R G B, %", "FLIP", "thin pixels, %",
                                "PSNR of thin parts, dB", "energy of thin parts, %"});
    for (const AccuracyViewResult& view : results.views) {
        const AccuracyCell* cell = find(view, method, technique);
        if (cell == nullptr) {
            continue;
        }
        std::vector<std::string> cells{view.name, formatPsnr(cell->whole), energies(cell->whole),
                                       formatShort(cell->flip)};
        if (cell->thin) {
            const double share =
                100 * static_cast<double>(cell->thin->pixels) / static_cast<double>(cell->whole.pixels);
            cells.insert(cells.end(), {formatWhole(share), formatPsnr(*cell->thin), energies(*cell->thin)});
        } else {
            cells.insert(cells.end(), {"0", "", ""});
        }
        text += row(cells);
    }
    return text + '\n';
}

std::string viewList(const AccuracyResults& results) {
    std::string text = row({"view", "what it shows"}) + row({"---", "---"});
    for (const AccuracyViewResult& view : results.views) {
        text += row({view.name, view.what});
    }
    return text + '\n';
}

/// What the figures hold for.
std::string conditions(const AccuracyResults& results) {
    double seconds = 0;
    std::size_t references = 0;
    for (const AccuracyViewResult& view : results.views) {
        for (const AccuracyReference& reference : view.references) {
            seconds += reference.seconds;
            ++references;
        }
    }
    return "**This edition** is of " + std::to_string(results.width) + 'x' + std::to_string(results.height) +
           " pixels, rendered on " + results.device + " by Nacre " + results.nacreVersion + ".\nA reference took " +
           formatWhole(seconds / static_cast<double>(references)) +
           " s in the mean. The columns \"noise\" and \"samples a pixel\" say how far that carries.\n\n";
}

} // namespace

std::string formatAccuracyMarkdown(const AccuracyResults& results) {
    std::string text = conditions(results) + "## The views\n\n" + viewList(results);
    for (const AccuracyReference& reference : results.views.front().references) {
        const std::string& method = reference.method;
        const bool isWalk = method == "walk";
        text += std::string("## Against the ") + (isWalk ? "random walk" : "surface integral") + "\n\nPSNR, dB:\n\n";
        text += byTechnique(
            results, method, [](const AccuracyCell& cell) { return formatPsnr(cell.whole); }, "noise",
            [](const AccuracyReference& r) { return formatDecibels(r.noisePsnr); });
        text += "Energy, mean of the three channels, % too much or too little:\n\n";
        text += byTechnique(
            results, method,
            [](const AccuracyCell& cell) {
                return formatEnergy((cell.whole.energy[0] + cell.whole.energy[1] + cell.whole.energy[2]) / 3);
            },
            "samples a pixel", [](const AccuracyReference& r) { return formatWhole(r.samples); });
        text +=
            std::string("The figures of `") + detailedTechnique + "`:\n\n" + inFull(results, method, detailedTechnique);
    }
    return text;
}

} // namespace nacre::bench
