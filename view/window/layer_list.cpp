#include "view/window/layer_list.hpp"

#include "view/model/edit_parameters.hpp"
#include "view/window/push_button.hpp"

#include <QHBoxLayout>
#include <QPainter>
#include <QPushButton>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>

namespace nacre::view {
namespace {

constexpr int listHeight = 124; // px: six layers, as skin has
constexpr int swatch = 14;

/// The colour of a layer's light, as bright as it gets.
QPixmap colorOf(const Layer& layer) {
    const double most = std::max({layer.weight[0], layer.weight[1], layer.weight[2], 1e-9});
    const auto byte = [&](int channel) {
        return static_cast<int>(std::lround(255 * std::pow(layer.weight[channel] / most, 1 / 2.2)));
    };
    QPixmap pixmap(swatch, swatch);
    pixmap.fill(QColor(byte(0), byte(1), byte(2)));
    return pixmap;
}

QString textOf(const Layer& layer) {
    return QString("%1 mm   red %2  green %3  blue %4")
        .arg(radiusOf(layer.variance), 0, 'g', 3)
        .arg(layer.weight[0], 0, 'f', 2)
        .arg(layer.weight[1], 0, 'f', 2)
        .arg(layer.weight[2], 0, 'f', 2);
}

} // namespace

LayerList::LayerList(Document& document, QWidget* parent)
    : QWidget(parent), document_(document), list_(new QListWidget) {
    list_->setObjectName("layers");
    list_->setAccessibleName("Layers");
    list_->setFixedHeight(listHeight);
    list_->setDragDropMode(QAbstractItemView::InternalMove);
    list_->setToolTip(
        "Layers of the profile: root mean square radius and weights. A tick draws a layer; drag to reorder");
    auto* buttons = new QWidget;
    auto* row = new QHBoxLayout(buttons);
    row->setContentsMargins(0, 0, 0, 0);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(list_);
    layout->addWidget(buttons);
    const auto add = [&](const char* name, const char* text, const char* toolTip, auto run) {
        addButton(*row, this, name, text, toolTip, run)->setMinimumWidth(20);
    };
    add("layers.add", "&Add", "Add a layer twice as wide as the widest", [this] {
        change("add layer", [](EditedMaterial& material) { addLayer(material); });
        list_->setCurrentRow(list_->count() - 1); // what the sliders set now
    });
    add("layers.duplicate", "Dupli&cate", "Add a copy of this layer", [this] {
        change("duplicate layer", [i = layer()](EditedMaterial& material) { duplicateLayer(material, i); });
    });
    add("layers.remove", "&Remove", "Remove this layer",
        [this] { change("remove layer", [i = layer()](EditedMaterial& material) { removeLayer(material, i); }); });
    add("layers.up", "Up", "Move this layer up", [this] { move(-1); });
    add("layers.down", "Down", "Move this layer down", [this] { move(1); });

    connect(list_, &QListWidget::currentRowChanged, this, [this] {
        if (!refreshing_) {
            Q_EMIT selected();
        }
    });
    connect(list_, &QListWidget::itemChanged, this, [this](QListWidgetItem* item) {
        if (refreshing_) {
            return;
        }
        const auto index = static_cast<std::size_t>(list_->row(item));
        const bool isShown = item->checkState() == Qt::Checked;
        change(isShown ? "show layer" : "hide layer", [index, isShown](EditedMaterial& material) {
            layersOf(material);
            if (isShown) {
                material.hidden.erase(index);
            } else {
                material.hidden.insert(index);
            }
        });
    });
    connect(list_->model(), &QAbstractItemModel::rowsMoved, this,
            [this](const QModelIndex&, int from, int, const QModelIndex&, int to) {
                const int place = to > from ? to - 1 : to;
                change("reorder layers", [from, place](EditedMaterial& material) {
                    moveLayer(material, static_cast<std::size_t>(from), static_cast<std::size_t>(place));
                });
            });
    connect(&document_, &Document::changed, this, &LayerList::refresh);
    connect(&document_, &Document::selectionChanged, this, &LayerList::refresh);
}

std::size_t LayerList::layer() const {
    return static_cast<std::size_t>(std::max(0, list_->currentRow()));
}

void LayerList::change(const QString& text, const std::function<void(EditedMaterial&)>& change) {
    const std::size_t material = document_.material();
    document_.edit(text, {}, [&](EditedScene& scene) { change(scene.materials[material]); });
}

void LayerList::move(int by) {
    const auto from = static_cast<int>(layer());
    const int to = from + by;
    if (to < 0 || to >= list_->count()) {
        return;
    }
    change("reorder layers", [from, to](EditedMaterial& material) {
        moveLayer(material, static_cast<std::size_t>(from), static_cast<std::size_t>(to));
    });
    list_->setCurrentRow(to);
}

void LayerList::refresh() {
    if (document_.edited().materials.empty()) {
        return;
    }
    refreshing_ = true;
    EditedMaterial shown = document_.edited().materials[document_.material()]; // a copy: to show is not to change
    const std::vector<Layer>& layers = layersOf(shown);
    const int row = std::max(0, list_->currentRow());
    while (list_->count() > static_cast<int>(layers.size())) {
        delete list_->takeItem(list_->count() - 1);
    }
    while (list_->count() < static_cast<int>(layers.size())) {
        list_->addItem(new QListWidgetItem);
    }
    for (std::size_t i = 0; i < layers.size(); ++i) {
        QListWidgetItem* item = list_->item(static_cast<int>(i));
        item->setText(textOf(layers[i]));
        item->setIcon(colorOf(layers[i]));
        item->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsUserCheckable | Qt::ItemIsDragEnabled);
        item->setCheckState(shown.hidden.contains(i) ? Qt::Unchecked : Qt::Checked);
    }
    list_->setCurrentRow(std::min(row, list_->count() - 1));
    refreshing_ = false;
    Q_EMIT selected();
}

} // namespace nacre::view
