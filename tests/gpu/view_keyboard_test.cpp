// The window by the keyboard alone: Tab reaches whatever takes input, and menus have mnemonics.
#include "tests/gpu/support/renderer_scenes.hpp"
#include "tests/support/temporary_folder.hpp"
#include "view/window/main_window.hpp"
#include "view/window/parameter_slider.hpp"

#include "nacre/presets.hpp"

#include <QApplication>
#include <QCheckBox>
#include <QComboBox>
#include <QDockWidget>
#include <QListWidget>
#include <QMenuBar>
#include <QPushButton>
#include <QTest>

#include <set>

namespace nacre::tests {
namespace {

scene::Scene ballScene() {
    scene::Scene scene = darkScene(3);
    scene.metersPerUnit = 0.02;
    scene.materials = {presets().front()};
    add(scene, sphere(0.5f, 8)).material = 0;
    scene.lights = {directional({0.3f, -0.5f, -1}, 2)};
    return scene;
}

bool takesInput(const QWidget& widget) {
    const bool is = qobject_cast<const QPushButton*>(&widget) || qobject_cast<const QCheckBox*>(&widget) ||
                    qobject_cast<const QComboBox*>(&widget) || qobject_cast<const QSlider*>(&widget) ||
                    qobject_cast<const QAbstractSpinBox*>(&widget) || qobject_cast<const QListWidget*>(&widget);
    return is && widget.isVisible() && widget.isEnabled();
}

/// The window of a small scene, which all tests share.
class ViewKeyboard : public testing::Test {
protected:
    static void SetUpTestSuite() {
        folder_ = new TemporaryFolder;
        for (const char* name : {"XDG_CONFIG_HOME", "XDG_DATA_HOME", "XDG_RUNTIME_DIR"}) {
            qputenv(name, folder_->path.c_str());
        }
        static int argumentCount = 1;
        static char name[] = "nacre";
        static char* arguments[] = {name, nullptr};
        application_ = new QApplication(argumentCount, arguments);
        renderer::DeviceSettings device;
        device.validation = true;
        window_ = new view::MainWindow(device);
        window_->setQuiet(true);
        window_->setStillSamples(1);
        window_->resize(560, 420);
        window_->show();
        ASSERT_TRUE(QTest::qWaitForWindowActive(window_));
        ASSERT_TRUE(window_->openLoaded({}, ballScene)) << window_->lastFault().toStdString();
        ASSERT_TRUE(window_->drawUntilStill(120'000));
    }
    static void TearDownTestSuite() {
        EXPECT_EQ(window_->device().validationMessages(), std::vector<std::string>{});
        delete window_;
        delete application_;
        delete folder_;
    }

    static void press(Qt::Key key, Qt::KeyboardModifiers with = Qt::NoModifier) {
        ASSERT_NE(QGuiApplication::focusWindow(), nullptr);
        QTest::keyClick(QGuiApplication::focusWindow(), key, with);
        QApplication::processEvents();
    }
    /// The picture is a window of its own inside the window.
    static bool isAtPicture() { return QGuiApplication::focusWindow() == &window_->picture(); }
    /// Presses Tab until the picture has the keyboard.
    static void goToPicture() {
        constexpr int most = 200;
        for (int i = 0; i < most && !isAtPicture(); ++i) {
            press(Qt::Key_Tab);
        }
        ASSERT_TRUE(isAtPicture());
    }
    /// What gets the keyboard until the picture has it again.
    static std::set<const QWidget*> widgetsOnTheWayRound() {
        std::set<const QWidget*> reached;
        constexpr int most = 200;
        goToPicture();
        press(Qt::Key_Tab);
        for (int i = 0; i < most && !isAtPicture(); ++i) {
            if (const QWidget* widget = QApplication::focusWidget()) {
                reached.insert(widget);
            }
            press(Qt::Key_Tab);
        }
        return reached;
    }

    static inline TemporaryFolder* folder_ = nullptr;
    static inline QApplication* application_ = nullptr;
    static inline view::MainWindow* window_ = nullptr;
};

TEST_F(ViewKeyboard, TabReachesEverythingInEveryPanel) {
    int number = 0;
    for (const char* panel : {"material", "light", "compare", "picture", "inspect", "timing"}) {
        auto* dock = window_->findChild<QDockWidget*>("dock." + QString(panel));
        ASSERT_NE(dock, nullptr) << panel;
        press(static_cast<Qt::Key>(Qt::Key_1 + number++), Qt::ControlModifier);
        EXPECT_FALSE(dock->visibleRegion().isEmpty()) << panel;
        const std::set<const QWidget*> reached = widgetsOnTheWayRound();
        EXPECT_TRUE(isAtPicture()) << "from " << panel << " there is no way back";
        for (const QWidget* widget : reached) {
            EXPECT_TRUE(dock->isAncestorOf(widget) || !takesInput(*widget)) << panel << ": out of sight";
        }
        int there = 0;
        for (const QWidget* widget : dock->findChildren<QWidget*>()) {
            if (takesInput(*widget)) {
                ++there;
                EXPECT_TRUE(reached.contains(widget)) << panel << ": " << widget->objectName().toStdString();
                EXPECT_FALSE(widget->objectName().isEmpty()) << panel << " has a widget without a name";
            }
        }
        EXPECT_EQ(there == 0, QString(panel) == "timing" || QString(panel) == "inspect") << panel;
    }
}

TEST_F(ViewKeyboard, APanelsShortcutPutsTheKeyboardThere) {
    goToPicture();
    press(Qt::Key_3, Qt::ControlModifier);
    EXPECT_EQ(QApplication::focusWidget(), window_->findChild<QComboBox*>("compare.mode"));
}

TEST_F(ViewKeyboard, EveryEntryOfAMenuHasAMnemonicOfItsOwn) {
    std::vector<const QWidget*> menus{window_->menuBar()};
    for (const QMenu* menu : window_->menuBar()->findChildren<QMenu*>()) {
        if (menu->title() != "Open r&ecent") { // which has files
            menus.push_back(menu);
        }
    }
    EXPECT_GE(menus.size(), 5u);
    for (const QWidget* menu : menus) {
        std::set<QString> mnemonics;
        for (const QAction* action : menu->actions()) {
            if (!action->isSeparator()) {
                const QString mnemonic = QKeySequence::mnemonic(action->text()).toString();
                EXPECT_FALSE(mnemonic.isEmpty()) << action->text().toStdString();
                EXPECT_TRUE(mnemonics.insert(mnemonic).second) << action->text().toStdString();
            }
        }
    }
}

TEST_F(ViewKeyboard, ThePictureTurnsShiftsAndIsAsked) {
    goToPicture();
    const scene::Camera before = window_->picture().camera();
    press(Qt::Key_Right);
    EXPECT_GT(glm::distance(window_->picture().camera().position, before.position), 0.01f);
    EXPECT_EQ(window_->picture().camera().target, before.target);
    press(Qt::Key_Left);
    EXPECT_LT(glm::distance(window_->picture().camera().position, before.position), 1e-4f);
    press(Qt::Key_Down, Qt::ShiftModifier);
    EXPECT_GT(glm::distance(window_->picture().camera().target, before.target), 0.01f);
    press(Qt::Key_Up, Qt::ShiftModifier);
    press(Qt::Key_Space);
    EXPECT_TRUE(window_->findChild<QLabel*>("inspect.text")->text().contains("Body: "));
    press(Qt::Key_Backtab, Qt::ShiftModifier);
    EXPECT_FALSE(isAtPicture());
}

} // namespace
} // namespace nacre::tests
