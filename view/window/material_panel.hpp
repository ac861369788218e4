// A material: where it comes from, its layers, how the effect uses it, and what that means.
#pragma once

#include "view/window/document.hpp"
#include "view/window/layer_list.hpp"
#include "view/window/parameter_panel.hpp"
#include "view/window/profile_plot.hpp"

#include <QComboBox>
#include <QPushButton>

#include <array>

namespace nacre::view {

class MaterialPanel : public QWidget {
    Q_OBJECT

public:
    explicit MaterialPanel(Document& document, QWidget* parent = nullptr);

    /// Where the plots look at the bank's mixture; the radius is also told in pixels of this scale.
    void setScale(double pixelsPerMillimeter);
    /// Loads or saves the material that is shown; `failed` says what goes wrong. A file .h or .c gets C structs.
    void load(const QString& file);
    void save(const QString& file);
    void askAndSave();

    /// Whether a swatch of the material would be seen; and one.
    bool isSwatchSeen() const;
    void showSwatch(const Image& swatch);

Q_SIGNALS:
    void failed(QString sentence);
    /// This material was written to a file.
    void saved(QString file);

private:
    void makeSource();
    void makeColor();
    void refresh();
    void choosePreset(int row);
    void makeFrom(const QString& text, const std::function<Material()>& make, const QString& key = {});
    void chooseColor();
    void makeSkin();
    void makeMeanFreePath();
    void editSlabs();
    const Material& material() const;

    Document& document_;
    QComboBox* materials_;
    QComboBox* presets_;
    QLabel* source_;
    LayerList* layers_;
    ParameterPanel<Layer>* layer_;
    ParameterPanel<Material>* parameters_;
    QPushButton* color_;
    QComboBox* albedoUse_;
    QLabel* radius_;
    QLabel* swatch_;
    std::array<ProfilePlot*, 3> plots_;
    double pixelsPerMillimeter_ = 4;
};

} // namespace nacre::view
