// A number with a slider and a field.
#pragma once

#include <QDoubleSpinBox>
#include <QSlider>
#include <QWidget>

namespace nacre::view {

/// The range of a ParameterSlider, and how it is shown.
struct SliderRange {
    double low = 0;
    double high = 1;
    bool logarithmic = false;
    int decimals = 2;
    QString unit;
};

/// The field takes values beyond the slider's resolution; the slider follows. Its object name is its parameter's, that
/// of its field has ".value" behind it, that of its slider ".slider".
class ParameterSlider : public QWidget {
    Q_OBJECT

public:
    ParameterSlider(const QString& name, const SliderRange& range, const QString& toolTip, QWidget* parent = nullptr);

    double value() const { return field_->value(); }
    /// Without a signal.
    void showValue(double value);
    /// As a user would.
    void setValue(double value) { field_->setValue(value); }

Q_SIGNALS:
    void changed(double value);
    /// The slider was let go, or the field left: what follows is another edit.
    void finished();

private:
    int sliderOf(double value) const;
    double valueOf(int slider) const;

    SliderRange range_;
    QSlider* slider_;
    QDoubleSpinBox* field_;
};

} // namespace nacre::view
