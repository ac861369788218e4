// What the window opens, saves and keeps.
#include "image/image_file.hpp"
#include "nacre/files.hpp"
#include "scene/gallery/gallery.hpp"
#include "scene/import.hpp"
#include "view/model/edited_file.hpp"
#include "view/model/material_structs.hpp"
#include "view/window/compare_panel.hpp"
#include "view/window/look_panel.hpp"
#include "view/window/main_window.hpp"
#include "view/window/material_panel.hpp"
#include "view/window/plain_text.hpp"
#include "view/window/recovery.hpp"

#include <QApplication>
#include <QClipboard>
#include <QCloseEvent>
#include <QFileDialog>
#include <QFileInfo>
#include <QMenu>
#include <QMimeData>
#include <QSettings>
#include <QStatusBar>

#include <cmath>

namespace nacre::view {
namespace {

constexpr int mostRecent = 8;
constexpr int reloadMilliseconds = 300; // after a change, until its writer has finished
constexpr const char* openFilter = "Scenes and models (*.json *.gltf *.glb *.obj *.ply *.stl *.fbx *.dae "
                                   "*.3ds);;Surroundings (*.hdr *.exr);;All files "
                                   "(*)";

/// A path as the window shows it: what is not UTF-8 in it is replaced.
QString shown(const std::filesystem::path& file) {
    return QString::fromStdString(file.string());
}

/// The same from every folder; empty: the gallery.
std::filesystem::path wholePath(const std::filesystem::path& file) {
    return file.empty() ? file : std::filesystem::absolute(file);
}

/// Whether the file is a material's, which `load` would take for a scene.
bool isMaterial(const QString& file) {
    try {
        static_cast<void>(loadMaterial(file.toStdString()));
    } catch (const std::exception&) {
        return false;
    }
    return true;
}

} // namespace

void MainWindow::openPath(const std::filesystem::path& file, const std::function<scene::Scene()>& load) {
    statusBar()->showMessage("Opening " + (file.empty() ? QString("the gallery") : shown(file)) + " …");
    QApplication::setOverrideCursor(Qt::WaitCursor);
    QApplication::processEvents(QEventLoop::ExcludeUserInputEvents);
    opening_ = true;
    const auto end = [this] {
        opening_ = false;
        QApplication::restoreOverrideCursor();
        statusBar()->clearMessage();
    };
    try {
        document_.openScene(load(), file);
    } catch (...) {
        end();
        throw;
    }
    end();
}

bool MainWindow::openLoaded(const std::filesystem::path& file, const std::function<scene::Scene()>& load) {
    if (!mayForget()) {
        return false;
    }
    try {
        openPath(file, load);
    } catch (const std::exception& error) {
        complain(QString::fromUtf8(error.what()));
        return false;
    }
    if (file.empty()) {
        note("Ctrl+O opens a model, or drop one here. Then choose a preset. ? lists all keys.");
    } else {
        rememberRecent(file);
    }
    if (!document_.scene().notes.empty()) {
        constexpr int shownMilliseconds = 10'000;
        statusBar()->showMessage(QString::fromStdString(document_.scene().notes.front()), shownMilliseconds);
    }
    return true;
}

bool MainWindow::openFile(const std::filesystem::path& file) {
    return openLoaded(file, [&] { return file.empty() ? scene::makeGallery() : scene::load(file); });
}

/// Materials and surroundings go into the scene that is open; everything else is opened.
void MainWindow::openAny(const QString& file) {
    if (file.endsWith(".hdr") || file.endsWith(".exr")) {
        look_->setEnvironment(file);
    } else if (file.endsWith(".json") && isMaterial(file)) {
        material_->load(file);
    } else {
        openFile(file.toStdString());
    }
}

/// A scene without edits follows its file. Edits are not thrown away without being asked.
void MainWindow::changedOnDisk() {
    if (document_.isSaved()) {
        QTimer::singleShot(reloadMilliseconds, this, &MainWindow::reload);
    } else {
        note(document_.name() + " has changed on disk; F5 reads it again and forgets what was edited");
    }
}

void MainWindow::saveRecovery() {
    try {
        if (document_.isSaved()) {
            recovery_->remove();
        } else {
            recovery_->save(wholePath(document_.file()), document_.edited());
        }
    } catch (const std::exception& error) {
        complain(QString::fromUtf8(error.what()));
    }
}

void MainWindow::offerRecovered() {
    const std::optional<Recovered> found = Recovery::find();
    if (!found) {
        return;
    }
    const QString scene = found->scene.empty() ? "the gallery" : shown(found->scene);
    const QString question = "The last session ended before its edits of " + scene + " were saved. Go on with them?";
    const bool wanted = quiet_ || showPlainMessage(this, QMessageBox::Question, question,
                                                   QMessageBox::Yes | QMessageBox::No) == QMessageBox::Yes;
    if (wanted && !recover(*found)) {
        return;
    }
    Recovery::forget();
}

bool MainWindow::recover(const Recovered& found) {
    if (found.scene != wholePath(document_.file()) && !openFile(found.scene)) {
        return false;
    }
    try {
        const EditedScene edited = parseEdited(found.edits.toStdString(), found.file.toStdString(), document_.edited());
        document_.edit("recover", {}, [&](EditedScene& scene) { scene = edited; });
    } catch (const std::exception& error) {
        complain(QString::fromUtf8(error.what()));
        return false;
    }
    return true;
}

/// Whether what was edited may go: it is in files, or the user says so.
bool MainWindow::mayForget() {
    if (quiet_ || !loop_ || document_.isSaved()) {
        return true;
    }
    const auto answer =
        showPlainMessage(this, QMessageBox::Question, document_.name() + " was edited. Save it as a scene file first?",
                         QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel, QMessageBox::Save);
    return answer == QMessageBox::Discard || (answer == QMessageBox::Save && askAndSaveScene());
}

void MainWindow::closeEvent(QCloseEvent* event) {
    if (loop_ && !mayForget()) {
        event->ignore();
        return;
    }
    if (!quiet_) {
        QSettings().setValue("geometry", saveGeometry());
    }
    compare_->stop();
    recoveryTimer_.stop();
    if (loop_) { // a lost device's edits stay for the next start
        recovery_->remove();
    }
    event->accept();
}

/// What is drawn no longer can be: edits are kept for the next start.
void MainWindow::deviceLost(const QString& sentence) {
    saveRecovery();
    compare_->stop();
    swatch_.reset();
    loop_.reset();
    complain("Nothing can be drawn any more: " + sentence +
             ". What you edited is kept; the next start of nacre view offers it.");
}

/// A window that cannot be drawn in says so once, until it can be again.
void MainWindow::pictureFailed(const QString& sentence) {
    if (sentence != pictureFault_) {
        pictureFault_ = sentence;
        saveRecovery();
        complain(sentence);
    }
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
    if (event->mimeData()->hasUrls()) {
        event->acceptProposedAction();
    }
}

void MainWindow::dropEvent(QDropEvent* event) {
    if (event->mimeData()->hasUrls()) {
        event->acceptProposedAction();
        openAny(event->mimeData()->urls().first().toLocalFile());
    }
}

void MainWindow::fillRecent() {
    recent_->clear();
    const QStringList files = QSettings().value("recent").toStringList();
    for (const QString& file : files) {
        recent_->addAction(QString(file).replace('&', "&&"), this, [this, file] { openFile(file.toStdString()); });
    }
    recent_->setEnabled(!files.isEmpty());
}

/// A name that is not UTF-8 cannot be kept in the settings.
void MainWindow::rememberRecent(const std::filesystem::path& file) {
    if (shown(file).toStdString() != file.string()) {
        return;
    }
    const QString whole = QFileInfo(shown(file)).absoluteFilePath();
    QSettings settings;
    QStringList files = settings.value("recent").toStringList();
    files.removeAll(whole);
    files.prepend(whole);
    settings.setValue("recent", QStringList(files.mid(0, mostRecent)));
    fillRecent();
}

void MainWindow::chooseFile() {
    const QString folder = QString::fromStdString(document_.file().parent_path().string());
    const QString file = QFileDialog::getOpenFileName(this, "Open a scene or a model", folder, openFilter);
    if (!file.isEmpty()) {
        openAny(file);
    }
}

void MainWindow::chooseEnvironment() {
    look_->chooseEnvironment();
}

void MainWindow::openGallery() {
    openFile({});
}

void MainWindow::saveScene() {
    askAndSaveScene();
}

bool MainWindow::askAndSaveScene() {
    std::filesystem::path proposed = document_.file().empty() ? "scene.json" : document_.file();
    proposed.replace_extension(".json");
    const QString file = QFileDialog::getSaveFileName(this, "Save the scene", QString::fromStdString(proposed.string()),
                                                      "Scene files (*.json)");
    return !file.isEmpty() && writeScene(file);
}

/// The camera is saved as the window would show it again.
bool MainWindow::writeScene(const QString& file) {
    try {
        scene::Camera camera = picture_->camera();
        camera.name = "view";
        camera.verticalFieldOfView = 2 * std::atan(std::tan(camera.verticalFieldOfView / 2) / widening());
        camera.orthographicHeight /= widening();
        document_.saveScene(file.toStdString(), camera);
        recovery_->remove();
        rememberRecent(file.toStdString());
        setWindowTitle("Nacre – " + document_.name());
        note("Saved " + file);
        return true;
    } catch (const std::exception& error) {
        complain(QString::fromUtf8(error.what()));
        return false;
    }
}

void MainWindow::reload() {
    const scene::Camera camera = picture_->camera();
    if (openFile(document_.file())) {
        picture_->setCamera(camera);
        note("Read again: " + document_.name());
    }
}

void MainWindow::savePicture() {
    const QString file = QFileDialog::getSaveFileName(this, "Save the picture", "nacre.png", "Pictures (*.png *.exr)");
    if (!file.isEmpty()) {
        writePicture(file);
    }
}

void MainWindow::writePicture(const QString& file) {
    if (!loop_) {
        complain("There is no picture to save");
        return;
    }
    try {
        const renderer::SidePicture picture = loop_->read(0);
        writeImage(file.toStdString(), file.endsWith(".exr") ? picture.light : picture.shown);
        note("Saved " + file);
    } catch (const std::exception& error) {
        complain(QString::fromUtf8(error.what()));
    }
}

void MainWindow::saveMaterial() {
    material_->askAndSave();
}

void MainWindow::copyStructs() {
    QApplication::clipboard()->setText(
        QString::fromStdString(structsOf(document_.edited().materials[document_.material()].drawn())));
    note("The material is on the clipboard as C");
}

} // namespace nacre::view
