// Buttons as all panels have them.
#pragma once

#include <QBoxLayout>
#include <QPushButton>

namespace nacre::view {

/// Adds a button at the end of `row`. A click calls `run`, a method of `receiver` or what can be called. Scripts and
/// tests find it by `name`.
template <typename Receiver, typename Run>
QPushButton* addButton(QBoxLayout& row, Receiver* receiver, const QString& name, const QString& text,
                       const QString& toolTip, Run run) {
    auto* button = new QPushButton(text);
    button->setObjectName(name);
    button->setToolTip(toolTip);
    QObject::connect(button, &QPushButton::clicked, receiver, run);
    row.addWidget(button);
    return button;
}

} // namespace nacre::view
