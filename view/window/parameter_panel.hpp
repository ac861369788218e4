// A form of sliders that a table of parameters makes.
#pragma once

#include "view/model/edit_parameters.hpp"
#include "view/window/parameter_slider.hpp"

#include <QFormLayout>
#include <QLabel>

#include <functional>
#include <vector>

namespace nacre::view {

template <typename Target> class ParameterPanel : public QWidget {
public:
    /// Called with the parameter that was set, and its value.
    std::function<void(const Parameter<Target>&, double)> onChange;
    /// An edit has ended.
    std::function<void()> onFinish;

    explicit ParameterPanel(std::span<const Parameter<Target>> parameters, QWidget* parent = nullptr)
        : QWidget(parent), parameters_(parameters) {
        auto* form = new QFormLayout(this);
        form->setContentsMargins(0, 0, 0, 0);
        form->setVerticalSpacing(3);
        for (const Parameter<Target>& parameter : parameters) {
            auto* slider = new ParameterSlider(QString::fromUtf8(parameter.name),
                                               {parameter.low, parameter.high, parameter.logarithmic,
                                                parameter.decimals, QString::fromUtf8(parameter.unit)},
                                               QString::fromUtf8(parameter.toolTip));
            auto* label = new QLabel(QString::fromUtf8(parameter.label));
            label->setToolTip(QString::fromUtf8(parameter.toolTip));
            label->setBuddy(slider);
            form->addRow(label, slider);
            connect(slider, &ParameterSlider::changed, this, [this, &parameter](double value) {
                if (onChange) {
                    onChange(parameter, value);
                }
            });
            connect(slider, &ParameterSlider::finished, this, [this] {
                if (onFinish) {
                    onFinish();
                }
            });
            sliders_.push_back(slider);
        }
    }

    void show(const Target& target) {
        for (std::size_t i = 0; i < sliders_.size(); ++i) {
            sliders_[i]->showValue(parameters_[i].get(target));
        }
    }

private:
    std::span<const Parameter<Target>> parameters_;
    std::vector<ParameterSlider*> sliders_;
};

} // namespace nacre::view
