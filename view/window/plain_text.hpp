// Text that names what is in files. Qt takes what looks like HTML for HTML, and would show pictures that it names.
#pragma once

#include <QLabel>
#include <QMessageBox>

namespace nacre::view {

/// A label that shows its text as it is.
inline QLabel* makePlainLabel(const QString& text = {}) {
    auto* label = new QLabel(text);
    label->setTextFormat(Qt::PlainText);
    return label;
}

/// Asks, or says, the sentence as it is, and waits for a button.
QMessageBox::StandardButton showPlainMessage(QWidget* parent, QMessageBox::Icon icon, const QString& sentence,
                                             QMessageBox::StandardButtons buttons = QMessageBox::Ok,
                                             QMessageBox::StandardButton standard = QMessageBox::NoButton);

} // namespace nacre::view
