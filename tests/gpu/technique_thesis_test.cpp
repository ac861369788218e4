// Technique `thesis` against the thesis's listings (appendix B), run in double precision on the CPU: as they stand
// where they are sound, with their faults mended as effect/baselines/thesis/scatter_thesis.comp mends them elsewhere.
#include "nacre/kernel.hpp"
#include "nacre/nacre_baselines.h"
#include "tests/gpu/support/counted_calls.hpp"
#include "tests/gpu/support/effect.hpp"
#include "tests/support/worst.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace nacre::tests {
namespace {

constexpr int groupSize = 128; // THREAD_COUNT
constexpr VkExtent2D extent{150, 140};

struct Pixel {
    Rgb color{};
    double alpha = 0;
    double depth = 0;
};

/// One direction of the listings over rows of pixels.
class Listing {
public:
    /// `literal`: with the listings' faults. What a read outside the cache or the image finds is taken to be 0.
    Listing(Kernel kernel, double strength, bool literal)
        : kernel_(std::move(kernel)),
          radius_(static_cast<int>(kernel_.size() / 2)),
          strength_(strength),
          literal_(literal) {}

    std::vector<Pixel> blur(const std::vector<Pixel>& row) {
        std::vector<Pixel> result;
        for (int first = 0; first < static_cast<int>(row.size()); first += groupSize) {
            fillCache(row, first);
            for (int thread = 0; thread < groupSize && first + thread < static_cast<int>(row.size()); ++thread) {
                result.push_back(blurThread(thread));
                result.back().depth = row[static_cast<std::size_t>(first + thread)].depth;
            }
        }
        return result;
    }

    int readsOutsideCache = 0;

private:
    void fillCache(const std::vector<Pixel>& row, int first) {
        const int last = static_cast<int>(row.size()) - 1;
        cache_.clear();
        for (int x = first - radius_; x < first + groupSize + radius_; ++x) {
            // x - radius is unsigned in the listing: at the image's left edge it wraps and max(…, 0) does nothing.
            cache_.push_back(literal_ && x < 0 ? Pixel{} : row[static_cast<std::size_t>(std::clamp(x, 0, last))]);
        }
    }

    Pixel blurThread(int thread) {
        const int g = thread + radius_ + 1;
        const Pixel center = cache_[static_cast<std::size_t>(literal_ ? g : g - 1)];
        Pixel result;
        if (center.alpha == 0) {
            return result;
        }
        result.alpha = 1;
        const double distance = 1 / std::tan(55 * std::numbers::pi / 180 * 0.5);
        const double step = strength_ * 2 * (distance / center.depth) * center.alpha / radius_;
        for (int i = -radius_; i <= radius_; ++i) {
            const KernelTap& tap = kernel_[static_cast<std::size_t>(i + radius_)];
            const double shift = i + tap.offset * step;
            const int index = literal_
                                  ? static_cast<int>(g - 1 + shift)
                                  : g - 1 + static_cast<int>(std::clamp<double>(std::floor(shift), -radius_, radius_));
            Pixel source;
            if (index >= 0 && index < static_cast<int>(cache_.size())) {
                source = cache_[static_cast<std::size_t>(index)];
            } else {
                ++readsOutsideCache;
            }
            const double s = std::min(1.0, 300 * distance * strength_ * std::abs(center.depth - source.depth));
            for (int c = 0; c < 3; ++c) {
                result.color[c] += tap.weight[c] * std::lerp(source.color[c], center.color[c], s);
            }
        }
        return result;
    }

    Kernel kernel_;
    int radius_;
    double strength_;
    bool literal_;
    std::vector<Pixel> cache_;
};

Kernel kernelOf(const Material& material, int radius) {
    return sliceKernel(makeLayers(material), radius, 2 * radius + 1 > 20 ? 3 : 2);
}

/// Two materials and none, on a wavy slope with a step in it; noise as light.
ScatterInput makeInput() {
    ScatterInput input =
        ScatterInput::plane(extent.width, extent.height, Projection::perspective(extent.width, extent.height, 150), 2);
    input.view.metersPerUnit = 1;
    std::mt19937 engine(7);
    const auto random = [&engine] { return static_cast<float>(engine()) / 4294967296.0f; };
    for (std::uint32_t y = 0; y < extent.height; ++y) {
        for (std::uint32_t x = 0; x < extent.width; ++x) {
            const std::size_t i = input.index(x, y);
            input.irradiance[i] = {random(), random(), random(), 1};
            input.depth[i] = 2 + 0.0007f * static_cast<float>(x) + (x + y > 150 ? 0.3f : 0.0f) +
                             0.004f * std::sin(0.2f * static_cast<float>(y));
            input.materialId[i] = static_cast<std::uint16_t>(x / 20 + y / 30) % 5 == 0 ? 0 : 1 + (x / 50) % 2;
            input.strength.push_back(static_cast<float>((x / 7) % 4) / 3);
        }
    }
    return input;
}

/// Both passes of every material. `readsOutsideCache`: of both.
std::vector<Float4> model(const ScatterInput& input, std::span<const Material> materials,
                          std::span<const Kernel> kernels, double strength, bool literal = false,
                          int* readsOutsideCache = nullptr) {
    std::vector<Float4> result = input.irradiance;
    const auto width = static_cast<int>(input.extent.width);
    const auto height = static_cast<int>(input.extent.height);
    for (std::size_t material = 0; material < materials.size(); ++material) {
        Listing listing(kernels[material], strength, literal);
        std::vector<std::vector<Pixel>> columns(static_cast<std::size_t>(width));
        for (int y = 0; y < height; ++y) {
            std::vector<Pixel> row;
            for (int x = 0; x < width; ++x) {
                const std::size_t i = input.index(x, y);
                Pixel pixel{.depth = input.depth[i]};
                if (input.materialId[i] == material + 1) {
                    pixel.color = {input.irradiance[i][0], input.irradiance[i][1], input.irradiance[i][2]};
                    pixel.alpha = (input.strength.empty() ? 1.0 : input.strength[i]) * materials[material].strength;
                }
                row.push_back(pixel);
            }
            row = listing.blur(row);
            for (int x = 0; x < width; ++x) {
                // A mask of the target's own: the passes of one material write its pixels alone.
                const bool own = input.materialId[input.index(x, y)] == material + 1;
                columns[x].push_back(own ? row[x] : Pixel{.depth = row[x].depth});
            }
        }
        for (int x = 0; x < width; ++x) {
            const std::vector<Pixel> column = listing.blur(columns[x]);
            for (int y = 0; y < height; ++y) {
                const std::size_t i = input.index(x, y);
                const bool scatters = input.strength.empty() || input.strength[i] > 0;
                if (input.materialId[i] == material + 1 && scatters) {
                    const Rgb& c = column[y].color;
                    result[i] = {static_cast<float>(c[0]), static_cast<float>(c[1]), static_cast<float>(c[2]), 1};
                }
            }
        }
        if (readsOutsideCache) {
            *readsOutsideCache += listing.readsOutsideCache;
        }
    }
    return result;
}

struct Difference {
    double largest = 0;
    int pixels = 0; ///< that differ by more than 1e-2
};

Difference compare(std::span<const Float4> a, std::span<const Float4> b) {
    Difference difference;
    for (std::size_t i = 0; i < a.size(); ++i) {
        double largest = 0;
        for (int c = 0; c < 3; ++c) {
            largest = larger(largest, std::abs(double{a[i][c]} - b[i][c]));
        }
        difference.largest = larger(difference.largest, largest);
        difference.pixels += largest > 1e-2 ? 1 : 0;
    }
    return difference;
}

class ThesisTest : public GpuTest {
protected:
    NacreContextInfo contextInfo() {
        NacreContextInfo info = gpu.contextInfo(extent);
        info.techniques = 1u << NACRE_TECHNIQUE_THESIS;
        return info;
    }
    static std::vector<Float4> scatter(Effect& effect, const ScatterInput& input, std::uint32_t radius, float strength,
                                       bool baked = false) {
        const NacreBaselineSettings settings{
            .thesisRadius = radius, .thesisStrength = strength, .thesisBakedKernel = baked};
        return effect.scatter(input, [&](NacreScatterInfo& info) {
            info.technique = NACRE_TECHNIQUE_THESIS;
            info.baselines = &settings;
        });
    }
    std::vector<Material> materials{skin(), marble()};
};

TEST_F(ThesisTest, EqualsTheListing) {
    const ScatterInput input = makeInput();
    Effect effect(gpu, contextInfo());
    effect.setMaterials(materials);
    for (const int radius : {1, 5, 13, 16}) {
        for (const double strength : {0.1, 1.0, 10.0}) {
            const Kernel kernels[] = {kernelOf(materials[0], radius), kernelOf(materials[1], radius)};
            const std::vector<Float4> image =
                scatter(effect, input, static_cast<std::uint32_t>(radius), static_cast<float>(strength));
            EXPECT_LT(compare(image, model(input, materials, kernels, strength)).largest, 1e-3)
                << "radius " << radius << ", strength " << strength;
        }
    }
}

TEST_F(ThesisTest, BakedKernelServesEveryMaterial) {
    const ScatterInput input = makeInput();
    Effect effect(gpu, contextInfo());
    effect.setMaterials(materials);
    for (const int radius : {5, 13}) {
        ASSERT_EQ(nacreBakeThesisKernel(effect.context, 2, static_cast<std::uint32_t>(radius)), NACRE_SUCCESS);
        const Kernel kernels[] = {kernelOf(materials[1], radius), kernelOf(materials[1], radius)};
        EXPECT_LT(compare(scatter(effect, input, 0, 0.5f, true), model(input, materials, kernels, 0.5)).largest, 1e-3);
    }
    const std::vector<Float4> before = scatter(effect, input, 0, 0.5f, true);
    effect.setMaterials(std::vector<Material>{burley(), burley()});
    EXPECT_EQ(compare(scatter(effect, input, 0, 0.5f, true), before).largest, 0) << "a baked kernel stays";
}

// The thesis, chapter 5: "When the offset and the subsurface strength variable gets too big, the index goes out of
// range." An offset · step of one texel does it.
TEST_F(ThesisTest, TheListingReadsOutsideItsCacheAndTheTechniqueDoesNot) {
    const ScatterInput input = makeInput();
    const Kernel kernels[] = {kernelOf(materials[0], 5), kernelOf(materials[1], 5)};
    int weakReads = 0;
    int strongReads = 0;
    model(input, materials, kernels, 0.1, true, &weakReads);
    const std::vector<Float4> literal = model(input, materials, kernels, 10, true, &strongReads);
    const std::vector<Float4> bounded = model(input, materials, kernels, 10);
    EXPECT_EQ(weakReads, 0);
    EXPECT_GT(strongReads, 1000);
    EXPECT_GT(compare(literal, bounded).pixels, 1000);
    RecordProperty("reads_outside_cache", strongReads);
    Effect effect(gpu, contextInfo());
    effect.setMaterials(materials);
    EXPECT_LT(compare(scatter(effect, input, 5, 10), bounded).largest, 1e-3);
}

// The listing's centre is one texel off: a material's last column and row come out black. And it darkens the image's
// left and upper edge.
TEST_F(ThesisTest, TheListingLosesEdgesAndTheTechniqueDoesNot) {
    ScatterInput input = makeInput();
    input.strength.clear();
    for (std::size_t i = 0; i < input.irradiance.size(); ++i) {
        input.irradiance[i] = {1, 1, 1, 1};
        input.depth[i] = 2;
        input.materialId[i] = 1 + static_cast<std::uint16_t>(i % extent.width >= 100 && i % extent.width < 120);
    }
    for (std::size_t i = 0; i < input.depth.size(); ++i) {
        input.depth[i] = input.materialId[i] == 1 ? 2.0f : 1.0f; // apart in depth, so that neither darkens the other
    }
    const Kernel kernels[] = {kernelOf(materials[0], 5), kernelOf(materials[1], 5)};
    const std::vector<Float4> literal = model(input, materials, kernels, 0.1, true);
    EXPECT_EQ(literal[input.index(119, 70)][0], 0) << "last column of material 2";
    Effect effect(gpu, contextInfo());
    effect.setMaterials(materials);
    for (const Float4& pixel : scatter(effect, input, 5, 0.1f)) {
        for (int c = 0; c < 3; ++c) {
            ASSERT_NEAR(pixel[c], 1, 1e-3);
        }
    }
    for (std::size_t i = 0; i < input.depth.size(); ++i) {
        input.depth[i] = 2 + 1e-4f * static_cast<float>(i % extent.width);
    }
    EXPECT_LT(model(input, materials, kernels, 1e-4, true)[input.index(0, 70)][0], 0.9) << "left edge";
    EXPECT_NEAR(scatter(effect, input, 5, 1e-4f)[input.index(0, 70)][0], 1, 1e-3);
}

TEST_F(ThesisTest, CostCountsAPassPairPerMaterial) {
    NacreContextInfo info = contextInfo();
    info.getInstanceProcAddr = countingGetInstanceProcAddr;
    for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{7}}) {
        Effect effect(gpu, info);
        effect.setMaterials(std::vector<Material>(count, skin()));
        NacreCost cost{};
        ASSERT_EQ(nacreGetScatterCost(effect.context, NACRE_TECHNIQUE_THESIS, &cost), NACRE_SUCCESS);
        EXPECT_EQ(cost.dispatchesPerMaterial, 2u);
        EXPECT_EQ(cost.dispatchCount, 1 + 2 * count);
        EXPECT_EQ(cost.passCount, 2u);
        EXPECT_STREQ(cost.passNames[1], "nacre thesis materials");
        ScatterImages images(gpu, makeInput());
        images.info.technique = NACRE_TECHNIQUE_THESIS;
        ASSERT_EQ(nacreBeginFrame(effect.context, 0), NACRE_SUCCESS);
        callCounts() = {};
        const std::vector<double> times =
            gpu.runTimed(cost.passCount + 1, [&](VkCommandBuffer commandBuffer, VkQueryPool pool) {
                images.info.timestamps = {pool, 0};
                EXPECT_EQ(nacreCmdScatter(effect.context, commandBuffer, &images.info), NACRE_SUCCESS);
            });
        EXPECT_TRUE(std::all_of(times.begin(), times.end(), [](double time) { return time >= 0; }));
        EXPECT_EQ(callCounts().dispatches, static_cast<int>(cost.dispatchCount));
        EXPECT_EQ(callCounts().allocations, 0) << "recording allocates nothing";
    }
}

TEST_F(ThesisTest, RefusesWhatIsOutOfRange) {
    const ScatterInput input = makeInput();
    Effect effect(gpu, contextInfo());
    effect.setMaterials(materials);
    const auto message = [&](std::uint32_t radius, float strength, bool baked) -> std::string {
        try {
            scatter(effect, input, radius, strength, baked);
        } catch (const std::runtime_error& error) {
            return error.what();
        }
        return {};
    };
    EXPECT_EQ(message(17, 1, false), "NacreBaselineSettings::thesisRadius is 17, must be in [1, 16]");
    EXPECT_NE(message(5, -1, false).find("NacreBaselineSettings::thesisStrength is -1"), std::string::npos);
    EXPECT_NE(message(5, std::nanf(""), false).find("NacreBaselineSettings::thesisStrength is"), std::string::npos);
    EXPECT_NE(message(5, 1, true).find("nacreBakeThesisKernel was not called"), std::string::npos);
    EXPECT_EQ(nacreBakeThesisKernel(effect.context, 3, 5), NACRE_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(effect.messages.back(), "materialId is 3, which nacreSetMaterials has not set");
    EXPECT_EQ(nacreBakeThesisKernel(effect.context, 1, 17), NACRE_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(nacreBakeThesisKernel(effect.context, 1, 0), NACRE_SUCCESS);
    EXPECT_EQ(message(5, 1, true), "");
    EXPECT_EQ(message(6, 1, true), "NacreBaselineSettings::thesisRadius is 6, the baked kernel's is 5");
}

} // namespace
} // namespace nacre::tests
