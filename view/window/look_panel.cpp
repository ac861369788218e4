#include "view/window/look_panel.hpp"

#include "view/window/push_button.hpp"

#include <QFileDialog>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QPushButton>
#include <QVBoxLayout>

#include <array>

namespace nacre::view {
namespace {

using renderer::ShownImage;

struct ImageChoice {
    ShownImage image;
    const char* label;
    const char* toolTip;
    bool isOfOneLight = false;
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
    ImageChoice{ShownImage::Material, "Materials", "A colour for each; dark grey has none"},
    ImageChoice{ShownImage::Footprint, "Footprint",
                "Pixels that light travels: black 1/4, violet 2, red 16, yellow 64, white 256 and more"},
    ImageChoice{ShownImage::Regions, "Smooth and edge regions",
                "Technique bank combines blue parts by its smooth pipeline, orange ones by its edge pipeline"},
    ImageChoice{ShownImage::ShadowMap, "Shadow map", "Of the light that the panel Light shows: white is near it", true},
    ImageChoice{ShownImage::Irradiance, "Where light enters",
                "Irradiance by the light that the panel Light shows, and by nothing else", true},
    ImageChoice{ShownImage::Thickness, "Thickness, one light",
                "What the light of the panel Light comes through, mm: white is 10 mm and more", true},
    ImageChoice{ShownImage::Transmitted, "Transmitted, one light", "What comes through of the light of the panel Light",
                true}};

} // namespace

LookPanel::LookPanel(Document& document, QWidget* parent)
    : QWidget(parent),
      document_(document),
      parameters_(new ParameterPanel<EditedScene>(sceneParameters())),
      environment_(new QLabel),
      curve_(new QComboBox),
      backdrop_(new QComboBox),
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
    backdrop_->setObjectName("look.backdrop");
    backdrop_->addItems({"Surroundings", "Black", "Grey", "White"});
    backdrop_->setToolTip("What is seen where there is no body; it lights nothing");
    environment_->setObjectName("environment");
    environment_->setWordWrap(true);
    auto* layout = new QVBoxLayout(this);
    layout->addWidget(parameters_);
    auto* surroundings = new QHBoxLayout;
    addButton(*surroundings, this, "environment.open", "&Open surroundings …",
              "Light the scene by a picture of its surroundings, .hdr or .exr", [this] { chooseEnvironment(); });
    addButton(*surroundings, this, "environment.sky", "S&ky", "Light the scene by the built-in sky",
              [this] { setEnvironment({}); });
    layout->addWidget(environment_);
    layout->addLayout(surroundings);
    auto* form = new QFormLayout;
    form->addRow("&Tone curve", curve_);
    form->addRow("&Backdrop", backdrop_);
    form->addRow("S&how", image_);
    layout->addLayout(form);
    layout->addStretch();

    parameters_->onChange = [this](const Parameter<EditedScene>& parameter, double value) {
        document_.edit(parameter.label, parameter.name, [&](EditedScene& scene) { parameter.set(scene, value); });
    };
    parameters_->onFinish = [this] { document_.endEdit(); };
    connect(&document_, &Document::changed, this, &LookPanel::refresh);
    connect(backdrop_, &QComboBox::currentIndexChanged, this, &LookPanel::chosen);
    connect(curve_, &QComboBox::currentIndexChanged, this, &LookPanel::chosen);
    connect(image_, &QComboBox::currentIndexChanged, this, &LookPanel::chosen);
}

renderer::ToneCurve LookPanel::toneCurve() const {
    return curve_->currentIndex() == 0 ? renderer::ToneCurve::Neutral : renderer::ToneCurve::None;
}

renderer::Backdrop LookPanel::backdrop() const {
    return static_cast<renderer::Backdrop>(backdrop_->currentIndex());
}

bool LookPanel::isOfOneLight() const {
    return imageChoices[static_cast<std::size_t>(image_->currentIndex())].isOfOneLight;
}

void LookPanel::refresh() {
    const EditedScene& edited = document_.edited();
    parameters_->show(edited);
    environment_->setText("Surroundings: " + (edited.environmentImage
                                                  ? QFileInfo(QString::fromStdString(edited.environmentFile)).fileName()
                                                  : QString("the built-in sky")));
}

void LookPanel::chooseEnvironment() {
    const QString file =
        QFileDialog::getOpenFileName(this, "Open surroundings", {}, "Equirectangular pictures (*.hdr *.exr)");
    if (!file.isEmpty()) {
        setEnvironment(file);
    }
}

void LookPanel::setEnvironment(const QString& file) {
    try {
        EditedScene changed = document_.edited();
        view::setEnvironment(changed, file.toStdString());
        document_.edit(file.isEmpty() ? "sky" : "surroundings", {}, [&](EditedScene& scene) {
            scene.environmentFile = changed.environmentFile;
            scene.environmentImage = changed.environmentImage;
        });
    } catch (const std::exception& error) {
        Q_EMIT failed(QString::fromUtf8(error.what()));
    }
}

renderer::ShownImage LookPanel::image() const {
    return imageChoices[static_cast<std::size_t>(image_->currentIndex())].image;
}

} // namespace nacre::view
