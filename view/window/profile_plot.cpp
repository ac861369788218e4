#include "view/window/profile_plot.hpp"

#include "nacre/bank.hpp"

#include <QPainter>
#include <QPainterPath>

#include <algorithm>
#include <cmath>

namespace nacre::view {
namespace {

constexpr int steps = 160;
constexpr double reachShare = 0.99; ///< of the widest channel's light
constexpr double decades = 4;       ///< of the profile
constexpr std::array channelColors{QColor(224, 76, 70), QColor(66, 160, 84), QColor(76, 128, 232)};

/// Share of light that a kernel mixture leaves at `distance` px beyond a shadow's edge.
double edgeOf(const BankWeights& weights, int channel, double distance) {
    double result = 0;
    for (int kernel = 0; kernel < bankSize; ++kernel) {
        const std::span<const double> tail = bankEdgeTail(kernel);
        // Element k is the share that crosses k + ½ px; left of the edge it is what does not cross.
        const double at = std::max(0.0, std::abs(distance) - 0.5);
        const auto element = static_cast<std::size_t>(at);
        const double inside =
            element + 1 < tail.size() ? std::lerp(tail[element], tail[element + 1], at - double(element)) : 0.0;
        result += weights[static_cast<std::size_t>(kernel)][static_cast<std::size_t>(channel)] *
                  (distance >= 0 ? inside : 1 - inside);
    }
    return result;
}

QString titleOf(PlotKind kind) {
    switch (kind) {
    case PlotKind::Profile:
        return "Profile R(r), 1/mm², over r in mm";
    case PlotKind::EdgeResponse:
        return "Edge response over mm; dashed: bank";
    case PlotKind::Slab:
        break;
    }
    return "Slab transmittance over thickness in mm";
}

} // namespace

ProfilePlot::ProfilePlot(PlotKind kind, QWidget* parent) : QWidget(parent), kind_(kind) {
    setAccessibleName(titleOf(kind));
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

void ProfilePlot::sample(Curve& curve, const std::function<double(double)>& function) const {
    curve.resize(steps + 1);
    for (int i = 0; i <= steps; ++i) {
        curve[static_cast<std::size_t>(i)] = function(reach_ * i / steps);
    }
}

void ProfilePlot::show(const Material& material, double pixelsPerMillimeter) {
    const std::unique_ptr<Profile> profile = makeProfile(material);
    reach_ = std::max(profile->quantileRadius(reachShare), 1e-3);
    const BankWeights weights =
        kind_ == PlotKind::EdgeResponse ? projectOnBank(*profile, pixelsPerMillimeter) : BankWeights{};
    low_ = 0;
    high_ = 1;
    for (int channel = 0; channel < 3; ++channel) {
        Curve& curve = curves_[static_cast<std::size_t>(channel)];
        switch (kind_) {
        case PlotKind::Profile:
            sample(curve, [&](double r) { return profile->radial(channel, std::max(r, reach_ / steps)); });
            break;
        case PlotKind::EdgeResponse:
            sample(curve, [&](double x) { return 1 - profile->lineSpreadCumulative(channel, 2 * x - reach_); });
            sample(technique_[static_cast<std::size_t>(channel)],
                   [&](double x) { return edgeOf(weights, channel, (2 * x - reach_) * pixelsPerMillimeter); });
            break;
        case PlotKind::Slab:
            sample(curve, [&](double d) { return profile->slabTransmittance(channel, d); });
            break;
        }
    }
    if (kind_ == PlotKind::Profile) {
        double most = 1e-12;
        for (const Curve& curve : curves_) {
            most = std::max(most, *std::ranges::max_element(curve));
        }
        high_ = std::ceil(std::log10(most));
        low_ = high_ - decades;
    }
    update();
}

void ProfilePlot::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    QFont font = painter.font();
    font.setPointSizeF(font.pointSizeF() * 0.85);
    painter.setFont(font);
    const QFontMetrics metrics(font);
    const int left = metrics.horizontalAdvance("10⁻88") + 4;
    const QRectF area(left, metrics.height() + 4, width() - left - 8, height() - 2 * metrics.height() - 10);
    painter.setPen(palette().color(QPalette::WindowText));
    painter.drawText(QRectF(left, 0, width() - left, metrics.height()), Qt::AlignLeft, titleOf(kind_));
    painter.fillRect(area, palette().color(QPalette::Base));
    QColor grid = palette().color(QPalette::WindowText);
    grid.setAlphaF(0.2f);
    constexpr int lines = 4;
    for (int i = 0; i <= lines; ++i) {
        const double share = double(i) / lines;
        const double x = area.left() + share * area.width();
        const double y = area.bottom() - share * area.height();
        painter.setPen(grid);
        painter.drawLine(QPointF(x, area.top()), QPointF(x, area.bottom()));
        painter.drawLine(QPointF(area.left(), y), QPointF(area.right(), y));
        painter.setPen(palette().color(QPalette::WindowText));
        const double mm = kind_ == PlotKind::EdgeResponse ? reach_ * (2 * share - 1) : reach_ * share;
        const double value = std::lerp(low_, high_, share);
        painter.drawText(QRectF(x - 40, area.bottom() + 2, 80, metrics.height()),
                         i == lines ? Qt::AlignLeft | Qt::AlignHCenter : Qt::AlignHCenter, QString::number(mm, 'g', 2));
        painter.drawText(QRectF(0, y - metrics.height() / 2.0, left - 3, metrics.height()), Qt::AlignRight,
                         kind_ == PlotKind::Profile ? QString("1e%1").arg(value) : QString::number(value, 'g', 2));
    }
    const auto draw = [&](const Curve& curve, const QPen& pen) {
        QPainterPath path;
        for (std::size_t i = 0; i < curve.size(); ++i) {
            const double value = kind_ == PlotKind::Profile ? std::log10(std::max(curve[i], 1e-30)) : curve[i];
            const double share = std::clamp((value - low_) / (high_ - low_), -0.1, 1.1);
            const QPointF point(area.left() + area.width() * double(i) / steps, area.bottom() - share * area.height());
            i == 0 ? path.moveTo(point) : path.lineTo(point);
        }
        painter.setPen(pen);
        painter.drawPath(path);
    };
    painter.setClipRect(area);
    for (std::size_t channel = 0; channel < 3; ++channel) {
        draw(curves_[channel], QPen(channelColors[channel], 1.6));
        if (kind_ == PlotKind::EdgeResponse) {
            draw(technique_[channel], QPen(channelColors[channel].lighter(130), 1.2, Qt::DashLine));
        }
    }
}

} // namespace nacre::view
