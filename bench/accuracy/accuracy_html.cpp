#include "bench/accuracy/accuracy_html.hpp"

#include "accuracy_css.h"
#include "bench/accuracy/accuracy_text.hpp"
#include "bench/report/report_text.hpp"

namespace nacre::bench {
namespace {

const char* titleOf(const std::string& method) {
    return method == "walk" ? "random walk" : "surface integral";
}

std::string cell(const std::string& text) {
    return "<td>" + escapeHtml(text) + "</td>";
}

std::string heading(const std::string& text) {
    return "<th>" + escapeHtml(text) + "</th>";
}

std::string figures(const AccuracyFigures& figures) {
    std::string text = cell(formatPsnr(figures));
    for (const double ratio : figures.energy) {
        text += cell(formatEnergy(ratio));
    }
    return text;
}

std::string overview(const AccuracyResults& results) {
    const AccuracyViewResult& first = results.views.front();
    std::string html =
        "<h2>PSNR of every technique, dB</h2>\n<table>\n<tr><th class=\"text\">view</th>" + heading("against");
    for (const AccuracyCell& column : first.cells) {
        html += column.reference == first.references.front().method ? heading(column.technique) : "";
    }
    html += heading("noise") + "</tr>\n";
    for (const AccuracyViewResult& view : results.views) {
        for (const AccuracyReference& reference : view.references) {
            html += "<tr><td class=\"text\"><a href=\"#" + escapeHtml(view.name) + "\">" + escapeHtml(view.name) +
                    "</a></td>" + cell(reference.method);
            for (const AccuracyCell& entry : view.cells) {
                html += entry.reference == reference.method ? cell(formatPsnr(entry.whole)) : "";
            }
            html += cell(formatDecibels(reference.noisePsnr)) + "</tr>\n";
        }
    }
    return html + "</table>\n";
}

class Page {
public:
    Page(const AccuracyResults& results, const std::string& pictures) : results_(results), pictures_(pictures) {}

    std::string html() const {
        std::string body =
            "<h1>Accuracy</h1>\n<p>Pictures of " + escapeHtml(results_.device) + ", Nacre " + results_.nacreVersion +
            ", " + std::to_string(results_.width) + " x " + std::to_string(results_.height) +
            " pixels. Energy is how much light there is too much or too little, in % of the "
            "reference's. The reference's noise is taken out of PSNR; > is a bound where the noise hides the rest. "
            "Noise is the PSNR that a picture without error would have against the reference as it is. Differences are "
            "grey where there is none, brighter where the technique has more light.</p>\n" +
            overview(results_);
        for (const AccuracyViewResult& view : results_.views) {
            body += section(view);
        }
        return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
               "content=\"width=device-width\">\n<link rel=\"icon\" href=\"data:,\">\n<title>Nacre: accuracy</title>\n"
               "<style>\n" +
               std::string(accuracy_css) + "</style>\n</head>\n<body>\n" + body + "</body>\n</html>\n";
    }

private:
    std::string picture(const std::string& file, const std::string& caption) const {
        return "<figure><img loading=\"lazy\" width=\"" + std::to_string(results_.width) + "\" height=\"" +
               std::to_string(results_.height) + "\" src=\"" + escapeHtml(pictures_ + '/' + file) + "\" alt=\"" +
               escapeHtml(caption) + "\"><figcaption>" + escapeHtml(caption) + "</figcaption></figure>\n";
    }

    std::string section(const AccuracyViewResult& view) const {
        std::string html = "<h2 id=\"" + escapeHtml(view.name) + "\">" + escapeHtml(view.name) + "</h2>\n<p>" +
                           escapeHtml(view.what) + "</p>\n";
        for (const AccuracyReference& reference : view.references) {
            html += table(view, reference);
        }
        return html + pictures(view);
    }

    static std::string table(const AccuracyViewResult& view, const AccuracyReference& reference) {
        std::string html = "<table>\n<tr><th class=\"text\">against the " + std::string(titleOf(reference.method)) +
                           "</th>" + heading("PSNR, dB") + heading("energy R, %") + heading("G") + heading("B") +
                           heading("FLIP") + heading("thin parts: PSNR") + heading("energy R") + heading("G") +
                           heading("B") + "</tr>\n";
        for (const AccuracyCell& entry : view.cells) {
            if (entry.reference == reference.method) {
                html += "<tr><td class=\"text\">" + escapeHtml(entry.technique) + "</td>" + figures(entry.whole) +
                        cell(formatShort(entry.flip)) +
                        (entry.thin ? figures(*entry.thin) : "<td colspan=\"4\"></td>") + "</tr>\n";
            }
        }
        html += "</table>\n<p class=\"note\">Reference: " + formatWhole(reference.samples) +
                " samples a pixel, noise " + formatShare(reference.noise) + " of the mean or " +
                formatDecibels(reference.noisePsnr) + " dB, " + formatWhole(reference.seconds) + " s.";
        for (const std::string& warning : reference.warnings) {
            html += ' ' + escapeHtml(warning) + '.';
        }
        return html + "</p>\n";
    }

    std::string pictures(const AccuracyViewResult& view) const {
        std::string html = "<div class=\"pictures\">\n";
        for (const AccuracyReference& reference : view.references) {
            html += picture(accuracyPicture(view.name, reference.method), titleOf(reference.method));
        }
        html += "</div>\n<div class=\"pictures\">\n";
        for (const AccuracyCell& entry : view.cells) {
            if (entry.reference == view.references.front().method) {
                html += picture(accuracyPicture(view.name, entry.technique), entry.technique);
            }
        }
        html += "</div>\n";
        for (const AccuracyReference& reference : view.references) {
            html += "<div class=\"pictures\">\n";
            for (const AccuracyCell& entry : view.cells) {
                if (entry.reference == reference.method) {
                    html += picture(accuracyDifference(view.name, entry.technique, reference.method),
                                    entry.technique + " minus " + titleOf(reference.method));
                }
            }
            html += "</div>\n";
        }
        return html;
    }

    const AccuracyResults& results_;
    const std::string& pictures_;
};

} // namespace

std::string accuracyPicture(const std::string& view, const std::string& shown) {
    return view + '-' + shown + ".png";
}

std::string accuracyDifference(const std::string& view, const std::string& technique, const std::string& method) {
    return accuracyPicture(view, technique + '-' + method);
}

std::string formatAccuracyHtml(const AccuracyResults& results, const std::string& pictureFolder) {
    return Page(results, pictureFolder).html();
}

} // namespace nacre::bench
