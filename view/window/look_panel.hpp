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
    renderer::Backdrop backdrop() const;
    renderer::ShownImage image() const;
    /// Whether the image is to be of the light alone that the panel Light shows.
    bool isOfOneLight() const;
    /// Asks for an environment; `failed` says what is wrong with it.
    void chooseEnvironment();
    void setEnvironment(const QString& file);

Q_SIGNALS:
    /// Something that is no part of the scene was chosen.
    void chosen();
    void failed(QString sentence);

private:
    void refresh();

    Document& document_;
    ParameterPanel<EditedScene>* parameters_;
    QLabel* environment_;
    QComboBox* curve_;
    QComboBox* backdrop_;
    QComboBox* image_;
};

} // namespace nacre::view
