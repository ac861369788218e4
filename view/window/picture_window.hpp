// The native window with the picture: draws whenever there is something to draw, and turns the mouse into a camera.
#pragma once

#include "view/loop/picture_loop.hpp"

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
    /// The picture's size for the window's.
    QSize pictureSize() const;

Q_SIGNALS:
    void cameraMoved();
    /// A body was clicked: a place in the picture, [0, 1], right and down.
    void clicked(QPointF place);
    void dividerMoved(float divider);
    void stepped();
    void failed(QString sentence);
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
    std::optional<QPointF> placeOf(const QPointF& position) const;
    void applyCamera();
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
    bool comparing_ = false;
    float divider_ = 0.5f;
    bool hasSurface_ = false;
};

} // namespace nacre::view
