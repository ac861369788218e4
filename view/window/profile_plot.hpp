// Curves of a material, a colour for each channel.
#pragma once

#include "nacre/material.hpp"

#include <QWidget>

#include <array>
#include <functional>
#include <vector>

namespace nacre::view {

enum class PlotKind {
    Profile,      ///< R(r) over the distance on the surface, logarithmic
    EdgeResponse, ///< how light falls off across a shadow's edge; dashed: by the technique bank at the scale in use
    Slab          ///< share of light that crosses a slab, over its thickness
};

class ProfilePlot : public QWidget {
    Q_OBJECT

public:
    explicit ProfilePlot(PlotKind kind, QWidget* parent = nullptr);

    /// `pixelsPerMillimeter` [> 0] is where the bank's mixture is looked at.
    void show(const Material& material, double pixelsPerMillimeter);
    QSize sizeHint() const override { return {300, 150}; }
    QSize minimumSizeHint() const override { return {200, 150}; }

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    using Curve = std::vector<double>; ///< values at equal steps from 0 to `reach_`
    void sample(Curve& curve, const std::function<double(double)>& function) const;

    PlotKind kind_;
    double reach_ = 1; ///< mm
    double low_ = 0;   ///< of the curves; powers of ten for the profile
    double high_ = 1;
    std::array<Curve, 3> curves_;
    std::array<Curve, 3> technique_; ///< of the edge response
};

} // namespace nacre::view
