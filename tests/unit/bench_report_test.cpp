// Fits, plots, conclusion and report of synthetic results whose answers are known.
#include "bench/report/charts.hpp"
#include "bench/report/conclusion.hpp"
#include "bench/report/html_report.hpp"
#include "bench/report/report_text.hpp"
#include "bench/results/series_fits.hpp"
#include "nacre/files.hpp"
#include "tests/support/bench_sample.hpp"

#include <gtest/gtest.h>

#include <algorithm>

using namespace nacre::bench;
using namespace nacre::bench::sample;

namespace {

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

std::size_t countOf(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; ++at) {
        ++count;
    }
    return count;
}

} // namespace

TEST(Text, NumbersHaveTheDigitsThatMatter) {
    EXPECT_EQ(formatNumber(0.012345), "0.0123");
    EXPECT_EQ(formatNumber(12.345), "12.3");
    EXPECT_EQ(formatNumber(12345.6), "12346");
    EXPECT_EQ(formatNumber(2.0), "2");
    EXPECT_EQ(formatNumber(0), "0");
    EXPECT_EQ(formatTime(812), "812 µs");
    EXPECT_EQ(formatTime(18'000), "18 ms");
    EXPECT_EQ(formatShare(0.0123), "1.2 %");
    EXPECT_EQ(formatCount(436'508), "436,508");
    EXPECT_EQ(formatCount(999), "999");
    EXPECT_EQ(join({"a", "b", "c"}), "a, b and c");
    EXPECT_EQ(escapeHtml("a<b & \"c\""), "a&lt;b &amp; &quot;c&quot;");
}

TEST(Fits, FindTheSlopesThatWerePutIn) {
    const Results results = thesisResults();
    for (const Fit* fit : fitsOf(results, "experiment 2", "effect")) {
        const double expected =
            fit->technique == "bank" ? 0 : slopeOf(fit->technique) * pixels(fit->width, fit->height);
        EXPECT_NEAR(fit->line.slope, expected, 0.02 * std::max(expected, 5.0)) << fit->technique;
        EXPECT_EQ(fit->flat, fit->technique == "bank") << fit->technique;
    }
    EXPECT_EQ(fitsOf(results, "experiment 2", "effect").size(), 6u);
    EXPECT_EQ(fitsOf(results, "experiment 2", "G-buffer").size(), 6u);
}

// In the sample the effect is scatter alone, in two passes.
TEST(Fits, HaveScatterAsTheSumOfItsPasses) {
    const Results results = thesisResults();
    const std::vector<const Fit*> effect = fitsOf(results, "experiment 2", "effect");
    const std::vector<const Fit*> scatter = fitsOf(results, "experiment 2", scatterQuantity);
    ASSERT_EQ(scatter.size(), effect.size());
    for (std::size_t i = 0; i < scatter.size(); ++i) {
        EXPECT_NEAR(scatter[i]->line.slope, effect[i]->line.slope, 1e-6) << scatter[i]->technique;
    }
    EXPECT_TRUE(fitsOf(results, "experiment 2", "ambient occlusion").empty());
}

TEST(Fits, RunOverAllSizesWhereTheResolutionVaries) {
    std::vector<Measurement> measurements;
    for (const std::uint32_t height : {720u, 1080u, 2160u}) {
        const double area = pixels(height * 16 / 9, height);
        measurements.push_back(
            measure("resolution", "bank", height * 16 / 9, height, resolutionVariable, "Mpx", area, 5 + 30 * area));
    }
    const std::vector<Fit> fits = fitSeries(measurements);
    ASSERT_FALSE(fits.empty());
    EXPECT_EQ(fits[0].width, 0u);
    EXPECT_NEAR(fits[0].line.slope, 30, 1e-6);
}

TEST(Fits, NeedThreeValues) {
    std::vector<Measurement> measurements;
    for (const double value : {1.0, 2.0, 2.0}) {
        measurements.push_back(measure("layers", "bank", 1280, 720, "layers", "", value, 10));
    }
    EXPECT_TRUE(fitSeries(measurements).empty());
}

TEST(Charts, HoldEveryMeasurementAndTheThesisLine) {
    const std::vector<Chart> charts = chartsOfSeries(thesisResults(), "experiment 2");
    ASSERT_EQ(charts.size(), 3u); // two sizes, and the larger again with the thesis's line
    std::size_t points = 0;
    for (const ChartSet& set : charts[0].sets) {
        points += set.kind == ChartSetKind::Measured ? set.points.size() : 0;
    }
    EXPECT_EQ(points, 3u * 11);
    const ChartSet& thesis = charts[2].sets.back();
    ASSERT_EQ(thesis.kind, ChartSetKind::Thesis);
    ASSERT_EQ(thesis.points.size(), 11u);
    EXPECT_EQ(charts[2].yLabel, "time of the effect (ms)");
    EXPECT_NEAR(thesis.points.back().y, 18, 1e-9);
    EXPECT_NEAR(thesis.points.front().y, 8, 1e-9);
}

TEST(Pareto, FrontierIsWhatNothingBeatsInBoth) {
    const Results results = paretoResults();
    const auto groups = paretoGroups(results);
    ASSERT_EQ(groups.size(), 2u);
    std::vector<std::string> ids;
    for (const Measurement* measurement : paretoFrontier(groups[0])) {
        ids.push_back(measurement->technique + " " + formatNumber(measurement->value));
    }
    EXPECT_EQ(ids, (std::vector<std::string>{"separable 11", "bank 1"}));
}

TEST(Pareto, MeansAreOverAllPicturesOfOneSize) {
    Results results = paretoResults();
    results.measurements.front().error->psnr = 34; // the other view's has 30
    const std::vector<ParetoMean> means = paretoMeans(results);
    ASSERT_EQ(means.size(), 1u);
    ASSERT_EQ(means[0].size(), 6u);
    EXPECT_NEAR(means[0][0].effect.median, 60, 1e-9); // geometric mean of 30 and 120
    EXPECT_NEAR(means[0][0].error->psnr, 32, 1e-9);
}

TEST(Conclusion, FollowsTheData) {
    Results results = thesisResults();
    const std::string text = conclude(results);
    EXPECT_TRUE(contains(text, "On A device, with at least 100 measurements of each of 66")) << text;
    EXPECT_TRUE(contains(text, "the thesis's technique grows by 20")) << text;
    EXPECT_TRUE(contains(text, "its straight line; the hardware of 2011 needed 1000 µs")) << text;
    EXPECT_TRUE(contains(text, "bank is flat within its confidence or the noise")) << text;
    EXPECT_TRUE(contains(text, "A kernel baked into the shader takes 0.8 times")) << text;

    for (Measurement& measurement : results.measurements) {
        if (measurement.technique == "thesis") {
            measurement.effect = times(500);
        }
    }
    results.fits = fitSeries(results.measurements);
    EXPECT_TRUE(contains(conclude(results), "the thesis's technique is flat: 0")) << conclude(results);
    EXPECT_EQ(conclude(Results{}), "Nothing was measured.");
}

TEST(Conclusion, NamesTheFrontier) {
    const std::string text = conclude(paretoResults());
    EXPECT_TRUE(contains(text,
                         "Over the mean of 2 pictures, 1920x1080, of 6 settings nothing beats separable at 11 taps "
                         "(60 µs, 30 dB) and bank at 1 taps "))
        << text;
}

TEST(Report, HasEverythingInItAndNothingOutside) {
    const Results results = thesisResults();
    const std::string html = formatReport(results, Pictures().path);
    EXPECT_EQ(countOf(html, "<canvas"), 3u);
    EXPECT_EQ(countOf(html, "<figure class=\"pair\">"), results.images.size());
    EXPECT_EQ(countOf(html, "data:image/png;base64,"), 2 * results.images.size());
    EXPECT_EQ(countOf(html, "src=\"http"), 0u);
    EXPECT_EQ(countOf(html, "href=\"http"), 0u);
    EXPECT_TRUE(contains(html, escapeHtml(conclude(results))));
    EXPECT_TRUE(contains(html, "GeForce GT 555M"));
    EXPECT_TRUE(contains(html, "Chart.js v"));
}

TEST(Report, SaysWhatTheSumOfThePassesIs) {
    Results results = thesisResults();
    results.measurements[0].passShare = 0.971;
    results.measurements[1].passShare = 1.0084;
    EXPECT_EQ(formatPassShares(results), "97.1 to 100.8 % (median 99 %)");
    EXPECT_TRUE(contains(formatReport(results, Pictures().path), formatPassShares(results)));
}

TEST(Report, NamesAreTextNotMarkup) {
    Results results = thesisResults();
    results.machine.device = "<script>alert(1)</script>";
    results.measurements[0].technique = "</script><b>";
    const std::string html = formatReport(results, Pictures().path);
    EXPECT_FALSE(contains(html, "<script>alert"));
    EXPECT_FALSE(contains(html, "</script><b>"));
}

TEST(Report, TakesNoFilesButThoseBesideTheResults) {
    const Pictures pictures;
    const std::filesystem::path& folder = pictures.path;
    const std::filesystem::path link = folder / "link.png";
    std::filesystem::create_symlink("/etc/hostname", link);
    for (const std::string& file :
         {std::string("/etc/hostname"), std::string("../off.png"), link.filename().string()}) {
        Results results = thesisResults();
        results.images[0].afterFile = file;
        try {
            formatReport(results, folder);
            FAIL() << file << " is in the report";
        } catch (const nacre::FileError& error) {
            EXPECT_TRUE(contains(error.what(), "is not beside results.json")) << error.what();
        }
    }
}

TEST(Report, SaysWhichPictureIsMissing) {
    try {
        formatReport(thesisResults(), "/nowhere");
        FAIL() << "a report without its pictures";
    } catch (const nacre::FileError& error) {
        EXPECT_TRUE(contains(error.what(), "/nowhere/")) << error.what();
    }
}
