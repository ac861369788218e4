// The stack of slabs that a material is made of.
#pragma once

#include "view/model/recipes.hpp"
#include "view/window/parameter_panel.hpp"

#include <QDialog>
#include <QListWidget>
#include <QTimer>

#include <functional>

namespace nacre::view {

/// A dialogue beside the window: slabs from the top to the bottom, and the numbers of the one that is selected.
class SlabDialog : public QDialog {
    Q_OBJECT

public:
    /// `make` gets the slabs a moment after every change.
    SlabDialog(std::vector<Slab> slabs, std::function<void(const std::vector<Slab>&)> make, QWidget* parent);

private:
    void refresh();
    void change(const std::function<void(std::vector<Slab>&)>& change);
    void move(int by);
    std::size_t slab() const;

    std::vector<Slab> slabs_;
    std::function<void(const std::vector<Slab>&)> make_;
    QListWidget* list_;
    ParameterPanel<Slab>* parameters_;
    QTimer later_;
};

} // namespace nacre::view
