#include "view/window/main_window.hpp"

#include "renderer/vulkan/open_device.hpp"
#include "view/window/compare_panel.hpp"
#include "view/window/inspect_panel.hpp"
#include "view/window/look_panel.hpp"
#include "view/window/material_panel.hpp"
#include "view/window/plain_text.hpp"
#include "view/window/recovery.hpp"
#include "view/window/timing_panel.hpp"

#include <QApplication>
#include <QDeadlineTimer>
#include <QDockWidget>
#include <QScreen>
#include <QSettings>
#include <QStatusBar>

#include <cmath>

namespace nacre::view {
namespace {

constexpr std::uint32_t softwareShadowMapSize = 512;
constexpr std::uint32_t softwareSamples = 16;
constexpr std::uint32_t mostLights = 16;
constexpr std::uint32_t mostShadowLayers = 12; // a point light has six
constexpr float composedAspect = 16.0f / 9;    // what scenes' cameras are made for
constexpr int recoveryMilliseconds = 500;      // after an edit, until it is safe
constexpr int swatchMilliseconds = 2;          // until the device is asked again
constexpr int noteMilliseconds = 10'000;       // that a sentence stays in the status bar

bool sameEffect(const renderer::EffectSettings& one, const renderer::EffectSettings& other) {
    return one.technique == other.technique && one.scatter == other.scatter && one.transmit == other.transmit;
}

/// What scatter and transmit took of a frame, ms.
double effectMilliseconds(const renderer::FrameReport& report) {
    double sum = 0;
    for (const renderer::PassTime& pass : report.passes) {
        sum += pass.name.starts_with("scatter") || pass.name.starts_with("transmit") ? pass.microseconds / 1e3 : 0;
    }
    return sum;
}

/// The device, with what a window needs.
renderer::DeviceSettings windowDevice(renderer::DeviceSettings settings) {
    settings.instanceExtensions = surfaceExtensions();
    if (!settings.instanceExtensions.empty()) {
        settings.deviceExtensions = renderer::Swapchain::deviceExtensions();
    }
    return settings;
}

} // namespace

std::vector<std::string> surfaceExtensions() {
    const QString platform = QGuiApplication::platformName();
    if (platform == "xcb") {
        return {VK_KHR_SURFACE_EXTENSION_NAME, "VK_KHR_xcb_surface"};
    }
    if (platform.startsWith("wayland")) {
        return {VK_KHR_SURFACE_EXTENSION_NAME, "VK_KHR_wayland_surface"};
    }
    return {};
}

MainWindow::MainWindow(const renderer::DeviceSettings& device) : device_(windowDevice(device)) {
    setObjectName("window");
    setAcceptDrops(true);
    const bool hasSurfaces = !surfaceExtensions().empty();
    if (hasSurfaces) {
        instance_.setVkInstance(static_cast<VkInstance>(*device_.implementation().instance));
        if (!instance_.create()) {
            throw renderer::RendererError("Qt cannot use the Vulkan instance for its windows");
        }
    }
    picture_ = new PictureWindow(hasSurfaces ? &instance_ : nullptr);
    pictureContainer_ = QWidget::createWindowContainer(picture_, this);
    pictureContainer_->setMinimumSize(160, 120);
    pictureContainer_->setFocusPolicy(Qt::StrongFocus);
    pictureContainer_->setAccessibleName("Picture");
    setCentralWidget(pictureContainer_);
    makePanels();
    makeMenus();
    makeStatusBar();
    restoreWindow();

    connect(&document_, &Document::opened, this, &MainWindow::sceneOpened);
    connect(&document_, &Document::changed, this, &MainWindow::applyScene);
    connect(&document_, &Document::changedOnDisk, this, &MainWindow::changedOnDisk);
    connect(picture_, &PictureWindow::stepped, this, &MainWindow::showStatus);
    connect(picture_, &PictureWindow::failed, this, &MainWindow::pictureFailed);
    connect(picture_, &PictureWindow::lost, this, &MainWindow::deviceLost);
    connectLights();
    connect(picture_, &PictureWindow::clicked, this, &MainWindow::pick);
    connect(picture_, &PictureWindow::dropped, this, &MainWindow::openAny);
    connect(picture_, &PictureWindow::keyed, this, [this](QKeyEvent* event) { keyPressEvent(event); });
    connect(picture_, &PictureWindow::dividerMoved, compare_, &ComparePanel::setDivider);
    connect(picture_, &PictureWindow::cameraMoved, compare_, &ComparePanel::outdate);
    recovery_ = std::make_unique<Recovery>();
    recoveryTimer_.setSingleShot(true);
    swatchTimer_.setSingleShot(true);
    connect(&swatchTimer_, &QTimer::timeout, this, &MainWindow::drawSwatch);
    connect(&recoveryTimer_, &QTimer::timeout, this, &MainWindow::saveRecovery);
}

/// Whether the panel Material shows a swatch of what is no longer the material.
bool MainWindow::isSwatchDue() const {
    return loop_ && (swatchTimer_.isActive() ||
                     (material_->isSwatchSeen() &&
                      swatchMaterial_ != document_.edited().materials.at(document_.material()).drawn()));
}

/// The picture comes first: the swatch is drawn while that stands still.
void MainWindow::drawSwatch() {
    if (!loop_ || !loop_->isConverged()) {
        return;
    }
    try {
        if (!swatch_) {
            constexpr double millimetersPerInch = 25.4;
            swatch_ = std::make_unique<Swatch>(device_, screen()->physicalDotsPerInch() * devicePixelRatioF() /
                                                            millimetersPerInch);
        }
        const Material material = document_.edited().materials.at(document_.material()).drawn();
        if (swatchMaterial_ != material) {
            swatch_->setMaterial(material);
            swatchMaterial_ = material;
        }
        if (swatch_->step()) {
            material_->showSwatch(swatch_->picture());
        } else {
            swatchTimer_.start(swatchMilliseconds);
        }
    } catch (const renderer::DeviceLost& error) {
        deviceLost(QString::fromUtf8(error.what()));
    } catch (const std::exception& error) {
        complain(QString::fromUtf8(error.what()));
    }
}

MainWindow::~MainWindow() {
    // Panels are hidden while the window goes, which is nothing to act on.
    for (const Panel& panel : panels_) {
        panel.dock->disconnect(this);
    }
    compare_->stop();
    if (quiet_) {
        recovery_->remove(); // a script's edits are no one's
    }
    picture_->setLoop(nullptr, picture_->camera(), 1);
    // The picture's surface has to go before its instance, which is the device's.
    delete pictureContainer_;
}

void MainWindow::restoreWindow() {
    const QSettings stored;
    resize(1360, 820);
    if (!quiet_) {
        restoreGeometry(stored.value("geometry").toByteArray());
    }
    setDark(stored.value("dark", true).toBool());
}

void MainWindow::makeLoop() {
    LoopSettings settings;
    const QSize size = picture_->pictureSize();
    settings.width = static_cast<std::uint32_t>(size.width());
    settings.height = static_cast<std::uint32_t>(size.height());
    if (device_.description().kind == "software") {
        settings.shadowMapSize = softwareShadowMapSize;
        settings.stillSamples = softwareSamples;
    }
    settings.stillSamples = stillSamples_.value_or(settings.stillSamples);
    settings.lights = mostLights;
    settings.shadowLayers = mostShadowLayers;
    loop_ = std::make_unique<PictureLoop>(device_, drawn_, settings);
    sides_ = {};
    for (std::uint32_t side = 0; side < renderer::Accumulation::sideCount; ++side) {
        loop_->setSide(side, sides_[side]);
    }
    loop_->onFinished = [this](const renderer::FrameReport& report) {
        timing_->add(report, loop_->stepMilliseconds());
    };
}

void MainWindow::sceneOpened() {
    picture_->setLoop(nullptr, picture_->camera(), 1);
    compare_->outdate();
    geometry_.reset();
    loop_.reset();
    drawn_ = document_.scene();
    makeLoop();
    applyView();
    picture_->setLoop(loop_.get(), firstCamera(), scene::bounds(drawn_).radius());
    inspect_->show(std::nullopt);
    setWindowTitle("Nacre – " + document_.name());
}

/// Other surroundings are prepared with everything else; the camera stays.
void MainWindow::remakeLoop() {
    const scene::Camera camera = picture_->camera();
    picture_->setLoop(nullptr, camera, 1);
    loop_.reset();
    drawn_.environment = document_.current().environment;
    makeLoop();
    picture_->setLoop(loop_.get(), camera, scene::bounds(drawn_).radius());
}

/// Hands everything that was edited to the loop; what is as it was costs next to nothing.
void MainWindow::applyScene() {
    if (!loop_) {
        return;
    }
    try {
        const EditedScene& edited = document_.edited();
        if (edited.environmentFile != drawn_.environment.file) {
            remakeLoop();
        }
        loop_->setMaterials(drawnMaterials(edited));
        loop_->setSurfaces(edited.surfaces);
        applyLights();
        applyView();
        if (!opening_) {
            picture_->move();
            compare_->outdate();
            recoveryTimer_.start(recoveryMilliseconds);
        }
    } catch (const std::exception& error) {
        complain(QString::fromUtf8(error.what()));
        // What cannot be drawn is taken back, once the command that did it is through.
        QTimer::singleShot(0, this, [this] { document_.history().undo(); });
    }
}

/// The scene's first camera. A window that is narrower than pictures are composed for shows as much from left to right.
scene::Camera MainWindow::firstCamera() const {
    scene::Camera camera = drawn_.cameras.at(0);
    camera.verticalFieldOfView = 2 * std::atan(widening() * std::tan(camera.verticalFieldOfView / 2));
    camera.orthographicHeight *= widening();
    return camera;
}

float MainWindow::widening() const {
    const QSize size = picture_->pictureSize();
    return std::max(1.0f, composedAspect * static_cast<float>(size.height()) / static_cast<float>(size.width()));
}

/// What is shown of the frames.
void MainWindow::applyView() {
    if (!loop_) {
        return;
    }
    renderer::SampleLook look;
    look.image = look_->image();
    look.curve = look_->toneCurve();
    look.backdrop = look_->backdrop();
    look.exposure = document_.scene().exposure * std::exp2(document_.edited().exposureStops);
    const glm::vec3 center = scene::bounds(drawn_).center();
    const float distance = glm::distance(drawn_.cameras.at(0).position, center);
    const float radius = scene::bounds(drawn_).radius();
    look.depthRange = {std::max(0.0f, distance - radius), distance + radius};
    for (std::uint32_t side = 0; side < renderer::Accumulation::sideCount; ++side) {
        const SideSettings wanted = compare_->side(side, look);
        if (!(wanted.look == sides_[side].look) || !sameEffect(wanted.effect, sides_[side].effect)) {
            loop_->setSide(side, wanted);
            sides_[side] = wanted;
        }
    }
    applyMarks();
    picture_->setDivider(compare_->shown().divider);
    picture_->setComparing(compare_->isComparing() && compare_->shown().sides == renderer::ShownSides::Both);
    measured_ = false;
    picture_->wake();
}

void MainWindow::showStatus() {
    if (!loop_) {
        return;
    }
    const renderer::FrameReport& report = loop_->report();
    const vk::Extent2D size = loop_->drawnExtent();
    QString text = QString("%1 × %2 px").arg(size.width).arg(size.height);
    text += loop_->isCoarse() ? ", coarse while it moves"
            : loop_->isConverged()
                ? QString(loop_->samples(0) == 1 ? ", %1 sample, finished" : ", %1 samples, finished")
                      .arg(loop_->samples(0))
                : QString(", sample %1 of %2").arg(loop_->samples(0)).arg(loop_->settings().stillSamples);
    if (report.totalMicroseconds > 0) {
        text += QString("   frame %1 ms, effect %2 ms")
                    .arg(report.totalMicroseconds / 1e3, 0, 'f', report.totalMicroseconds < 1e4 ? 2 : 0)
                    .arg(effectMilliseconds(report), 0, 'f', report.totalMicroseconds < 1e4 ? 2 : 0);
    }
    pictureStatus_->setText(text);
    pictureFault_.clear();
    if (!loop_->isConverged()) {
        measured_ = false;
    } else if (!measured_) {
        measured_ = true;
        compare_->measure();
    }
    // A script draws it for its screenshots.
    if (!quiet_ && loop_->isConverged() && !swatchTimer_.isActive() && isSwatchDue()) {
        swatchTimer_.start(0);
    }
}

void MainWindow::finishSwatch() {
    if (!isSwatchDue()) {
        return;
    }
    do {
        drawSwatch();
        QApplication::processEvents();
    } while (swatchTimer_.isActive());
}

bool MainWindow::drawUntilStill(int milliseconds) {
    const QDeadlineTimer deadline(milliseconds);
    if (loop_) {
        loop_->setMoving(false);
    }
    picture_->wake();
    QTimer heartbeat; // so that a window that draws nothing does not wait for ever
    constexpr int beatMilliseconds = 50;
    heartbeat.start(beatMilliseconds);
    while (!deadline.hasExpired()) {
        QApplication::processEvents(QEventLoop::WaitForMoreEvents);
        if (loop_ && loop_->isConverged()) {
            loop_->wait();
            showStatus();
            if (!compare_->isMeasuring()) {
                return true;
            }
        }
    }
    return false;
}

void MainWindow::note(const QString& sentence) {
    statusBar()->showMessage(sentence, noteMilliseconds);
}

void MainWindow::complain(const QString& sentence) {
    lastFault_ = sentence;
    statusBar()->showMessage(sentence, noteMilliseconds);
    if (!quiet_) {
        showPlainMessage(this, QMessageBox::Warning, sentence);
    }
}

const trace::Geometry& MainWindow::geometry() {
    if (!geometry_) {
        QApplication::setOverrideCursor(Qt::WaitCursor);
        geometry_ = std::make_shared<trace::Geometry>(drawn_);
        QApplication::restoreOverrideCursor();
    }
    return *geometry_;
}

void MainWindow::pick(QPointF place) {
    try {
        const std::optional<Inspection> found =
            inspect(geometry(), document_.edited(), picture_->camera(), sides_[0].effect, {place.x(), place.y()},
                    loop_->extent().width, loop_->extent().height);
        if (found && found->material) {
            document_.select(*found->material);
            material_->setScale(found->pixelsPerMillimeter);
        }
        inspect_->show(found);
        note(found ? QString::fromStdString(found->body + ": " + found->sentence)
                   : QString("There is no body at that place."));
    } catch (const std::exception& error) {
        complain(QString::fromUtf8(error.what()));
    }
}

std::unique_ptr<ReferenceTask> MainWindow::makeReference() const {
    return std::make_unique<ReferenceTask>(document_.current(), picture_->camera(), loop_->extent().width,
                                           loop_->extent().height);
}

} // namespace nacre::view
