#include "view/window/light_panel.hpp"

#include "scene/default_view.hpp"
#include "view/model/light_handles.hpp"
#include "view/window/push_button.hpp"

#include <QColorDialog>
#include <QHBoxLayout>
#include <QSignalBlocker>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>

namespace nacre::view {

LightPanel::LightPanel(Document& document, std::function<scene::Camera()> camera, QWidget* parent)
    : QWidget(parent),
      document_(document),
      camera_(std::move(camera)),
      lights_(new QComboBox),
      kind_(new QComboBox),
      color_(new QPushButton),
      shadow_(new QCheckBox("Casts a shado&w")),
      parameters_(new ParameterPanel<scene::Light>(lightParameters())) {
    lights_->setObjectName("light");
    kind_->setObjectName("light.kind");
    kind_->addItems({"Directional", "Spot", "Point"});
    color_->setObjectName("light.color");
    shadow_->setObjectName("light.castsShadow");
    shadow_->setToolTip("Only light with a shadow map can come through thin parts");
    auto* layout = new QVBoxLayout(this);
    const auto addRow =
        [&](std::initializer_list<std::tuple<const char*, const char*, const char*, std::function<void()>>> buttons) {
            auto* row = new QHBoxLayout;
            for (const auto& [name, text, toolTip, run] : buttons) {
                addButton(*row, this, name, text, toolTip, run);
            }
            layout->addLayout(row);
        };
    addRow({{"light.front", "Fr&ont", "Only the lights on the camera's side", [this] { chooseSide(true); }},
            {"light.back", "&Back", "Only the lights on the far side: what comes through thin parts",
             [this] { chooseSide(false); }},
            {"light.all", "A&ll", "All lights of the scene", [this] { chooseAll(); }}});
    auto* form = new QFormLayout;
    form->addRow("L&ight", lights_);
    form->addRow("&Kind", kind_);
    form->addRow("&Colour", color_);
    form->addRow("", shadow_);
    layout->addLayout(form);
    layout->addWidget(parameters_);
    addRow({{"light.addDirectional", "Add s&un", "Add a directional light, from above on the right",
             [this] { add(scene::LightKind::Directional); }},
            {"light.addSpot", "Add &spot", "Add a spot light that shines on what the camera looks at",
             [this] { add(scene::LightKind::Spot); }},
            {"light.addPoint", "Add &point", "Add a point light above what the camera looks at",
             [this] { add(scene::LightKind::Point); }},
            {"light.remove", "&Remove", "Remove this light", [this] { remove(); }}});
    auto* hint =
        new QLabel("Each light is a disc in the picture: drag it. A ring is behind what is seen. Drag a spot with "
                   "Shift to aim it, a spot or a point light with Ctrl to move it nearer or farther.");
    hint->setWordWrap(true);
    layout->addWidget(hint);
    layout->addStretch();

    parameters_->onChange = [this](const Parameter<scene::Light>& parameter, double value) {
        change(parameter.label, parameter.name, [&](scene::Light& light) { parameter.set(light, value); });
    };
    parameters_->onFinish = [this] { document_.endEdit(); };
    connect(lights_, &QComboBox::activated, this, [this](int row) { document_.selectLight(std::size_t(row)); });
    connect(kind_, &QComboBox::activated, this, [this](int row) {
        change("kind of light", {}, [row](scene::Light& light) { light.kind = static_cast<scene::LightKind>(row); });
    });
    connect(shadow_, &QCheckBox::clicked, this,
            [this](bool casts) { change("shadow", {}, [casts](scene::Light& light) { light.castsShadow = casts; }); });
    connect(color_, &QPushButton::clicked, this, &LightPanel::chooseColor);
    connect(&document_, &Document::changed, this, &LightPanel::refresh);
    connect(&document_, &Document::selectionChanged, this, &LightPanel::refresh);
}

void LightPanel::change(const QString& text, const QString& key, const std::function<void(scene::Light&)>& change) {
    const std::size_t index = document_.light();
    if (index < document_.edited().lights.size()) {
        document_.edit(text, key, [&](EditedScene& scene) { change(scene.lights[index]); });
    }
}

void LightPanel::refresh() {
    const QSignalBlocker quiet(lights_);
    const std::vector<scene::Light>& lights = document_.edited().lights;
    lights_->clear();
    for (const scene::Light& light : lights) {
        lights_->addItem(QString::fromStdString(light.name));
    }
    const bool isThere = document_.light() < lights.size();
    for (QWidget* widget : {static_cast<QWidget*>(kind_), static_cast<QWidget*>(color_), static_cast<QWidget*>(shadow_),
                            static_cast<QWidget*>(parameters_)}) {
        widget->setEnabled(isThere);
    }
    if (!isThere) {
        return;
    }
    const scene::Light& light = lights[document_.light()];
    lights_->setCurrentIndex(static_cast<int>(document_.light()));
    kind_->setCurrentIndex(static_cast<int>(light.kind));
    shadow_->setChecked(light.castsShadow);
    parameters_->show(light);
    const QColor color = QColor::fromRgbF(std::clamp(light.color.x, 0.0f, 1.0f), std::clamp(light.color.y, 0.0f, 1.0f),
                                          std::clamp(light.color.z, 0.0f, 1.0f));
    color_->setText(color.name());
    color_->setStyleSheet(
        QString("background-color: %1; color: %2").arg(color.name(), color.lightnessF() > 0.5f ? "black" : "white"));
}

void LightPanel::add(scene::LightKind kind) {
    scene::Light light = newLight(kind, camera_(), document_.scene().metersPerUnit);
    light.name = "light " + std::to_string(document_.edited().lights.size() + 1);
    document_.edit("add light", {}, [&](EditedScene& scene) { scene.lights.push_back(light); });
    document_.selectLight(document_.edited().lights.size() - 1);
}

void LightPanel::remove() {
    const std::size_t index = document_.light();
    if (index < document_.edited().lights.size()) {
        document_.edit("remove light", {}, [index](EditedScene& scene) {
            scene.lights.erase(scene.lights.begin() + static_cast<std::ptrdiff_t>(index));
        });
    }
}

void LightPanel::chooseSide(bool front) {
    const scene::Scene& scene = document_.scene();
    const scene::Camera camera = camera_();
    const glm::vec3 center = scene::bounds(scene).center();
    const auto isElsewhere = [&](const scene::Light& light) {
        return scene::isInFront(light, camera, center) != front;
    };
    std::vector<scene::Light> lights = scene.lights;
    std::erase_if(lights, isElsewhere);
    if (lights.empty()) {
        lights = scene::builtInLights(scene);
        std::erase_if(lights, isElsewhere);
    }
    document_.edit(front ? "front lights" : "back lights", {}, [&](EditedScene& edited) { edited.lights = lights; });
}

void LightPanel::chooseAll() {
    document_.edit("all lights", {}, [this](EditedScene& edited) { edited.lights = document_.scene().lights; });
}

void LightPanel::chooseColor() {
    const QColor color = QColorDialog::getColor(Qt::white, this, "Colour of the light");
    if (color.isValid()) {
        change("colour of light", {}, [&](scene::Light& light) {
            light.color = {std::pow(color.redF(), 2.2f), std::pow(color.greenF(), 2.2f), std::pow(color.blueF(), 2.2f)};
        });
    }
}

} // namespace nacre::view
