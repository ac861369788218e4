#include "view/window/plain_text.hpp"

namespace nacre::view {

QMessageBox::StandardButton showPlainMessage(QWidget* parent, QMessageBox::Icon icon, const QString& sentence,
                                             QMessageBox::StandardButtons buttons,
                                             QMessageBox::StandardButton standard) {
    QMessageBox box(icon, "Nacre", sentence, buttons, parent);
    box.setTextFormat(Qt::PlainText);
    box.setDefaultButton(standard);
    return static_cast<QMessageBox::StandardButton>(box.exec());
}

} // namespace nacre::view
