#include "view/window/inspect_panel.hpp"

#include "view/window/plain_text.hpp"

#include <QVBoxLayout>

namespace nacre::view {

InspectPanel::InspectPanel(Document& document, QWidget* parent)
    : QWidget(parent),
      document_(document),
      text_(makePlainLabel("Click a body in the picture: this says what it is, and why light scatters or comes through "
                           "there, or why not.")),
      give_(new QPushButton("&Give it the material shown")),
      take_(new QPushButton("&Take its material away")) {
    text_->setObjectName("inspect.text");
    text_->setWordWrap(true);
    text_->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
    give_->setObjectName("inspect.give");
    give_->setToolTip("The clicked body's surface gets the material that the panel Material shows");
    take_->setObjectName("inspect.take");
    auto* layout = new QVBoxLayout(this);
    layout->addWidget(text_);
    layout->addWidget(give_);
    layout->addWidget(take_);
    layout->addStretch();
    give_->setEnabled(false);
    take_->setEnabled(false);
    connect(give_, &QPushButton::clicked, this,
            [this] { give(static_cast<std::uint32_t>(document_.material()), "give material"); });
    connect(take_, &QPushButton::clicked, this, [this] { give(scene::none, "take material away"); });
}

void InspectPanel::give(std::uint32_t material, const QString& text) {
    const std::uint32_t surface = inspection_->surface;
    document_.edit(text, {}, [&](EditedScene& scene) {
        scene.surfaces[surface].material = material;
        if (material != scene::none) {
            applyToSurfaces(scene, material);
        }
    });
}

void InspectPanel::show(const std::optional<Inspection>& inspection) {
    inspection_ = inspection;
    give_->setEnabled(inspection.has_value());
    take_->setEnabled(inspection && inspection->material);
    if (!inspection) {
        text_->setText("There is no body at that place.");
        return;
    }
    const EditedScene& edited = document_.edited();
    const QString material =
        inspection->material ? QString::fromStdString(edited.materials[*inspection->material].material.name) : "none";
    text_->setText(QString("Body: %1\nMaterial: %2\nScale: %3 px per mm\n%4")
                       .arg(QString::fromStdString(inspection->body), material)
                       .arg(inspection->pixelsPerMillimeter, 0, 'g', 3)
                       .arg(QString::fromStdString(inspection->sentence)));
}

} // namespace nacre::view
