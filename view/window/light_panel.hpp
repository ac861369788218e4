// The lights: which there are, where they shine from, how bright.
#pragma once

#include "view/window/document.hpp"
#include "view/window/parameter_panel.hpp"

#include <QCheckBox>
#include <QComboBox>
#include <QPushButton>

#include <functional>

namespace nacre::view {

class LightPanel : public QWidget {
    Q_OBJECT

public:
    /// `camera` says from where the scene is seen.
    LightPanel(Document& document, std::function<scene::Camera()> camera, QWidget* parent = nullptr);

private:
    void refresh();
    void add(scene::LightKind kind);
    void remove();
    void chooseSide(bool front);
    void chooseAll();
    void chooseColor();
    void change(const QString& text, const QString& key, const std::function<void(scene::Light&)>& change);

    Document& document_;
    std::function<scene::Camera()> camera_;
    QComboBox* lights_;
    QComboBox* kind_;
    QPushButton* color_;
    QCheckBox* shadow_;
    ParameterPanel<scene::Light>* parameters_;
};

} // namespace nacre::view
