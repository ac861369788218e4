// The native window with the picture: draws whenever there is something to draw, and turns the mouse into a camera.
#pragma once

#include "view/loop/picture_loop.hpp"
#include "view/model/light_handles.hpp"

#include <QElapsedTimer>
#include <QTimer>
#include <QVulkanInstance>
#include <QWindow>

#include <set>

namespace nacre::view {

class PictureWindow : public QWindow {
    Q_OBJECT

public:
    /// `instance` is null where the platform has no Vulkan surfaces; pictures are then drawn and not shown.
    explicit PictureWindow(QVulkanInstance* instance);
    ~PictureWindow() override;

    /// Draws with this loop from now on; null: with none.
    void setLoop(PictureLoop* loop, const scene::Camera& camera, float sceneRadius);
    /// Draws again.
    void wake();
    /// Something is being dragged, here or in a panel: for a moment pictures may be coarse.
    void move();

    const scene::Camera& camera() const { return camera_; }
    void setCamera(const scene::Camera& camera);
    void setDivider(float divider) { divider_ = divider; }
    float divider() const { return divider_; }
    void setComparing(bool comparing) { comparing_ = comparing; }
    bool isComparing() const { return comparing_; }
    /// Lights that the mouse can take hold of.
    void setHandles(std::vector<LightHandle> handles) { handles_ = std::move(handles); }
    /// Whether a directional light that is dragged has no place under the mouse. Coming back, it is on the other side.
    void leftSphere(bool outside);
    /// The picture's size for the window's.
    QSize pictureSize() const;

Q_SIGNALS:
    void cameraMoved();
    /// A body was clicked: a place in the picture, [0, 1], right and down.
    void clicked(QPointF place);
    void dividerMoved(float divider);
    /// A light was taken hold of, dragged to a place of the picture or pushed away (factor > 1), and let go.
    void lightHeld(std::size_t light);
    void lightDragged(std::size_t light, QPointF place, bool aim, bool behind);
    void lightPushed(std::size_t light, float factor);
    void lightDropped();
    void stepped();
    void failed(QString sentence);
    /// The device is gone, and the loop with it.
    void lost(QString sentence);
    void dropped(QString file);
    void keyed(QKeyEvent* event);

protected:
    bool event(QEvent* event) override;
    void exposeEvent(QExposeEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void wheelEvent(QWheelEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void keyReleaseEvent(QKeyEvent* event) override;

private:
    void connectSurface();
    void tick();
    void flyOn();
    void resizePicture();
    /// Where in the picture, [0, 1] inside of it.
    QPointF placeOf(const QPointF& position) const;
    std::optional<LightHandle> handleAt(const QPointF& position) const;
    void dragLight(const QMouseEvent& event, const QPointF& step);
    void applyCamera();
    bool moveByKey(const QKeyEvent& event);
    template <typename Action> void guarded(const Action& action);

    QVulkanInstance* instance_;
    PictureLoop* loop_ = nullptr;
    scene::Camera camera_;
    float sceneRadius_ = 1;
    QTimer timer_;  ///< the next step
    QTimer still_;  ///< ends a movement
    QTimer resize_; ///< the window's size has stayed for a moment
    QElapsedTimer flown_;
    std::set<int> keys_; ///< of flying, that are down
    QPointF pressed_;
    QPointF last_;
    bool dragged_ = false;
    bool draggingDivider_ = false;
    std::vector<LightHandle> handles_;
    std::optional<LightHandle> held_; ///< what is being dragged
    bool heldOutside_ = false;        ///< the mouse has left the sphere of a directional light
    bool comparing_ = false;
    float divider_ = 0.5f;
    bool hasSurface_ = false;
};

} // namespace nacre::view
