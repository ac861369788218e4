// Menus, panels and status bar of the window.
#include "image/image_file.hpp"
#include "view/window/look_panel.hpp"
#include "view/window/main_window.hpp"

#include <QApplication>
#include <QDockWidget>
#include <QFileDialog>
#include <QFileInfo>
#include <QKeyEvent>
#include <QMenuBar>
#include <QMessageBox>
#include <QScrollArea>
#include <QSettings>
#include <QStatusBar>
#include <QStyleFactory>

#include <array>

namespace nacre::view {
namespace {

constexpr int mostRecent = 8;
constexpr const char* openFilter =
    "Scenes and models (*.json *.gltf *.glb *.obj *.ply *.stl *.fbx *.dae *.3ds);;All files (*)";

QPalette darkPalette() {
    const QColor window(45, 45, 48);
    const QColor base(30, 30, 32);
    const QColor text(228, 228, 228);
    const QColor faint(140, 140, 140);
    QPalette palette(text, window);
    palette.setColor(QPalette::Base, base);
    palette.setColor(QPalette::AlternateBase, QColor(38, 38, 41));
    palette.setColor(QPalette::Text, text);
    palette.setColor(QPalette::Button, QColor(58, 58, 62));
    palette.setColor(QPalette::ButtonText, text);
    palette.setColor(QPalette::ToolTipBase, QColor(70, 70, 74));
    palette.setColor(QPalette::ToolTipText, text);
    palette.setColor(QPalette::PlaceholderText, faint);
    palette.setColor(QPalette::Highlight, QColor(61, 110, 180));
    palette.setColor(QPalette::HighlightedText, Qt::white);
    palette.setColor(QPalette::Link, QColor(120, 170, 240));
    for (const QPalette::ColorRole role : {QPalette::Text, QPalette::WindowText, QPalette::ButtonText}) {
        palette.setColor(QPalette::Disabled, role, faint);
    }
    return palette;
}

} // namespace

void MainWindow::makePanels() {
    look_ = new LookPanel(document_);
    connect(look_, &LookPanel::chosen, this, &MainWindow::applyView);
    addPanel("Picture", look_, Qt::RightDockWidgetArea);
}

QDockWidget* MainWindow::addPanel(const QString& title, QWidget* widget, Qt::DockWidgetArea area) {
    auto* dock = new QDockWidget(title, this);
    dock->setObjectName("dock." + title.toLower());
    auto* scroll = new QScrollArea;
    scroll->setWidgetResizable(true);
    scroll->setFrameShape(QFrame::NoFrame);
    scroll->setMinimumWidth(330);
    scroll->setWidget(widget);
    dock->setWidget(scroll);
    addDockWidget(area, dock);
    return dock;
}

void MainWindow::addActions(const QString& menu, std::span<const Action> actions) {
    QMenu* target = menuBar()->addMenu(menu);
    target->setObjectName("menu." + QString(menu).remove('&').toLower());
    for (const Action& row : actions) {
        QAction* action = target->addAction(QString::fromUtf8(row.text));
        action->setObjectName(row.name);
        action->setShortcut(row.shortcut);
        action->setShortcutContext(Qt::ApplicationShortcut);
        action->setStatusTip(QString::fromUtf8(row.toolTip));
        connect(action, &QAction::triggered, this, row.run);
    }
}

void MainWindow::makeMenus() {
    const std::array file{
        Action{"file.open", "&Open…", QKeySequence::Open, "Open a scene file or a model", &MainWindow::chooseFile},
        Action{"file.gallery", "&Gallery", QKeySequence("Ctrl+G"), "Open the built-in gallery",
               &MainWindow::openGallery},
        Action{"file.reload", "&Reload", QKeySequence("F5"), "Read the file again", &MainWindow::reload},
        Action{"file.savePicture", "Save &picture…", QKeySequence("Ctrl+P"), "Write the picture to a PNG or EXR file",
               &MainWindow::savePicture}};
    addActions("&File", file);
    auto* fileMenu = menuBar()->findChild<QMenu*>("menu.file");
    recent_ = new QMenu("Open r&ecent", fileMenu);
    fileMenu->insertMenu(fileMenu->actions().at(1), recent_);
    fillRecent();
    fileMenu->addSeparator();
    QAction* quit = fileMenu->addAction("&Quit", QKeySequence::Quit, this, &QWidget::close);
    quit->setObjectName("file.quit");

    QMenu* edit = menuBar()->addMenu("&Edit");
    QAction* undo = document_.history().createUndoAction(this, "&Undo");
    QAction* redo = document_.history().createRedoAction(this, "&Redo");
    undo->setObjectName("edit.undo");
    redo->setObjectName("edit.redo");
    undo->setShortcut(QKeySequence::Undo);
    redo->setShortcuts({QKeySequence("Ctrl+Shift+Z"), QKeySequence("Ctrl+Y")});
    edit->addActions({undo, redo});

    const std::array view{Action{"view.resetCamera", "&Reset camera", QKeySequence("Home"),
                                 "Back to where the scene is seen from first", &MainWindow::resetCamera}};
    addActions("&View", view);
    auto* viewMenu = menuBar()->findChild<QMenu*>("menu.view");
    QAction* dark = viewMenu->addAction("&Dark");
    dark->setObjectName("view.dark");
    dark->setCheckable(true);
    dark->setChecked(QSettings().value("dark", true).toBool());
    connect(dark, &QAction::toggled, this, &MainWindow::setDark);
    viewMenu->addSeparator();
    int number = 1;
    for (QDockWidget* dock : findChildren<QDockWidget*>()) {
        QAction* toggle = dock->toggleViewAction();
        toggle->setShortcut(QKeySequence(QString("Ctrl+%1").arg(number++)));
        viewMenu->addAction(toggle);
    }

    const std::array help{Action{"help.shortcuts", "&Shortcuts", QKeySequence("?"), "What mouse and keys do",
                                 &MainWindow::showShortcuts}};
    addActions("&Help", help);
}

void MainWindow::makeStatusBar() {
    pictureStatus_ = new QLabel;
    pictureStatus_->setObjectName("status.picture");
    deviceStatus_ = new QLabel(QString::fromStdString(device_.description().name));
    deviceStatus_->setObjectName("status.device");
    statusBar()->addPermanentWidget(pictureStatus_);
    statusBar()->addPermanentWidget(deviceStatus_);
}

void MainWindow::fillRecent() {
    recent_->clear();
    const QStringList files = QSettings().value("recent").toStringList();
    for (const QString& file : files) {
        recent_->addAction(QString(file).replace('&', "&&"), this, [this, file] { openFile(file); });
    }
    recent_->setEnabled(!files.isEmpty());
}

void MainWindow::rememberRecent(const QString& file) {
    const QString whole = QFileInfo(file).absoluteFilePath();
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
        openFile(file);
    }
}

void MainWindow::openGallery() {
    openFile({});
}

void MainWindow::reload() {
    const scene::Camera camera = picture_->camera();
    if (openFile(QString::fromStdString(document_.file().string()))) {
        picture_->setCamera(camera);
        statusBar()->showMessage("Read again: " + document_.name(), 5000);
    }
}

void MainWindow::savePicture() {
    const QString file = QFileDialog::getSaveFileName(this, "Save the picture", "nacre.png", "Pictures (*.png *.exr)");
    if (file.isEmpty() || !loop_) {
        return;
    }
    try {
        const renderer::SidePicture picture = loop_->read(0);
        writeImage(file.toStdString(), file.endsWith(".exr") ? picture.light : picture.shown);
        statusBar()->showMessage("Saved " + file, 5000);
    } catch (const std::exception& error) {
        complain(QString::fromUtf8(error.what()));
    }
}

void MainWindow::resetCamera() {
    picture_->setCamera(drawn_.cameras.at(0));
}

void MainWindow::setDark(bool dark) {
    QSettings().setValue("dark", dark);
    QApplication::setStyle(QStyleFactory::create("Fusion"));
    QApplication::setPalette(dark ? darkPalette() : QStyleFactory::create("Fusion")->standardPalette());
}

void MainWindow::pick(QPointF) {}

void MainWindow::showShortcuts() {
    QMessageBox::information(this, "Shortcuts", "");
}

void MainWindow::keyPressEvent(QKeyEvent* event) {
    if (event->text() == "?") {
        showShortcuts();
        return;
    }
    QMainWindow::keyPressEvent(event);
}

} // namespace nacre::view
