#include "view/window/main_window.hpp"

#include "image/image_file.hpp"
#include "renderer/vulkan/open_device.hpp"
#include "view/window/look_panel.hpp"

#include <QApplication>
#include <QCloseEvent>
#include <QDeadlineTimer>
#include <QDockWidget>
#include <QMessageBox>
#include <QMimeData>
#include <QSettings>
#include <QStatusBar>

#include <cmath>

namespace nacre::view {
namespace {

constexpr std::uint32_t softwareShadowMapSize = 512;
constexpr std::uint32_t softwareSamples = 16;

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

MainWindow::MainWindow(const WindowSettings& settings) : settings_(settings), device_(windowDevice(settings.device)) {
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
    connect(&document_, &Document::changedOnDisk, this, &MainWindow::reload);
    connect(picture_, &PictureWindow::stepped, this, &MainWindow::showStatus);
    connect(picture_, &PictureWindow::failed, this, &MainWindow::complain);
    connect(picture_, &PictureWindow::clicked, this, &MainWindow::pick);
    connect(picture_, &PictureWindow::dropped, this, &MainWindow::openDropped);
    connect(picture_, &PictureWindow::keyed, this, [this](QKeyEvent* event) { keyPressEvent(event); });
}

MainWindow::~MainWindow() {
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

void MainWindow::openPath(const std::filesystem::path& file, const std::optional<Material>& material) {
    statusBar()->showMessage("Opening " + (file.empty() ? QString("the gallery") : QString::fromStdString(file)) +
                             " …");
    QApplication::setOverrideCursor(Qt::WaitCursor);
    QApplication::processEvents(QEventLoop::ExcludeUserInputEvents);
    opening_ = true;
    try {
        document_.open(file, material);
    } catch (...) {
        opening_ = false;
        QApplication::restoreOverrideCursor();
        statusBar()->clearMessage();
        throw;
    }
    opening_ = false;
    QApplication::restoreOverrideCursor();
    statusBar()->clearMessage();
}

bool MainWindow::openFile(const QString& file) {
    try {
        openPath(file.toStdString(), document_.scene().meshes.empty() ? settings_.material : std::nullopt);
    } catch (const std::exception& error) {
        complain(QString::fromUtf8(error.what()));
        return false;
    }
    if (!file.isEmpty()) {
        rememberRecent(file);
    }
    for (const std::string& note : document_.scene().notes) {
        statusBar()->showMessage(QString::fromStdString(note), 10000);
    }
    return true;
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
    loop_ = std::make_unique<PictureLoop>(device_, drawn_, settings);
}

void MainWindow::sceneOpened() {
    picture_->setLoop(nullptr, picture_->camera(), 1);
    loop_.reset();
    drawn_ = document_.scene();
    makeLoop();
    applyView();
    picture_->setLoop(loop_.get(), drawn_.cameras.at(0), scene::bounds(drawn_).radius());
    setWindowTitle("Nacre – " + document_.name());
}

/// Hands everything that was edited to the loop; what is as it was costs next to nothing.
void MainWindow::applyScene() {
    if (!loop_) {
        return;
    }
    try {
        const EditedScene& edited = document_.edited();
        loop_->setMaterials(drawnMaterials(edited));
        loop_->setSurfaces(edited.surfaces);
        loop_->setLights(edited.lights);
        loop_->setEnvironment(edited.environmentIntensity, edited.environmentRotation);
        applyView();
        if (!opening_) {
            picture_->move();
        }
    } catch (const std::exception& error) {
        complain(QString::fromUtf8(error.what()));
    }
}

/// What is shown of the frames.
void MainWindow::applyView() {
    SideSettings side;
    side.look.image = look_->image();
    side.look.curve = look_->toneCurve();
    side.look.exposure = document_.scene().exposure * std::exp2(document_.edited().exposureStops);
    const glm::vec3 center = scene::bounds(drawn_).center();
    const float distance = glm::distance(picture_->camera().position, center);
    const float radius = scene::bounds(drawn_).radius();
    side.look.depthRange = {std::max(0.0f, distance - radius), distance + radius};
    loop_->setSide(0, side);
    picture_->wake();
}

void MainWindow::showStatus() {
    if (!loop_) {
        return;
    }
    const renderer::FrameReport& report = loop_->report();
    const vk::Extent2D size = loop_->isCoarse() ? loop_->coarseExtent() : loop_->extent();
    QString text = QString("%1 × %2 px").arg(size.width).arg(size.height);
    text += loop_->isCoarse()      ? ", coarse while it moves"
            : loop_->isConverged() ? QString(", %1 samples, finished").arg(loop_->samples(0))
                                   : QString(", sample %1 of %2").arg(loop_->samples(0)).arg(
                                         loop_->settings().stillSamples);
    if (report.totalMicroseconds > 0) {
        text += QString("   frame %1 ms, effect %2 ms")
                    .arg(report.totalMicroseconds / 1e3, 0, 'f', report.totalMicroseconds < 1e4 ? 2 : 0)
                    .arg(report.effectMicroseconds / 1e3, 0, 'f', report.effectMicroseconds < 1e4 ? 2 : 0);
    }
    pictureStatus_->setText(text);
}

bool MainWindow::drawUntilStill(int milliseconds) {
    const QDeadlineTimer deadline(milliseconds);
    if (loop_) {
        loop_->setMoving(false);
    }
    picture_->wake();
    while (!deadline.hasExpired()) {
        QApplication::processEvents(QEventLoop::WaitForMoreEvents | QEventLoop::AllEvents, 20);
        if (loop_ && loop_->isConverged()) {
            loop_->wait();
            showStatus();
            return true;
        }
    }
    return false;
}

void MainWindow::complain(const QString& sentence) {
    lastFault_ = sentence;
    statusBar()->showMessage(sentence);
    if (!quiet_) {
        QMessageBox::warning(this, "Nacre", sentence);
    }
}

void MainWindow::openDropped(const QString& file) {
    openFile(file);
}

void MainWindow::closeEvent(QCloseEvent* event) {
    if (!quiet_) {
        QSettings().setValue("geometry", saveGeometry());
    }
    event->accept();
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
    if (event->mimeData()->hasUrls()) {
        event->acceptProposedAction();
    }
}

void MainWindow::dropEvent(QDropEvent* event) {
    if (event->mimeData()->hasUrls()) {
        event->acceptProposedAction();
        openDropped(event->mimeData()->urls().first().toLocalFile());
    }
}

} // namespace nacre::view
