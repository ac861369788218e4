#include "view/window/picture_window.hpp"

#include "view/model/camera_control.hpp"

#include <QDropEvent>
#include <QMimeData>
#include <QMouseEvent>
#include <QPlatformSurfaceEvent>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace nacre::view {
namespace {

constexpr int busyMilliseconds = 3;     ///< until a device that is at it is asked again
constexpr int stillMilliseconds = 200;  ///< without a movement, until the picture is drawn in full
constexpr int resizeMilliseconds = 300; ///< of one size, until the picture gets it
constexpr double clickPixels = 4;       ///< a press that moved less is a click
constexpr double dividerPixels = 8;     ///< from here the divider is taken hold of
constexpr double handlePixels = 12;     ///< likewise a light
constexpr float zoomPerStep = 0.9f;     ///< of the distance, for one step of the wheel
constexpr float flyRadii = 0.5f;        ///< scene radii in a second
constexpr float turnPerKey = std::numbers::pi_v<float> / 36;
constexpr float shiftPerKey = 0.05f; ///< of the picture's height

/// A key that flies, and where to: right, up, forward.
struct FlyKey {
    int key;
    glm::vec3 direction;
};
constexpr std::array flyKeys{FlyKey{Qt::Key_D, {1, 0, 0}}, FlyKey{Qt::Key_A, {-1, 0, 0}},
                             FlyKey{Qt::Key_E, {0, 1, 0}}, FlyKey{Qt::Key_Q, {0, -1, 0}},
                             FlyKey{Qt::Key_W, {0, 0, 1}}, FlyKey{Qt::Key_S, {0, 0, -1}}};

/// An arrow key, and where it turns or shifts the picture: right, down.
struct ArrowKey {
    int key;
    glm::vec2 direction;
};
constexpr std::array arrowKeys{ArrowKey{Qt::Key_Left, {-1, 0}}, ArrowKey{Qt::Key_Right, {1, 0}},
                               ArrowKey{Qt::Key_Up, {0, -1}}, ArrowKey{Qt::Key_Down, {0, 1}}};

bool isFlyKey(const QKeyEvent& event) {
    return event.modifiers() == Qt::NoModifier &&
           std::ranges::any_of(flyKeys, [&](const FlyKey& fly) { return fly.key == event.key(); });
}

} // namespace

PictureWindow::PictureWindow(QVulkanInstance* instance) : instance_(instance) {
    setObjectName("picture");
    if (instance != nullptr) {
        setSurfaceType(QSurface::VulkanSurface);
        setVulkanInstance(instance);
    }
    timer_.setSingleShot(true);
    still_.setSingleShot(true);
    resize_.setSingleShot(true);
    connect(&timer_, &QTimer::timeout, this, &PictureWindow::tick);
    connect(&still_, &QTimer::timeout, this, [this] {
        if (loop_ != nullptr) {
            loop_->setMoving(false);
            wake();
        }
    });
    connect(&resize_, &QTimer::timeout, this, &PictureWindow::resizePicture);
}

PictureWindow::~PictureWindow() {
    setLoop(nullptr, camera_, sceneRadius_);
}

template <typename Action> void PictureWindow::guarded(const Action& action) {
    try {
        action();
    } catch (const renderer::DeviceLost& error) {
        timer_.stop();
        loop_ = nullptr;
        hasSurface_ = false;
        Q_EMIT lost(QString::fromUtf8(error.what()));
    } catch (const std::exception& error) {
        timer_.stop();
        Q_EMIT failed(QString::fromUtf8(error.what()));
    }
}

void PictureWindow::setLoop(PictureLoop* loop, const scene::Camera& camera, float sceneRadius) {
    timer_.stop();
    if (loop_ != nullptr && hasSurface_) {
        guarded([&] { loop_->setSurface(nullptr, nullptr); });
        hasSurface_ = false;
    }
    loop_ = loop;
    camera_ = camera;
    sceneRadius_ = sceneRadius;
    if (loop_ != nullptr) {
        guarded([&] {
            loop_->setCamera(camera_);
            connectSurface();
        });
        wake();
    }
}

void PictureWindow::connectSurface() {
    if (loop_ == nullptr || instance_ == nullptr || hasSurface_ || !isExposed()) {
        return;
    }
    const VkSurfaceKHR surface = QVulkanInstance::surfaceForWindow(this);
    if (surface == VK_NULL_HANDLE) {
        Q_EMIT failed("the window system gives no Vulkan surface for the picture");
        return;
    }
    loop_->setSurface(surface, [this] {
        const QSize pixels = size() * devicePixelRatio();
        return vk::Extent2D{static_cast<std::uint32_t>(pixels.width()), static_cast<std::uint32_t>(pixels.height())};
    });
    hasSurface_ = true;
}

void PictureWindow::wake() {
    if (loop_ != nullptr && !timer_.isActive()) {
        timer_.start(0);
    }
}

void PictureWindow::move() {
    if (loop_ != nullptr) {
        loop_->setMoving(true);
        still_.start(stillMilliseconds);
        wake();
    }
}

void PictureWindow::setCamera(const scene::Camera& camera) {
    camera_ = camera;
    applyCamera();
}

void PictureWindow::applyCamera() {
    if (loop_ != nullptr) {
        loop_->setCamera(camera_);
        move();
        Q_EMIT cameraMoved();
    }
}

QSize PictureWindow::pictureSize() const {
    return (size() * devicePixelRatio()).expandedTo(QSize(16, 16));
}

void PictureWindow::tick() {
    if (loop_ == nullptr) {
        return;
    }
    guarded([&] {
        flyOn();
        switch (loop_->step()) {
        case Step::Drawn:
            timer_.start(0);
            break;
        case Step::Busy:
            timer_.start(busyMilliseconds);
            break;
        case Step::Converged:
        case Step::Hidden:
            break;
        }
        Q_EMIT stepped();
    });
}

void PictureWindow::flyOn() {
    if (keys_.empty()) {
        return;
    }
    const auto seconds = static_cast<float>(std::min<qint64>(flown_.restart(), 250)) / 1000;
    glm::vec3 direction(0);
    for (const FlyKey& fly : flyKeys) {
        direction += keys_.contains(fly.key) ? fly.direction : glm::vec3(0);
    }
    if (direction != glm::vec3(0)) {
        fly(camera_, direction * (seconds * flyRadii * sceneRadius_));
        applyCamera();
    }
}

void PictureWindow::resizePicture() {
    if (loop_ != nullptr) {
        guarded([&] {
            const QSize size = pictureSize();
            loop_->resize(static_cast<std::uint32_t>(size.width()), static_cast<std::uint32_t>(size.height()));
            wake();
        });
    }
}

QPointF PictureWindow::placeOf(const QPointF& position) const {
    if (loop_ == nullptr) {
        return {-1, -1};
    }
    const double zoom = std::min(width() / double(loop_->extent().width), height() / double(loop_->extent().height));
    const QPointF shown(loop_->extent().width * zoom, loop_->extent().height * zoom);
    return {(position.x() - 0.5 * (width() - shown.x())) / shown.x(),
            (position.y() - 0.5 * (height() - shown.y())) / shown.y()};
}

std::optional<LightHandle> PictureWindow::handleAt(const QPointF& position) const {
    if (loop_ == nullptr) {
        return std::nullopt;
    }
    const QPointF place = placeOf(position);
    const QPointF perPixel = placeOf(position + QPointF(1, 1)) - place;
    std::optional<LightHandle> nearest;
    double least = handlePixels;
    for (const LightHandle& handle : handles_) {
        const double distance =
            std::hypot((handle.place.x - place.x()) / perPixel.x(), (handle.place.y - place.y()) / perPixel.y());
        if (distance < least) {
            least = distance;
            nearest = handle;
        }
    }
    return nearest;
}

/// Out of its sphere and in again brings a directional light to the other side.
void PictureWindow::dragLight(const QMouseEvent& event, const QPointF& step) {
    if (event.modifiers() & Qt::ControlModifier) {
        Q_EMIT lightPushed(held_->light, static_cast<float>(std::exp(-2 * step.y() / std::max(1, height()))));
    } else {
        Q_EMIT lightDragged(held_->light, placeOf(event.position()), bool(event.modifiers() & Qt::ShiftModifier),
                            held_->behind);
    }
}

void PictureWindow::leftSphere(bool outside) {
    if (held_ && heldOutside_ && !outside) {
        held_->behind = !held_->behind;
    }
    heldOutside_ = outside;
}

bool PictureWindow::event(QEvent* event) {
    switch (event->type()) {
    case QEvent::PlatformSurface:
        if (static_cast<QPlatformSurfaceEvent*>(event)->surfaceEventType() ==
                QPlatformSurfaceEvent::SurfaceAboutToBeDestroyed &&
            loop_ != nullptr && hasSurface_) {
            guarded([&] { loop_->setSurface(nullptr, nullptr); });
            hasSurface_ = false;
        }
        break;
    case QEvent::DragEnter:
    case QEvent::DragMove:
        static_cast<QDropEvent*>(event)->acceptProposedAction();
        return true;
    case QEvent::Drop: {
        auto* drop = static_cast<QDropEvent*>(event);
        if (drop->mimeData()->hasUrls()) {
            drop->acceptProposedAction();
            Q_EMIT dropped(drop->mimeData()->urls().first().toLocalFile());
        }
        return true;
    }
    default:
        break;
    }
    return QWindow::event(event);
}

void PictureWindow::exposeEvent(QExposeEvent*) {
    if (isExposed()) {
        guarded([&] { connectSurface(); });
        wake();
    } else {
        timer_.stop();
    }
}

void PictureWindow::resizeEvent(QResizeEvent*) {
    if (loop_ != nullptr) {
        guarded([&] { loop_->windowChanged(); });
        resize_.start(resizeMilliseconds);
        wake();
    }
}

void PictureWindow::mousePressEvent(QMouseEvent* event) {
    pressed_ = last_ = event->position();
    dragged_ = false;
    draggingDivider_ = comparing_ && event->button() == Qt::LeftButton &&
                       std::abs(placeOf(event->position()).x() - divider_) * width() < dividerPixels;
    held_ = event->button() == Qt::LeftButton ? handleAt(event->position()) : std::nullopt;
    heldOutside_ = false;
    if (held_) {
        draggingDivider_ = false;
        Q_EMIT lightHeld(held_->light);
    }
}

void PictureWindow::mouseMoveEvent(QMouseEvent* event) {
    if (event->buttons() == Qt::NoButton) {
        return;
    }
    const QPointF step = event->position() - last_;
    last_ = event->position();
    dragged_ = dragged_ || (last_ - pressed_).manhattanLength() > clickPixels;
    if (!dragged_) {
        return;
    }
    if (held_) {
        dragLight(*event, step);
        return;
    }
    if (draggingDivider_) {
        divider_ = std::clamp(static_cast<float>(event->position().x() / width()), 0.0f, 1.0f);
        Q_EMIT dividerMoved(divider_);
        return;
    }
    const auto share = glm::vec2(step.x(), step.y()) / static_cast<float>(std::max(1, height()));
    const glm::vec2 turn = std::numbers::pi_v<float> * share;
    if (event->buttons() & Qt::RightButton) {
        look(camera_, {turn.x * 0.5f, -turn.y * 0.5f});
    } else if (event->buttons() & Qt::MiddleButton || event->modifiers() & Qt::ShiftModifier) {
        pan(camera_, share);
    } else if (event->modifiers() & Qt::ControlModifier) {
        zoom(camera_, std::exp(2 * share.y));
    } else {
        orbit(camera_, turn);
    }
    applyCamera();
}

void PictureWindow::mouseReleaseEvent(QMouseEvent* event) {
    const QPointF place = placeOf(event->position());
    const bool inside = place.x() >= 0 && place.x() < 1 && place.y() >= 0 && place.y() < 1;
    if (held_) {
        Q_EMIT lightDropped();
    } else if (!dragged_ && inside && event->button() == Qt::LeftButton) {
        Q_EMIT clicked(place);
    }
    held_.reset();
    draggingDivider_ = false;
}

void PictureWindow::wheelEvent(QWheelEvent* event) {
    constexpr float stepAngle = 120; // eighths of a degree
    zoom(camera_, std::pow(zoomPerStep, static_cast<float>(event->angleDelta().y()) / stepAngle));
    applyCamera();
}

/// What the mouse does, for the keyboard; false where the key means something else.
bool PictureWindow::moveByKey(const QKeyEvent& event) {
    const auto arrow = std::ranges::find(arrowKeys, event.key(), &ArrowKey::key);
    if (arrow != arrowKeys.end() && event.modifiers().testFlag(Qt::ShiftModifier)) {
        pan(camera_, shiftPerKey * arrow->direction);
    } else if (arrow != arrowKeys.end()) {
        orbit(camera_, turnPerKey * arrow->direction);
    } else if (event.text() == "+" || event.text() == "-") {
        zoom(camera_, event.text() == "+" ? zoomPerStep : 1 / zoomPerStep);
    } else if (event.key() == Qt::Key_Space) {
        Q_EMIT clicked({0.5, 0.5});
        return true;
    } else {
        return false;
    }
    applyCamera();
    return true;
}

void PictureWindow::keyPressEvent(QKeyEvent* event) {
    if (!isFlyKey(*event)) {
        if (!moveByKey(*event)) {
            Q_EMIT keyed(event);
        }
        return;
    }
    if (!event->isAutoRepeat()) {
        keys_.insert(event->key());
        flown_.start();
        wake();
    }
}

void PictureWindow::keyReleaseEvent(QKeyEvent* event) {
    if (isFlyKey(*event) && !event->isAutoRepeat()) {
        keys_.erase(event->key());
    }
}

} // namespace nacre::view
