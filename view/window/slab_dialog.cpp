#include "view/window/slab_dialog.hpp"

#include "view/window/push_button.hpp"
#include "view/window/recipe_dialog.hpp"

#include <QHBoxLayout>
#include <QPushButton>
#include <QSignalBlocker>

#include <algorithm>

namespace nacre::view {
namespace {

constexpr std::size_t mostSlabs = 32;
constexpr int listHeight = 96; // px: four slabs

QString textOf(const Slab& slab) {
    const QString thickness = slab.thickness >= 1000 ? QString("without an end") : QString("%1 mm").arg(slab.thickness);
    if (slab.skin) {
        return QString("%1, skin: melanin %2, blood %3")
            .arg(thickness)
            .arg(slab.skin->melanin, 0, 'g', 3)
            .arg(slab.skin->haemoglobin, 0, 'g', 3);
    }
    const Rgb& scattering = slab.medium.reducedScattering;
    return QString("%1, scattering %2 %3 %4 per mm")
        .arg(thickness)
        .arg(scattering[0], 0, 'g', 3)
        .arg(scattering[1], 0, 'g', 3)
        .arg(scattering[2], 0, 'g', 3);
}

} // namespace

SlabDialog::SlabDialog(std::vector<Slab> slabs, std::function<void(const std::vector<Slab>&)> make, QWidget* parent)
    : QDialog(parent),
      slabs_(std::move(slabs)),
      make_(std::move(make)),
      list_(new QListWidget),
      parameters_(new ParameterPanel<Slab>(slabParameters())) {
    setAttribute(Qt::WA_DeleteOnClose);
    setWindowTitle("Slabs, from the top to the bottom");
    setMinimumWidth(440);
    list_->setObjectName("slabs");
    list_->setAccessibleName("Slabs");
    list_->setFixedHeight(listHeight);
    later_.setSingleShot(true);
    auto* layout = new QVBoxLayout(this);
    layout->addWidget(list_);
    auto* row = new QHBoxLayout;
    addButton(*row, this, "slabs.add", "&Add", "Add a copy of this slab below it", [this] {
        change([i = slab()](std::vector<Slab>& all) {
            if (all.size() < mostSlabs) {
                all.insert(all.begin() + static_cast<std::ptrdiff_t>(i), Slab(all[i]));
            }
        });
    });
    addButton(*row, this, "slabs.remove", "&Remove", "Remove this slab", [this] {
        change([i = slab()](std::vector<Slab>& all) {
            if (all.size() > 1) {
                all.erase(all.begin() + static_cast<std::ptrdiff_t>(i));
            }
        });
    });
    addButton(*row, this, "slabs.up", "&Up", "Move this slab up", [this] { move(-1); });
    addButton(*row, this, "slabs.down", "&Down", "Move this slab down", [this] { move(1); });
    layout->addLayout(row);
    layout->addWidget(parameters_);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    layout->addWidget(buttons);
    parameters_->onChange = [this](const Parameter<Slab>& parameter, double value) {
        change([&](std::vector<Slab>& all) { parameter.set(all[slab()], value); });
    };
    connect(list_, &QListWidget::currentRowChanged, this, [this](int) { parameters_->show(slabs_[slab()]); });
    connect(&later_, &QTimer::timeout, this, [this] { make_(slabs_); });
    refresh();
}

std::size_t SlabDialog::slab() const {
    return std::min(static_cast<std::size_t>(std::max(0, list_->currentRow())), slabs_.size() - 1);
}

void SlabDialog::refresh() {
    const QSignalBlocker quiet(list_);
    const auto row = static_cast<int>(slab());
    list_->clear();
    for (const Slab& each : slabs_) {
        list_->addItem(textOf(each));
    }
    list_->setCurrentRow(row);
    parameters_->show(slabs_[slab()]);
}

void SlabDialog::change(const std::function<void(std::vector<Slab>&)>& change) {
    change(slabs_);
    refresh();
    later_.start(recipeMilliseconds);
}

void SlabDialog::move(int by) {
    const auto from = static_cast<int>(slab());
    const int to = from + by;
    if (to >= 0 && to < list_->count()) {
        change([&](std::vector<Slab>& all) {
            std::swap(all[static_cast<std::size_t>(from)], all[static_cast<std::size_t>(to)]);
        });
        list_->setCurrentRow(to);
    }
}

} // namespace nacre::view
