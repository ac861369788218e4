#include "view/window/parameter_slider.hpp"

#include <QHBoxLayout>
#include <QSignalBlocker>

#include <algorithm>
#include <cmath>

namespace nacre::view {
namespace {

constexpr int sliderSteps = 1000;
constexpr int fieldWidth = 108; // px: seven digits and a unit

} // namespace

ParameterSlider::ParameterSlider(const QString& name, const SliderRange& range, const QString& toolTip, QWidget* parent)
    : QWidget(parent), range_(range), slider_(new QSlider(Qt::Horizontal, this)), field_(new QDoubleSpinBox(this)) {
    setObjectName(name);
    setToolTip(toolTip);
    setAccessibleName(name);
    slider_->setObjectName(name + ".slider");
    slider_->setRange(0, sliderSteps);
    slider_->setMinimumWidth(60);
    slider_->setAccessibleDescription(toolTip);
    field_->setObjectName(name + ".value");
    field_->setDecimals(range.decimals);
    field_->setRange(range.low, range.high);
    field_->setSingleStep(range.logarithmic ? std::pow(10.0, -range.decimals) * 10 : (range.high - range.low) / 100);
    field_->setSuffix(range.unit.isEmpty() ? QString() : " " + range.unit);
    field_->setFixedWidth(fieldWidth);
    field_->setKeyboardTracking(false);
    field_->setAccessibleDescription(toolTip);
    if (range.logarithmic) {
        field_->setStepType(QAbstractSpinBox::AdaptiveDecimalStepType);
    }
    auto* layout = new QHBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(slider_, 1);
    layout->addWidget(field_);
    setFocusProxy(slider_);

    connect(slider_, &QSlider::valueChanged, this, [this](int step) {
        const QSignalBlocker quiet(field_);
        field_->setValue(valueOf(step));
        Q_EMIT changed(field_->value());
    });
    connect(slider_, &QSlider::sliderReleased, this, &ParameterSlider::finished);
    connect(field_, &QDoubleSpinBox::valueChanged, this, [this](double value) {
        const QSignalBlocker quiet(slider_);
        slider_->setValue(sliderOf(value));
        Q_EMIT changed(value);
    });
    connect(field_, &QDoubleSpinBox::editingFinished, this, &ParameterSlider::finished);
}

void ParameterSlider::showValue(double value) {
    const QSignalBlocker quietSlider(slider_);
    const QSignalBlocker quietField(field_);
    // While it is dragged the slider stays under the mouse.
    if (!slider_->isSliderDown()) {
        slider_->setValue(sliderOf(value));
    }
    field_->setValue(value);
}

int ParameterSlider::sliderOf(double value) const {
    const double inside = std::clamp(value, range_.low, range_.high);
    const double share = range_.logarithmic ? std::log(inside / range_.low) / std::log(range_.high / range_.low)
                                            : (inside - range_.low) / (range_.high - range_.low);
    return static_cast<int>(std::lround(share * sliderSteps));
}

double ParameterSlider::valueOf(int slider) const {
    const double share = double(slider) / sliderSteps;
    return range_.logarithmic ? range_.low * std::pow(range_.high / range_.low, share)
                              : range_.low + share * (range_.high - range_.low);
}

} // namespace nacre::view
