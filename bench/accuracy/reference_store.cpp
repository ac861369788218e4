#include "bench/accuracy/reference_store.hpp"

#include "image/image_file.hpp"
#include "reference/checkpoint.hpp"
#include "trace/fingerprint.hpp"
#include "trace/work_file.hpp"

#include <chrono>
#include <utility>

namespace nacre::bench {
namespace {

using reference::Reference;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds saveInterval{30};

std::string printOf(const Reference& reference) {
    trace::Fingerprint print;
    for (const auto& [name, value] : reference.identity()) {
        print.add(std::as_bytes(std::span(name)));
        print.add(std::as_bytes(std::span(value)));
    }
    return print.text();
}

void save(const std::filesystem::path& picture, const Reference& reference) {
    const reference::Film& film = reference.film();
    reference::saveCheckpoint(trace::checkpointOf(picture), {reference.identity(), {}, film});
    writeExr(picture, {film.width, film.height, reference::channelNames(), reference::channelValues(film)});
}

void resume(const std::filesystem::path& picture, Reference& reference) {
    const std::filesystem::path file = trace::checkpointOf(picture);
    if (std::filesystem::exists(file)) {
        reference::Checkpoint checkpoint = reference::loadCheckpoint(file);
        trace::requireSameIdentity(file, checkpoint.identity, reference.identity());
        reference.resume(std::move(checkpoint.film));
    }
}

} // namespace

ReferenceStore::ReferenceStore(std::filesystem::path folder) : folder_(std::move(folder)) {
    std::error_code error;
    std::filesystem::create_directories(folder_, error);
    if (!std::filesystem::is_directory(folder_)) {
        throw std::runtime_error(folder_.string() + ": cannot be made: " + error.message());
    }
}

StoredReference ReferenceStore::get(const AccuracyView& view, reference::Method method, const Size& size,
                                    reference::Stop stop,
                                    const std::function<bool(const reference::Progress&)>& proceed) const {
    reference::Settings settings;
    settings.method = method;
    settings.width = size.width;
    settings.height = size.height;
    Reference reference(*view.scene, view.camera, settings);
    const std::filesystem::path picture =
        folder_ / (view.name + '-' + reference::methodName(method) + '-' + printOf(reference) + ".exr");
    resume(picture, reference);
    const std::uint64_t samplesBefore = reference.film().sampleCount();
    const double secondsBefore = reference.film().seconds;
    if (stop.seconds) {
        *stop.seconds -= secondsBefore;
    }
    if (!stop.seconds || *stop.seconds > 0) {
        Clock::time_point saved = Clock::now();
        reference.run(stop, [&](const reference::Progress& progress) {
            if (Clock::now() - saved > saveInterval) {
                save(picture, reference);
                saved = Clock::now();
            }
            return proceed(progress);
        });
    }
    const bool wasThere = samplesBefore > 0 && reference.film().sampleCount() == samplesBefore;
    if (!wasThere) {
        save(picture, reference);
    }
    return {reference.film(), wasThere, reference.warnings()};
}

} // namespace nacre::bench
