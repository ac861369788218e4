// What was clicked in the picture.
#pragma once

#include "view/model/inspection.hpp"
#include "view/window/document.hpp"

#include <QLabel>
#include <QPushButton>
#include <QWidget>

namespace nacre::view {

class InspectPanel : public QWidget {
    Q_OBJECT

public:
    explicit InspectPanel(Document& document, QWidget* parent = nullptr);
    void show(const std::optional<Inspection>& inspection);

private:
    void give(std::uint32_t material, const QString& text);

    Document& document_;
    QLabel* text_;
    QPushButton* give_;
    QPushButton* take_;
    std::optional<Inspection> inspection_;
};

} // namespace nacre::view
