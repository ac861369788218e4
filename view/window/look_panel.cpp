#include "view/window/look_panel.hpp"

#include <QVBoxLayout>

#include <array>

namespace nacre::view {
namespace {

using renderer::ShownImage;

struct ImageChoice {
    ShownImage image;
    const char* label;
    const char* toolTip;
};

constexpr std::array imageChoices{
    ImageChoice{ShownImage::Picture, "Picture", "The finished picture"},
    ImageChoice{ShownImage::Diffuse, "Diffuse light", "The picture without specular reflections"},
    ImageChoice{ShownImage::Irradiance, "Irradiance", "Diffuse light that arrives, without the surface's colour"},
    ImageChoice{ShownImage::Scattered, "Scattered", "The same light after it has spread: scatter's output"},
    ImageChoice{ShownImage::Transmitted, "Transmitted", "Light that comes through from the far side"},
    ImageChoice{ShownImage::Specular, "Specular", "Light that is reflected at the surface"},
    ImageChoice{ShownImage::Albedo, "Albedo", "The surface's colour"},
    ImageChoice{ShownImage::Normal, "Normals", "Shading normals, world space"},
    ImageChoice{ShownImage::Depth, "Depth", "White is near, black is far"},
    ImageChoice{ShownImage::Thickness, "Thickness", "What light comes through, mm: white is 10 mm and more"},
    ImageChoice{ShownImage::Material, "Materials", "A colour for each; dark grey has none"}};

} // namespace

LookPanel::LookPanel(Document& document, QWidget* parent)
    : QWidget(parent),
      document_(document),
      parameters_(new ParameterPanel<EditedScene>(sceneParameters())),
      curve_(new QComboBox),
      image_(new QComboBox) {
    curve_->setObjectName("look.toneCurve");
    curve_->addItems({"Neutral", "None"});
    curve_->setToolTip("How light becomes a picture: Khronos PBR Neutral, or cut off at white");
    image_->setObjectName("look.image");
    for (const ImageChoice& choice : imageChoices) {
        image_->addItem(choice.label);
        image_->setItemData(image_->count() - 1, QString(choice.toolTip), Qt::ToolTipRole);
    }
    image_->setToolTip("Look inside the frame: the images that the picture is made of");
    auto* layout = new QVBoxLayout(this);
    layout->addWidget(parameters_);
    auto* form = new QFormLayout;
    form->addRow("Tone curve", curve_);
    form->addRow("Show", image_);
    layout->addLayout(form);
    layout->addStretch();

    parameters_->onChange = [this](const Parameter<EditedScene>& parameter, double value) {
        document_.edit(parameter.label, parameter.name, [&](EditedScene& scene) { parameter.set(scene, value); });
    };
    parameters_->onFinish = [this] { document_.endEdit(); };
    connect(&document_, &Document::changed, this, [this] { parameters_->show(document_.edited()); });
    connect(curve_, &QComboBox::currentIndexChanged, this, &LookPanel::chosen);
    connect(image_, &QComboBox::currentIndexChanged, this, &LookPanel::chosen);
}

renderer::ToneCurve LookPanel::toneCurve() const {
    return curve_->currentIndex() == 0 ? renderer::ToneCurve::Neutral : renderer::ToneCurve::None;
}

renderer::ShownImage LookPanel::image() const {
    return imageChoices[static_cast<std::size_t>(image_->currentIndex())].image;
}

} // namespace nacre::view
