// How the picture is looked at: exposure, tone curve, surroundings, and the image that is shown.
#pragma once

#include "view/loop/picture_loop.hpp"
#include "view/window/document.hpp"
#include "view/window/parameter_panel.hpp"

#include <QComboBox>

namespace nacre::view {

class LookPanel : public QWidget {
    Q_OBJECT

public:
    explicit LookPanel(Document& document, QWidget* parent = nullptr);

    renderer::ToneCurve toneCurve() const;
    renderer::ShownImage image() const;

Q_SIGNALS:
    /// Something that is no part of the scene was chosen.
    void chosen();

private:
    Document& document_;
    ParameterPanel<EditedScene>* parameters_;
    QComboBox* curve_;
    QComboBox* image_;
};

} // namespace nacre::view
