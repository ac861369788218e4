// What a reference promises whatever happens: the same picture for a seed on any number of threads, in parts, and
// resumed.
#include "nacre/files.hpp"
#include "reference/checkpoint.hpp"
#include "reference/reference.hpp"
#include "tests/support/reference_scenes.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <fstream>

namespace {

using namespace nacre;
using namespace nacre::test;
using reference::Checkpoint;
using reference::Film;
using reference::Method;
using reference::Reference;
using reference::Settings;
using reference::Stop;
using reference::Stopped;

/// A ball before a plain wall, lit by a lamp and the sky; some pixels see neither.
scene::Scene makeScene() {
    const Material material = burleyMaterial({0.8, 0.4, 0.2});
    scene::Scene scene = darkScene();
    addMesh(scene, ball(4, 24), addSurface(scene, &material));
    addMesh(scene, rectangle({-5, -5}, {5, 9}, -4), addSurface(scene, nullptr));
    scene.lights = {directionalLight({1, -1, 0.3f})};
    scene.environment = evenSurroundings(0.3f);
    return scene;
}

class ReferenceRunTest : public testing::TestWithParam<Method> {
protected:
    Settings settings() const {
        Settings settings;
        settings.method = GetParam();
        settings.width = 20;
        settings.height = 16;
        settings.threads = 2;
        return settings;
    }
    Stop stopAt(std::uint32_t spp) const {
        Stop stop;
        stop.spp = spp;
        return stop;
    }
    Film compute(const Settings& with, const Stop& stop) const {
        Reference reference(scene_, camera_, with);
        reference.run(stop, [](const reference::Progress&) { return true; });
        return reference.film();
    }

    const scene::Scene scene_ = makeScene();
    const scene::Camera camera_ = downwardCamera(14);
};

void expectSame(const Film& one, const Film& other) {
    EXPECT_TRUE(one.pixels == other.pixels);
    EXPECT_EQ(one.materials, other.materials);
    EXPECT_EQ(one.coverage, other.coverage);
    EXPECT_TRUE(one.incidents == other.incidents);
}

TEST_P(ReferenceRunTest, DoesNotDependOnThreads) {
    Settings settings = this->settings();
    const Film two = compute(settings, stopAt(20));
    for (const unsigned threads : {1u, 5u}) {
        settings.threads = threads;
        expectSame(compute(settings, stopAt(20)), two);
    }
    EXPECT_GT(two.noise(), 0);
    settings.seed = 2;
    EXPECT_FALSE(compute(settings, stopAt(20)).pixels == two.pixels);
}

TEST_P(ReferenceRunTest, PartsMergeToTheWhole) {
    tests::TemporaryFolder folder;
    Settings settings = this->settings();
    const Film whole = compute(settings, stopAt(6));
    std::vector<std::filesystem::path> files;
    for (std::uint32_t i = 1; i <= 3; ++i) {
        settings.part = {i, 3};
        Reference part(scene_, camera_, settings);
        part.run(stopAt(6), [](const reference::Progress&) { return true; });
        files.push_back(folder.path / ("part" + std::to_string(i)));
        reference::saveCheckpoint(files.back(), {part.identity(), settings.part, part.film()});
        EXPECT_LT(part.film().sampleCount(), whole.sampleCount() / 2);
    }
    const Checkpoint merged = reference::merge({files[2], files[0], files[1]});
    expectSame(merged.film, whole);
    EXPECT_EQ(reference::channelValues(merged.film), reference::channelValues(whole));
    EXPECT_THROW(reference::merge({files[0], files[1]}), FileError);
    EXPECT_THROW(reference::merge({files[0], files[1], files[1]}), FileError);
}

TEST_P(ReferenceRunTest, ResumedIsUninterrupted) {
    tests::TemporaryFolder folder;
    const std::filesystem::path file = folder.path / "checkpoint";
    const Settings settings = this->settings();
    const Film whole = compute(settings, stopAt(21));
    // Stopped in the middle of a pass, after the first slice of it.
    Reference first(scene_, camera_, settings);
    int slices = 0;
    EXPECT_EQ(first.run(stopAt(21), [&](const reference::Progress&) { return ++slices < 5; }), Stopped::Interrupted);
    EXPECT_LT(first.film().sampleCount(), whole.sampleCount());
    reference::saveCheckpoint(file, {first.identity(), settings.part, first.film()});
    Reference second(scene_, camera_, settings);
    Checkpoint checkpoint = reference::loadCheckpoint(file);
    trace::requireSameIdentity(file, checkpoint.identity, second.identity());
    second.resume(std::move(checkpoint.film));
    EXPECT_EQ(second.run(stopAt(21), [](const reference::Progress&) { return true; }), Stopped::Spp);
    expectSame(second.film(), whole);
}

TEST_P(ReferenceRunTest, StopsAtItsNoise) {
    Stop stop;
    stop.noise = 0.05;
    stop.spp = 4000;
    const Film film = compute(settings(), stop);
    EXPECT_LE(film.noise(), 0.05);
    EXPECT_LT(film.sampleCount(), 4000u * film.pixels.size());
    // The error that it tells is the one that it has, against many more samples.
    Settings other = settings();
    other.seed = 99;
    const Film better = compute(other, stopAt(1500));
    double squares = 0;
    double sum = 0;
    double values = 0;
    for (std::size_t i = 0; i < film.pixels.size(); ++i) {
        if (film.materials[i] != 0) {
            const glm::dvec3 difference = film.pixels[i].mean() - better.pixels[i].mean();
            squares += glm::dot(difference, difference);
            const glm::dvec3 mean = better.pixels[i].mean();
            sum += mean.r + mean.g + mean.b;
            values += 3;
        }
    }
    const double error = std::sqrt(squares / values) / (sum / values);
    EXPECT_GT(error, 0.6 * film.noise());
    EXPECT_LT(error, 1.6 * film.noise());
}

INSTANTIATE_TEST_SUITE_P(Methods, ReferenceRunTest, testing::Values(Method::Surface, Method::Walk),
                         [](const auto& test) { return reference::methodName(test.param); });

TEST(CheckpointTest, DamageAndStrangersAreRefused) {
    tests::TemporaryFolder folder;
    const std::filesystem::path file = folder.path / "film.exr.checkpoint";
    Film film(3, 2);
    film.pixels[4].add({1, 2, 3});
    reference::saveCheckpoint(file, {{{"seed", "1"}}, {}, film});
    const Checkpoint whole = reference::loadCheckpoint(file);
    EXPECT_TRUE(whole.film.pixels == film.pixels);
    EXPECT_THROW(trace::requireSameIdentity(file, whole.identity, {{"seed", "2"}}), FileError);
    EXPECT_THROW(trace::requireSameIdentity(file, whole.identity, {{"size", "3x2"}}), FileError);
    std::vector<std::uint8_t> bytes = readFile(file);
    for (const std::size_t size : {std::size_t{0}, std::size_t{20}, bytes.size() / 2, bytes.size() - 1}) {
        writeFileAtomically(file, std::span(bytes).first(size));
        EXPECT_THROW(reference::loadCheckpoint(file), FileError) << size;
    }
    bytes[bytes.size() / 2] ^= 1;
    writeFileAtomically(file, bytes);
    EXPECT_THROW(reference::loadCheckpoint(file), FileError);
}

TEST(PartTest, DealOutEveryPixelOnceAndEvenly) {
    std::array<int, 7> counts{};
    for (std::uint32_t pixel = 0; pixel < 70000; ++pixel) {
        int owners = 0;
        for (std::uint32_t i = 1; i <= 7; ++i) {
            if (reference::Part{i, 7}.has(pixel)) {
                ++owners;
                ++counts[i - 1];
            }
        }
        ASSERT_EQ(owners, 1);
    }
    for (const int count : counts) {
        EXPECT_NEAR(count, 10000, 500);
    }
}

} // namespace
