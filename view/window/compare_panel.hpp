// Two pictures beside each other: techniques, the effect off, a picture from disk, a reference.
#pragma once

#include "view/loop/picture_loop.hpp"
#include "view/loop/reference_task.hpp"
#include "view/loop/side_error.hpp"
#include "view/window/parameter_slider.hpp"

#include <QComboBox>
#include <QLabel>
#include <QPushButton>
#include <QTimer>
#include <QWidget>

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace nacre::view {

class ComparePanel : public QWidget {
    Q_OBJECT

public:
    explicit ComparePanel(QWidget* parent = nullptr);

    /// What a side shows, on top of `common`, which holds for both.
    SideSettings side(std::uint32_t side, const renderer::SampleLook& common) const;
    renderer::ShowLook shown() const;
    void setDivider(float divider);
    bool isComparing() const;
    void cycle();

    /// Makes a reference of what is seen now; the panel owns its computation.
    std::function<std::unique_ptr<ReferenceTask>()> makeReference;
    /// The pictures of both sides.
    std::function<renderer::SidePicture(std::uint32_t)> readSide;
    /// Ends the reference, whose scene or camera is no longer what is seen.
    void outdate();
    void stop() { reference_.reset(); }
    /// Both sides have all their samples: measures them, beside the window.
    void measure();
    bool isMeasuring() const;
    /// Loads the picture of side B. Throws FileError.
    void loadPicture(const QString& file);

Q_SIGNALS:
    /// Something was chosen that the window has to show.
    void chosen();
    void given(const nacre::Image& image);
    void failed(QString sentence);

private:
    void chooseSecond();
    void startReference();
    void poll();
    void pollError();
    void showError(const SideError& error);
    bool isReference() const;
    bool isPicture() const;

    std::vector<renderer::EffectSettings> effects_; ///< rows of both lists; the first is the default
    QComboBox* mode_;
    QComboBox* first_;
    QComboBox* second_;
    ParameterSlider* divider_;
    QPushButton* restart_;
    QLabel* progress_;
    QLabel* error_;
    std::unique_ptr<ReferenceTask> reference_;
    std::uint64_t version_ = 0;
    QTimer poll_;
    QLabel* map_;
    SideErrorTask errorTask_;
    QTimer pollError_;
    bool pictureIsDisplayed_ = false;
};

} // namespace nacre::view
