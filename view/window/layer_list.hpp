// The layers of a material as a list: each with its colour, its radius and whether it is drawn.
#pragma once

#include "view/window/document.hpp"

#include <QListWidget>

namespace nacre::view {

class LayerList : public QWidget {
    Q_OBJECT

public:
    explicit LayerList(Document& document, QWidget* parent = nullptr);

    /// The layer that is selected.
    std::size_t layer() const;

Q_SIGNALS:
    void selected();

private:
    void refresh();
    void change(const QString& text, const std::function<void(EditedMaterial&)>& change);
    void move(int by);

    Document& document_;
    QListWidget* list_;
    bool refreshing_ = false;
};

} // namespace nacre::view
