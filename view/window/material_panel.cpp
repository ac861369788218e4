#include "view/window/material_panel.hpp"

#include "nacre/files.hpp"
#include "nacre/presets.hpp"
#include "view/model/material_structs.hpp"
#include "view/model/recipes.hpp"
#include "view/window/plain_text.hpp"
#include "view/window/push_button.hpp"
#include "view/window/recipe_dialog.hpp"
#include "view/window/shown_image.hpp"
#include "view/window/slab_dialog.hpp"

#include <QColorDialog>
#include <QFileDialog>
#include <QGroupBox>
#include <QSignalBlocker>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>

namespace nacre::view {
namespace {

constexpr const char* materialFilter = "Materials (*.json);;All files (*)";
constexpr const char* saveFilter = "Material file (*.json);;C structs of nacre.h (*.h)";
constexpr const char* noPreset = "Choose a preset …";

QGroupBox* group(const QString& title, QLayout* layout) {
    auto* box = new QGroupBox(title);
    box->setLayout(layout);
    return box;
}

QColor toColor(const Rgb& linear) {
    const auto encoded = [](double value) { return static_cast<int>(std::lround(255 * std::pow(value, 1 / 2.2))); };
    return {encoded(linear[0]), encoded(linear[1]), encoded(linear[2])};
}

Rgb toLinear(const QColor& color) {
    return {std::pow(color.redF(), 2.2), std::pow(color.greenF(), 2.2), std::pow(color.blueF(), 2.2)};
}

} // namespace

MaterialPanel::MaterialPanel(Document& document, QWidget* parent)
    : QWidget(parent),
      document_(document),
      materials_(new QComboBox),
      presets_(new QComboBox),
      source_(makePlainLabel()),
      layers_(new LayerList(document)),
      layer_(new ParameterPanel<Layer>(layerParameters())),
      parameters_(new ParameterPanel<Material>(materialParameters())),
      color_(new QPushButton),
      albedoUse_(new QComboBox),
      radius_(new QLabel),
      swatch_(new QLabel),
      plots_{new ProfilePlot(PlotKind::Profile), new ProfilePlot(PlotKind::EdgeResponse),
             new ProfilePlot(PlotKind::Slab)} {
    auto* layout = new QVBoxLayout(this);
    makeSource();
    auto* source = new QFormLayout;
    source->addRow("&Material", materials_);
    source->addRow("&Preset", presets_);
    source->addRow(source_);
    auto* make = new QHBoxLayout;
    addButton(*make, this, "material.skin", "S&kin …", "Layers of skin by its melanin and blood",
              &MaterialPanel::makeSkin);
    addButton(*make, this, "material.meanFreePath", "Mean &free path …",
              "Layers of a medium by its colour and mean free path", &MaterialPanel::makeMeanFreePath);
    addButton(*make, this, "material.slabs", "Sla&bs …", "Layers of a stack of physical slabs",
              &MaterialPanel::editSlabs);
    source->addRow(make);
    make = new QHBoxLayout;
    addButton(*make, this, "material.load", "&Load …", "Read a material file", [this] {
        const QString file = QFileDialog::getOpenFileName(this, "Load a material", {}, materialFilter);
        if (!file.isEmpty()) {
            load(file);
        }
    });
    addButton(*make, this, "material.save", "&Save …", "Write this material to a file", [this] { askAndSave(); });
    source->addRow(make);
    layout->addLayout(source);
    swatch_->setObjectName("material.swatch");
    swatch_->setAccessibleName("Swatch");
    swatch_->setToolTip(
        "This material as large as it is, drawn by the same frame: the edge of a shadow, a wedge of 0.2 to "
        "12 mm lit from behind, a ball of 20 mm");
    swatch_->setFixedHeight(physicalDpiY()); // an inch, which a swatch nearly is
    layout->addWidget(swatch_);

    auto* layers = new QVBoxLayout;
    layers->addWidget(layers_);
    layers->addWidget(layer_);
    layout->addWidget(group("Layers", layers));
    auto* use = new QVBoxLayout;
    use->addWidget(parameters_);
    auto* form = new QFormLayout;
    form->addRow("Albe&do", color_);
    form->addRow("Albedo &use", albedoUse_);
    form->addRow("Radius", radius_);
    use->addLayout(form);
    layout->addWidget(group("Use", use));
    makeColor();
    for (ProfilePlot* plot : plots_) {
        layout->addWidget(plot);
    }
    layout->addStretch();

    layer_->onChange = [this](const Parameter<Layer>& parameter, double value) {
        const std::size_t index = layers_->layer();
        document_.edit(parameter.label, QString("%1 %2").arg(parameter.name).arg(index), [&](EditedScene& scene) {
            std::vector<Layer>& all = layersOf(scene.materials[document_.material()]);
            if (index < all.size()) {
                parameter.set(all[index], value);
            }
        });
    };
    parameters_->onChange = [this](const Parameter<Material>& parameter, double value) {
        document_.edit(parameter.label, parameter.name, [&](EditedScene& scene) {
            parameter.set(scene.materials[document_.material()].material, value);
            applyToSurfaces(scene, document_.material());
        });
    };
    layer_->onFinish = parameters_->onFinish = [this] { document_.endEdit(); };
    connect(layers_, &LayerList::selected, this, &MaterialPanel::refresh);
}

void MaterialPanel::makeSource() {
    materials_->setObjectName("material");
    materials_->setToolTip("The scene's materials; a click on a body chooses its own");
    presets_->setObjectName("material.preset");
    presets_->setToolTip("Put a preset in this material's place");
    presets_->addItem(noPreset);
    for (const Material& preset : presets()) {
        presets_->addItem(QString::fromStdString(preset.name));
        presets_->setItemData(presets_->count() - 1, QString::fromStdString(preset.description), Qt::ToolTipRole);
    }
    source_->setWordWrap(true);
    source_->setObjectName("material.source");
    connect(materials_, &QComboBox::activated, this, [this](int row) { document_.select(std::size_t(row)); });
    connect(presets_, &QComboBox::activated, this, &MaterialPanel::choosePreset);
}

void MaterialPanel::makeColor() {
    color_->setObjectName("material.albedo");
    color_->setToolTip("Diffuse albedo of surfaces that have no texture for it");
    connect(color_, &QPushButton::clicked, this, &MaterialPanel::chooseColor);
    albedoUse_->setObjectName("material.albedoUse");
    albedoUse_->addItems({"After scattering", "Root before and after"});
    albedoUse_->setToolTip("Where the albedo is applied: after scattering, or its square root before and after");
    connect(albedoUse_, &QComboBox::activated, this, [this](int row) {
        document_.edit("albedo use", {}, [&](EditedScene& scene) {
            scene.materials[document_.material()].material.albedoUse =
                row == 0 ? AlbedoUse::Post : AlbedoUse::PreAndPost;
        });
    });
    radius_->setObjectName("material.radius");
    radius_->setToolTip("Root mean square distance that light travels, red, green and blue");
}

const Material& MaterialPanel::material() const {
    return document_.edited().materials[document_.material()].material;
}

void MaterialPanel::setScale(double pixelsPerMillimeter) {
    pixelsPerMillimeter_ = pixelsPerMillimeter;
    refresh();
}

bool MaterialPanel::isSwatchSeen() const {
    return !swatch_->visibleRegion().isEmpty();
}

void MaterialPanel::showSwatch(const Image& swatch) {
    QPixmap pixmap = QPixmap::fromImage(toQImage(swatch));
    pixmap.setDevicePixelRatio(devicePixelRatioF());
    swatch_->setPixmap(pixmap);
}

void MaterialPanel::refresh() {
    if (document_.edited().materials.empty()) {
        return;
    }
    const Material& shown = material();
    const QSignalBlocker quiet(materials_);
    materials_->clear();
    for (const EditedMaterial& each : document_.edited().materials) {
        materials_->addItem(QString::fromStdString(each.material.name));
    }
    materials_->setCurrentIndex(static_cast<int>(document_.material()));
    const Material* preset = findPreset(shown.name);
    presets_->setCurrentIndex(preset != nullptr && *preset == shown ? static_cast<int>(preset - presets().data()) + 1
                                                                    : 0);
    source_->setText(QString::fromStdString(shown.description));
    EditedMaterial copy = document_.edited().materials[document_.material()];
    const std::vector<Layer>& layers = layersOf(copy);
    layer_->show(layers[std::min(layers_->layer(), layers.size() - 1)]);
    parameters_->show(shown);
    const QColor color = toColor(shown.albedo);
    color_->setStyleSheet(
        QString("background-color: %1; color: %2").arg(color.name(), color.lightnessF() > 0.5f ? "black" : "white"));
    color_->setText(color.name());
    albedoUse_->setCurrentIndex(shown.albedoUse == AlbedoUse::Post ? 0 : 1);
    const Material drawn = document_.edited().materials[document_.material()].drawn();
    const std::unique_ptr<Profile> profile = makeProfile(drawn);
    QStringList radii;
    for (int channel = 0; channel < 3; ++channel) {
        radii << QString::number(profile->rmsRadius(channel), 'g', 3);
    }
    const double widest = std::max({profile->rmsRadius(0), profile->rmsRadius(1), profile->rmsRadius(2)});
    radius_->setText(radii.join(" / ") + " mm; " + QString::number(widest * pixelsPerMillimeter_, 'g', 3) +
                     " px on the screen");
    for (ProfilePlot* plot : plots_) {
        plot->show(drawn, pixelsPerMillimeter_);
    }
}

void MaterialPanel::makeFrom(const QString& text, const std::function<Material()>& make, const QString& key) {
    try {
        const Material made = make();
        if (const std::string fault = findFault(made); !fault.empty()) {
            throw std::runtime_error(fault);
        }
        document_.edit(text, key, [&](EditedScene& scene) { replaceMaterial(scene, document_.material(), made); });
    } catch (const std::exception& error) {
        Q_EMIT failed(QString::fromUtf8(error.what()));
    }
}

void MaterialPanel::choosePreset(int row) {
    if (row > 0) {
        const Material& preset = presets()[static_cast<std::size_t>(row - 1)];
        makeFrom("preset " + QString::fromStdString(preset.name), [&] { return preset; });
    }
}

void MaterialPanel::load(const QString& file) {
    makeFrom("load material", [&] { return loadMaterial(file.toStdString()); });
}

void MaterialPanel::askAndSave() {
    const QString name = QString::fromStdString(material().name) + ".json";
    const QString file = QFileDialog::getSaveFileName(this, "Save the material", name, saveFilter);
    if (!file.isEmpty()) {
        save(file);
    }
}

void MaterialPanel::save(const QString& file) {
    try {
        const Material drawn = document_.edited().materials[document_.material()].drawn();
        if (file.endsWith(".h") || file.endsWith(".c")) {
            const std::string text = structsOf(drawn);
            writeFileAtomically(file.toStdString(), {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
        } else {
            saveMaterial(drawn, file.toStdString());
            document_.materialSaved();
        }
        Q_EMIT saved(file);
    } catch (const std::exception& error) {
        Q_EMIT failed(QString::fromUtf8(error.what()));
    }
}

void MaterialPanel::chooseColor() {
    const QColor color = QColorDialog::getColor(toColor(material().albedo), this, "Albedo");
    if (color.isValid()) {
        document_.edit("albedo", {}, [&](EditedScene& scene) {
            scene.materials[document_.material()].material.albedo = toLinear(color);
            applyToSurfaces(scene, document_.material());
        });
    }
}

void MaterialPanel::makeSkin() {
    openRecipe<SkinRecipe>(
        window(), "Skin by melanin and blood", skinParameters(), {},
        [this](const SkinRecipe& recipe) {
            makeFrom(
                "skin", [&] { return mixSkin(recipe); }, "recipe.skin");
        },
        [this] { document_.endEdit(); });
}

void MaterialPanel::makeMeanFreePath() {
    openRecipe<MediumRecipe>(
        window(), "Medium by mean free path, as OpenPBR has it", mediumParameters(), {},
        [this](const MediumRecipe& recipe) {
            makeFrom(
                "mean free path", [&] { return mixMedium(recipe); }, "recipe.medium");
        },
        [this] { document_.endEdit(); });
}

/// Slabs of a material that has none begin as those of skin, and replace its layers with the first change.
void MaterialPanel::editSlabs() {
    const std::vector<Slab> slabs = material().slabs.empty() ? skinSlabs({}) : material().slabs;
    auto* dialog = new SlabDialog(
        slabs,
        [this](const std::vector<Slab>& changed) {
            Material base = material();
            base.description = "Made of slabs: " + std::to_string(changed.size());
            makeFrom(
                "slabs", [&] { return mixSlabs(base, changed); }, "slabs");
        },
        window());
    dialog->show();
}

} // namespace nacre::view
