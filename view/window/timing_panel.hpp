// What frames take on the device, pass by pass, over the last few hundred of them.
#pragma once

#include "renderer/frame_report.hpp"

#include <QElapsedTimer>
#include <QLabel>
#include <QWidget>

#include <array>
#include <deque>

namespace nacre::view {

class TimingGraph : public QWidget {
    Q_OBJECT

public:
    /// Passes are drawn as these parts of a frame.
    enum Part { ShadowMaps, Geometry, Lighting, Scatter, Transmit, Compose, PartCount };
    using Times = std::array<double, PartCount>; ///< ms

    explicit TimingGraph(QWidget* parent = nullptr);
    void add(const renderer::FrameReport& report);
    static const char* nameOf(Part part);
    const std::deque<Times>& history() const { return history_; }
    QSize sizeHint() const override { return {300, 190}; }

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    std::deque<Times> history_;
};

class TimingPanel : public QWidget {
    Q_OBJECT

public:
    explicit TimingPanel(QWidget* parent = nullptr);
    void add(const renderer::FrameReport& report, double processorMilliseconds);

private:
    TimingGraph* graph_;
    QLabel* text_;
    QLabel* tables_; ///< every pass of a frame, and what its memory is for
    QElapsedTimer tablesAge_;
};

} // namespace nacre::view
