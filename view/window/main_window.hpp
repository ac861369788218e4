// The viewer's window: the picture, panels beside it, menus and status bar.
#pragma once

#include "trace/geometry.hpp"
#include "view/loop/picture_loop.hpp"
#include "view/loop/reference_task.hpp"
#include "view/loop/swatch.hpp"
#include "view/window/document.hpp"
#include "view/window/picture_window.hpp"

#include <QElapsedTimer>
#include <QLabel>
#include <QMainWindow>
#include <QVulkanInstance>

#include <filesystem>
#include <memory>

namespace nacre::view {

class ComparePanel;
class InspectPanel;
class LightPanel;
class LookPanel;
class MaterialPanel;
class Recovery;
struct Recovered;
class TimingPanel;

class MainWindow : public QMainWindow {
    Q_OBJECT

public:
    explicit MainWindow(const renderer::DeviceSettings& device);
    ~MainWindow() override;

    Document& document() { return document_; }
    PictureLoop* loop() { return loop_.get(); }
    PictureWindow& picture() { return *picture_; }
    const renderer::Device& device() const { return device_; }

    /// Opens a file, or the gallery where the name is empty. What goes wrong is said in a dialogue; false then.
    bool openFile(const std::filesystem::path& file);
    /// The same of a scene that `load` loads from it.
    bool openLoaded(const std::filesystem::path& file, const std::function<scene::Scene()>& load);
    /// Draws until everything that is shown has all its samples.
    bool drawUntilStill(int milliseconds);
    /// Opens a scene or a model, or puts a material or surroundings into the scene that is open.
    void openAny(const QString& file);
    /// Writes the scene or the picture to a file; what goes wrong is said.
    bool writeScene(const QString& file);
    void writePicture(const QString& file);
    /// Draws the panel Material's swatch, if it is seen and not what it should be.
    void finishSwatch();
    /// Asks whether to go on with what a program that crashed has left.
    void offerRecovered();
    /// Edits of the last moments that are not in a file of the user's.
    void saveRecovery();
    /// Says a sentence that does not interrupt.
    void note(const QString& sentence);
    /// Says a sentence that the user has to see. Scripts and tests read it in `lastFault`.
    void complain(const QString& sentence);
    const QString& lastFault() const { return lastFault_; }
    MaterialPanel& materialPanel() { return *material_; }
    /// Faults are only noted, and nothing asks: for scripts.
    void setQuiet(bool quiet) { quiet_ = quiet; }
    /// Samples of a picture at rest, of scenes that are opened from now on; nothing: what suits the device.
    void setStillSamples(std::optional<std::uint32_t> samples) { stillSamples_ = samples; }

protected:
    void closeEvent(QCloseEvent* event) override;
    void dragEnterEvent(QDragEnterEvent* event) override;
    void dropEvent(QDropEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;

private:
    struct Action {
        const char* name;
        const char* text;
        QKeySequence shortcut;
        const char* toolTip;
        void (MainWindow::*run)();
    };

    struct Panel {
        QDockWidget* dock;
        QString menuText; ///< its name in the menu View, with a mnemonic
    };

    void makeMenus();
    void addActions(const QString& menu, std::span<const Action> actions);
    void makePanels();
    void addPanel(const QString& menuText, QWidget* widget);
    void showPanel(QDockWidget& dock);
    void makeStatusBar();
    void fillRecent();
    void rememberRecent(const std::filesystem::path& file);
    void restoreWindow();

    void sceneOpened();
    void applyScene();
    void changedOnDisk();
    void applyView();
    void showStatus();
    void pick(QPointF place);
    std::unique_ptr<ReferenceTask> makeReference() const;
    const trace::Geometry& geometry();
    scene::Camera firstCamera() const;
    bool recover(const Recovered& found);
    bool mayForget();
    bool askAndSaveScene();
    void deviceLost(const QString& sentence);
    void pictureFailed(const QString& sentence);
    void connectLights();
    void applyLights();
    void applyMarks();
    void showLights(bool shown);
    void changeLight(std::size_t index, const std::function<void(scene::Light&)>& change);
    bool isSwatchDue() const;
    void drawSwatch();
    float widening() const;
    void remakeLoop();
    void openPath(const std::filesystem::path& file, const std::function<scene::Scene()>& load);
    void makeLoop();

    void chooseFile();
    void chooseEnvironment();
    void openGallery();
    void saveScene();
    void reload();
    void savePicture();
    void resetCamera();
    void showShortcuts();
    void saveMaterial();
    void copyStructs();
    void cycleCompare();
    void reloadShaders();
    void setDark(bool dark);

    renderer::Device device_;
    QVulkanInstance instance_;
    Document document_;
    scene::Scene drawn_; ///< what the loop was made with
    std::unique_ptr<PictureLoop> loop_;
    PictureWindow* picture_;
    QWidget* pictureContainer_;
    std::shared_ptr<trace::Geometry> geometry_; ///< of `drawn_`; made when it is first asked for
    std::unique_ptr<Recovery> recovery_;
    QTimer recoveryTimer_;
    std::unique_ptr<Swatch> swatch_;
    std::optional<Material> swatchMaterial_; ///< that the swatch shows or is about to
    QTimer swatchTimer_;
    LookPanel* look_ = nullptr;
    MaterialPanel* material_ = nullptr;
    LightPanel* lights_ = nullptr;
    ComparePanel* compare_ = nullptr;
    InspectPanel* inspect_ = nullptr;
    TimingPanel* timing_ = nullptr;
    std::vector<Panel> panels_;
    QMenu* recent_ = nullptr;
    QLabel* pictureStatus_ = nullptr;
    std::array<SideSettings, renderer::Accumulation::sideCount> sides_; ///< as the loop has them
    QString lastFault_;
    QString pictureFault_; ///< what kept the last frame from being drawn
    std::optional<std::uint32_t> stillSamples_;
    bool quiet_ = false;
    bool lightsShown_ = false; ///< the panel Light is open
    bool opening_ = false;
    bool measured_ = false;
};

/// The Vulkan extensions that a window of the running platform needs; empty where there are none to be had.
std::vector<std::string> surfaceExtensions();

} // namespace nacre::view
