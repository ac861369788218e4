// A dialogue beside the window with the numbers of a recipe: what is set there is drawn at once.
#pragma once

#include "view/window/parameter_panel.hpp"

#include <QDialog>
#include <QDialogButtonBox>
#include <QTimer>
#include <QVBoxLayout>

#include <functional>
#include <memory>

namespace nacre::view {

/// [ms] after a change, until layers are made of it: that takes some tenths of a second.
inline constexpr int recipeMilliseconds = 120;

/// Opens it with `recipe`, which `make` gets now and after every change. It is its parent's, and gone when closed.
template <typename Recipe>
void openRecipe(QWidget* parent, const QString& title, std::span<const Parameter<Recipe>> table, const Recipe& recipe,
                const std::function<void(const Recipe&)>& make, const std::function<void()>& finish) {
    auto* dialog = new QDialog(parent);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setWindowTitle(title);
    dialog->setMinimumWidth(420);
    auto* layout = new QVBoxLayout(dialog);
    auto* panel = new ParameterPanel<Recipe>(table);
    auto* later = new QTimer(dialog);
    later->setSingleShot(true);
    const auto current = std::make_shared<Recipe>(recipe);
    panel->onChange = [current, later](const Parameter<Recipe>& parameter, double value) {
        parameter.set(*current, value);
        later->start(recipeMilliseconds);
    };
    panel->onFinish = finish;
    panel->show(recipe);
    QObject::connect(later, &QTimer::timeout, dialog, [current, make] { make(*current); });
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close);
    QObject::connect(buttons, &QDialogButtonBox::rejected, dialog, &QDialog::reject);
    layout->addWidget(panel);
    layout->addWidget(buttons);
    make(recipe);
    dialog->show();
}

} // namespace nacre::view
