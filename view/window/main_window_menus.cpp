// Menus, panels and status bar of the window.
#include "view/model/window_colors.hpp"
#include "view/window/compare_panel.hpp"
#include "view/window/inspect_panel.hpp"
#include "view/window/light_panel.hpp"
#include "view/window/look_panel.hpp"
#include "view/window/main_window.hpp"
#include "view/window/material_panel.hpp"
#include "view/window/timing_panel.hpp"

#include <QApplication>
#include <QDockWidget>
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

/// What the mouse and keys do in the picture.
struct MouseRow {
    const char* keys;
    const char* what;
};
constexpr std::array mouse{
    MouseRow{"drag", "go around what is looked at"},
    MouseRow{"Shift and drag, middle button", "shift the picture"},
    MouseRow{"wheel, Ctrl and drag", "closer, farther"},
    MouseRow{"right button", "look around"},
    MouseRow{"W A S D Q E", "fly"},
    MouseRow{"arrows, + and -", "go around, closer, farther; with Shift the arrows shift the picture"},
    MouseRow{"Tab, Shift and Tab", "to the next widget, to the one before; the picture is one"},
    MouseRow{"click, Space", "choose a body's material, and say what is there; Space: in the middle"},
    MouseRow{"drag a light", "turn or move it; with Shift aim a spot, with Ctrl nearer or farther"},
    MouseRow{"drop", "open a scene, a model, a material or surroundings"}};

QPalette paletteOf(const WindowColors& colors) {
    const auto shown = [](const ShownColor& color) { return QColor(color[0], color[1], color[2]); };
    QPalette palette(shown(colors.text), shown(colors.window));
    palette.setColor(QPalette::Base, shown(colors.base));
    palette.setColor(QPalette::AlternateBase, shown(colors.alternateBase));
    palette.setColor(QPalette::Button, shown(colors.button));
    palette.setColor(QPalette::ToolTipBase, shown(colors.toolTip));
    for (const QPalette::ColorRole role :
         {QPalette::Text, QPalette::WindowText, QPalette::ButtonText, QPalette::ToolTipText}) {
        palette.setColor(role, shown(colors.text));
        palette.setColor(QPalette::Disabled, role, shown(colors.faint));
    }
    palette.setColor(QPalette::PlaceholderText, shown(colors.faint));
    palette.setColor(QPalette::Highlight, shown(colors.highlight));
    palette.setColor(QPalette::HighlightedText, shown(colors.highlightedText));
    palette.setColor(QPalette::Link, shown(colors.link));
    return palette;
}

} // namespace

void MainWindow::makePanels() {
    material_ = new MaterialPanel(document_);
    lights_ = new LightPanel(document_, [this] { return picture_->camera(); });
    compare_ = new ComparePanel;
    look_ = new LookPanel(document_);
    inspect_ = new InspectPanel(document_);
    timing_ = new TimingPanel;
    connect(material_, &MaterialPanel::failed, this, &MainWindow::complain);
    connect(material_, &MaterialPanel::saved, this, [this](const QString& file) { note("Saved " + file); });
    connect(look_, &LookPanel::failed, this, &MainWindow::complain);
    connect(look_, &LookPanel::chosen, this, [this] {
        if (loop_) {
            applyLights();
            applyView();
        }
    });
    connect(compare_, &ComparePanel::chosen, this, &MainWindow::applyView);
    connect(compare_, &ComparePanel::failed, this, &MainWindow::complain);
    connect(compare_, &ComparePanel::given, this, [this](const Image& image) { loop_->setGiven(image); });
    compare_->makeReference = [this] { return makeReference(); };
    compare_->readSide = [this](std::uint32_t side) { return loop_->read(side); };

    addPanel("&Material", material_);
    addPanel("&Light", lights_);
    addPanel("Compar&e", compare_);
    addPanel("&Picture", look_);
    addPanel("&Inspect", inspect_);
    addPanel("&Timing", timing_);
    for (std::size_t i = 1; i < panels_.size(); ++i) {
        tabifyDockWidget(panels_[i - 1].dock, panels_[i].dock);
    }
    setTabPosition(Qt::RightDockWidgetArea, QTabWidget::North);
    connect(findChild<QDockWidget*>("dock.light"), &QDockWidget::visibilityChanged, this, &MainWindow::showLights);
    panels_.front().dock->raise();
    constexpr int width = 460; // px: that of its tabs; the rest is the picture's
    resizeDocks({panels_.front().dock}, {width}, Qt::Horizontal);
}

void MainWindow::addPanel(const QString& menuText, QWidget* widget) {
    const QString title = QString(menuText).remove('&');
    auto* dock = new QDockWidget(title, this);
    dock->setObjectName("dock." + title.toLower());
    auto* scroll = new QScrollArea;
    scroll->setWidgetResizable(true);
    scroll->setFrameShape(QFrame::NoFrame);
    scroll->setMinimumWidth(330);
    scroll->setWidget(widget);
    dock->setWidget(scroll);
    addDockWidget(Qt::RightDockWidgetArea, dock);
    // Qt moves a panel that is behind another out of the window, where Tab would still find it.
    connect(dock, &QDockWidget::visibilityChanged, widget, &QWidget::setVisible);
    panels_.push_back({dock, menuText});
}

/// In front of the others, with the keyboard at its first widget.
void MainWindow::showPanel(QDockWidget& dock) {
    dock.show();
    dock.raise();
    QWidget* content = static_cast<QScrollArea*>(dock.widget())->widget();
    for (QWidget* next = content->nextInFocusChain(); next != content; next = next->nextInFocusChain()) {
        if (content->isAncestorOf(next) && (next->focusPolicy() & Qt::TabFocus) != 0 && next->isVisible()) {
            activateWindow();
            next->setFocus(Qt::TabFocusReason);
            return;
        }
    }
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
        Action{"file.environment", "Open s&urroundings…", QKeySequence("Ctrl+E"),
               "Light the scene by an equirectangular .hdr or .exr file", &MainWindow::chooseEnvironment},
        Action{"file.reload", "&Reload", QKeySequence("F5"), "Read the file again", &MainWindow::reload},
        Action{"file.saveMaterial", "&Save material…", QKeySequence::Save,
               "Write the material that is shown to a file, as JSON or as C structs", &MainWindow::saveMaterial},
        Action{"file.saveScene", "S&ave scene…", QKeySequence("Ctrl+Shift+S"),
               "Write the scene as it is to a scene file, which nacre render takes", &MainWindow::saveScene},
        Action{"file.copyStructs", "&Copy material as C", QKeySequence("Ctrl+Shift+C"),
               "Copy the material as the structs of nacre.h, for an engine's source", &MainWindow::copyStructs},
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
                                 "Back to where the scene is seen from first", &MainWindow::resetCamera},
                          Action{"view.compare", "&Compare", QKeySequence("F2"),
                                 "A alone, A and B divided, their difference", &MainWindow::cycleCompare},
                          Action{"view.reloadShaders", "Reload s&haders", QKeySequence("F6"),
                                 "Compile changed shaders (in a developer build)", &MainWindow::reloadShaders}};
    addActions("&View", view);
    auto* viewMenu = menuBar()->findChild<QMenu*>("menu.view");
    QAction* dark = viewMenu->addAction("&Dark");
    dark->setObjectName("view.dark");
    dark->setCheckable(true);
    dark->setChecked(QSettings().value("dark", true).toBool());
    connect(dark, &QAction::toggled, this, &MainWindow::setDark);
    viewMenu->addSeparator();
    int number = 1;
    for (const Panel& panel : panels_) {
        QAction* show = viewMenu->addAction(panel.menuText, this, [this, dock = panel.dock] { showPanel(*dock); });
        show->setObjectName("panel." + panel.dock->windowTitle().toLower());
        show->setShortcut(QKeySequence(QString("Ctrl+%1").arg(number++)));
        show->setStatusTip("Bring the panel " + panel.dock->windowTitle() + " to the front");
    }

    const std::array help{Action{"help.shortcuts", "&Shortcuts", QKeySequence("?"), "What mouse and keys do",
                                 &MainWindow::showShortcuts}};
    addActions("&Help", help);
}

void MainWindow::makeStatusBar() {
    pictureStatus_ = new QLabel;
    pictureStatus_->setObjectName("status.picture");
    pictureStatus_->setToolTip("Drawn by " + QString::fromStdString(device_.description().name));
    // A sentence takes the whole bar for a while.
    statusBar()->addWidget(pictureStatus_, 1);
}

void MainWindow::resetCamera() {
    picture_->setCamera(firstCamera());
}

void MainWindow::cycleCompare() {
    compare_->cycle();
}

void MainWindow::reloadShaders() {
    try {
        loop_->reloadShaders();
        note("The shaders are as their files are now");
        picture_->wake();
    } catch (const std::exception& error) {
        complain(QString::fromUtf8(error.what()));
    }
}

void MainWindow::setDark(bool dark) {
    QSettings().setValue("dark", dark);
    QApplication::setStyle(QStyleFactory::create("Fusion"));
    QApplication::setPalette(paletteOf(dark ? darkColors : lightColors));
}

void MainWindow::showShortcuts() {
    QString rows;
    for (const auto& [keys, what] : mouse) {
        rows += QString("<tr><td><b>%1</b>&nbsp;&nbsp;</td><td>%2</td></tr>").arg(keys, what);
    }
    for (const QAction* action : findChildren<QAction*>()) {
        if (!action->shortcut().isEmpty()) {
            rows += QString("<tr><td><b>%1</b>&nbsp;&nbsp;</td><td>%2</td></tr>")
                        .arg(action->shortcut().toString().toHtmlEscaped(),
                             QString(action->text()).remove('&').toHtmlEscaped());
        }
    }
    QMessageBox::information(this, "Mouse and keys", "<table>" + rows + "</table>");
}

void MainWindow::keyPressEvent(QKeyEvent* event) {
    if (event->text() == "?") {
        showShortcuts();
        return;
    }
    // The picture has the keyboard to itself while it has the focus.
    if (event->key() == Qt::Key_Tab || event->key() == Qt::Key_Backtab) {
        activateWindow();
        focusNextPrevChild(event->key() == Qt::Key_Tab);
        return;
    }
    const QKeySequence pressed(event->keyCombination());
    for (QAction* action : findChildren<QAction*>()) {
        if (action->isEnabled() && action->shortcuts().contains(pressed)) {
            action->trigger();
            return;
        }
    }
    QMainWindow::keyPressEvent(event);
}

} // namespace nacre::view
