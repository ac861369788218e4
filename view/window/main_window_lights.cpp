// Lights in the picture: their marks, and what the mouse does with them.
#include "view/window/compare_panel.hpp"
#include "view/window/look_panel.hpp"
#include "view/window/main_window.hpp"

#include <QDockWidget>

#include <algorithm>
#include <cmath>

namespace nacre::view {
namespace {

constexpr float markRadius = 6; // px
constexpr float selectedRadius = 9;

/// The light's colour as bright as it gets, as a display shows it.
glm::vec3 shownColor(const scene::Light& light) {
    const float most = std::max({light.color.x, light.color.y, light.color.z, 1e-6f});
    return glm::pow(glm::max(light.color, 0.0f) / most, glm::vec3(1 / 2.2f));
}

} // namespace

/// The lights that frames are drawn with: one alone where its image is shown.
void MainWindow::applyLights() {
    const EditedScene& edited = document_.edited();
    const bool one = look_->isOfOneLight() && document_.light() < edited.lights.size();
    loop_->setLights(one ? std::span(edited.lights).subspan(document_.light(), 1) : std::span(edited.lights));
    loop_->setEnvironment(one ? 0 : edited.environmentIntensity, edited.environmentRotation);
}

/// What the window draws over the frames: the divider and, while the panel Light is open, the lights.
void MainWindow::applyMarks() {
    if (!loop_) {
        return;
    }
    renderer::ShowLook shown = compare_->shown();
    std::vector<LightHandle> handles;
    const auto* dock = findChild<QDockWidget*>("dock.light");
    if (dock != nullptr && lightsShown_) {
        const vk::Extent2D size = loop_->extent();
        handles = lightHandles(document_.edited().lights, picture_->camera(),
                               static_cast<float>(size.width) / static_cast<float>(size.height));
    }
    for (const LightHandle& handle : handles) {
        shown.marks.push_back({.place = handle.place,
                               .end = handle.end,
                               .color = shownColor(document_.edited().lights[handle.light]),
                               .radius = handle.light == document_.light() ? selectedRadius : markRadius,
                               .hollow = handle.behind});
    }
    picture_->setHandles(std::move(handles));
    loop_->setShown(shown);
    picture_->wake();
}

void MainWindow::showLights(bool shown) {
    lightsShown_ = shown;
    applyMarks();
}

void MainWindow::changeLight(std::size_t index, const std::function<void(scene::Light&)>& change) {
    if (index < document_.edited().lights.size()) {
        document_.edit("drag light", "light.drag", [&](EditedScene& scene) { change(scene.lights[index]); });
    }
}

void MainWindow::connectLights() {
    connect(picture_, &PictureWindow::lightHeld, &document_, &Document::selectLight);
    connect(picture_, &PictureWindow::lightDropped, &document_, &Document::endEdit);
    connect(picture_, &PictureWindow::lightPushed, this, [this](std::size_t index, float factor) {
        changeLight(index, [&](scene::Light& light) { light = pushedLight(light, picture_->camera(), factor); });
    });
    connect(
        picture_, &PictureWindow::lightDragged, this, [this](std::size_t index, QPointF place, bool aim, bool behind) {
            const vk::Extent2D size = loop_->extent();
            const float aspect = static_cast<float>(size.width) / static_cast<float>(size.height);
            const auto dragged = draggedLight(document_.edited().lights.at(index), picture_->camera(), aspect,
                                              {place.x(), place.y()}, aim ? LightDrag::Aim : LightDrag::Move, behind);
            picture_->leftSphere(!dragged);
            if (dragged) {
                changeLight(index, [&](scene::Light& light) { light = *dragged; });
            }
        });
    connect(picture_, &PictureWindow::cameraMoved, this, &MainWindow::applyMarks);
    connect(&document_, &Document::selectionChanged, this, [this] {
        if (loop_ && look_->isOfOneLight()) {
            applyLights();
        }
        applyMarks();
    });
}

} // namespace nacre::view
