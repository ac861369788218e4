#include "view/window/compare_panel.hpp"

#include "image/image_file.hpp"
#include "view/window/plain_text.hpp"
#include "view/window/shown_image.hpp"

#include <QFileDialog>
#include <QFormLayout>
#include <QPixmap>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>

namespace nacre::view {
namespace {

using renderer::ShownSides;

constexpr int pollMilliseconds = 300;
constexpr const char* pictureRow = "Picture from disk …";
constexpr const char* referenceRow = "Reference (surface integral)";

std::vector<NacreTechnique> techniques() {
    std::uint32_t count = 0;
    nacreGetTechniques(&count, nullptr);
    std::vector<NacreTechnique> all(count);
    nacreGetTechniques(&count, all.data());
    return all;
}

} // namespace

ComparePanel::ComparePanel(QWidget* parent)
    : QWidget(parent),
      mode_(new QComboBox),
      first_(new QComboBox),
      second_(new QComboBox),
      divider_(new ParameterSlider("compare.divider", {.decimals = 3},
                                   "Where B begins, from left to right; it can be dragged in the picture, too")),
      restart_(new QPushButton("Start the &reference again")),
      progress_(makePlainLabel()),
      error_(new QLabel),
      map_(new QLabel) {
    mode_->setObjectName("compare.mode");
    mode_->addItems({"A alone", "A and B, divided", "Difference, heat map"});
    mode_->setToolTip("F2 goes through them. The divider can be dragged in the picture");
    first_->setObjectName("compare.first");
    second_->setObjectName("compare.second");
    restart_->setObjectName("compare.restart");
    progress_->setObjectName("compare.progress");
    error_->setObjectName("compare.error");
    progress_->setWordWrap(true);
    error_->setWordWrap(true);
    const auto add = [this](const QString& label, const renderer::EffectSettings& effect) {
        effects_.push_back(effect);
        first_->addItem(label);
        second_->addItem(label);
    };
    add("Effect on", {});
    add("Effect off", {.scatter = false, .transmit = false});
    add("Scatter only", {.transmit = false});
    add("Transmit only", {.scatter = false});
    for (const NacreTechnique technique : techniques()) {
        add(QString("Technique ") + nacreTechniqueString(technique), {.technique = technique});
    }
    second_->addItems({pictureRow, referenceRow});
    second_->setCurrentIndex(1);
    auto* form = new QFormLayout;
    form->addRow("Sho&w", mode_);
    form->addRow("&A, left", first_);
    form->addRow("&B, right", second_);
    form->addRow("Di&vider", divider_);
    divider_->showValue(0.5);
    auto* layout = new QVBoxLayout(this);
    layout->addLayout(form);
    layout->addWidget(restart_);
    layout->addWidget(progress_);
    layout->addWidget(error_);
    map_->setObjectName("compare.map");
    map_->setToolTip("FLIP of every pixel: black, no difference is seen; white, the largest");
    map_->setAccessibleName("FLIP of every pixel");
    layout->addWidget(map_);
    layout->addStretch();
    restart_->hide();

    connect(mode_, &QComboBox::currentIndexChanged, this, &ComparePanel::chosen);
    connect(divider_, &ParameterSlider::changed, this, &ComparePanel::chosen);
    connect(first_, &QComboBox::currentIndexChanged, this, &ComparePanel::chosen);
    connect(second_, &QComboBox::currentIndexChanged, this, &ComparePanel::chooseSecond);
    // Whoever chooses what to compare with wants to see it, also where it was chosen already.
    for (const QComboBox* list : {first_, second_}) {
        connect(list, &QComboBox::activated, this, [this] {
            if (!isComparing()) {
                mode_->setCurrentIndex(1);
            }
        });
    }
    connect(&pollError_, &QTimer::timeout, this, &ComparePanel::pollError);
    connect(restart_, &QPushButton::clicked, this, &ComparePanel::startReference);
    connect(&poll_, &QTimer::timeout, this, &ComparePanel::poll);
}

bool ComparePanel::isReference() const {
    return second_->currentText() == referenceRow;
}

bool ComparePanel::isPicture() const {
    return second_->currentText() == pictureRow;
}

bool ComparePanel::isComparing() const {
    return mode_->currentIndex() > 0;
}

void ComparePanel::cycle() {
    mode_->setCurrentIndex((mode_->currentIndex() + 1) % mode_->count());
}

SideSettings ComparePanel::side(std::uint32_t side, const renderer::SampleLook& common) const {
    SideSettings result;
    result.look = common;
    const QComboBox* list = side == 0 ? first_ : second_;
    const auto row = static_cast<std::size_t>(list->currentIndex());
    if (row < effects_.size()) {
        result.effect = effects_[row];
        // A reference has diffuse light alone.
        if (isComparing() && isReference() && common.image == renderer::ShownImage::Picture) {
            result.look.image = renderer::ShownImage::Diffuse;
        }
        return result;
    }
    result.look.image = renderer::ShownImage::Given;
    result.look.givenIsDisplayed = isPicture() && pictureIsDisplayed_;
    return result;
}

renderer::ShowLook ComparePanel::shown() const {
    return {static_cast<ShownSides>(mode_->currentIndex()), static_cast<float>(divider_->value()), 4};
}

void ComparePanel::setDivider(float divider) {
    divider_->showValue(divider);
    Q_EMIT chosen();
}

void ComparePanel::chooseSecond() {
    restart_->setVisible(isReference());
    error_->clear();
    progress_->clear();
    if (isPicture()) {
        const QString file =
            QFileDialog::getOpenFileName(this, "Compare with a picture", {}, "Pictures (*.png *.exr *.hdr *.jpg)");
        if (file.isEmpty()) {
            second_->setCurrentIndex(1);
            return;
        }
        try {
            loadPicture(file);
        } catch (const std::exception& error) {
            second_->setCurrentIndex(1);
            Q_EMIT failed(QString::fromUtf8(error.what()));
            return;
        }
    }
    if (isReference()) {
        startReference();
    } else {
        reference_.reset();
        poll_.stop();
    }
    if (!isComparing()) {
        mode_->setCurrentIndex(1);
    }
    Q_EMIT chosen();
}

void ComparePanel::loadPicture(const QString& file) {
    const Image image = toRgb(nacre::readImage(file.toStdString()));
    pictureIsDisplayed_ = image.encoding == Encoding::Srgb;
    progress_->setText(file);
    Q_EMIT given(toEncoding(image, Encoding::Linear));
}

void ComparePanel::startReference() {
    if (!makeReference || !isReference()) {
        return;
    }
    reference_.reset();
    version_ = 0;
    reference_ = makeReference();
    progress_->setText("The reference has begun …");
    poll_.start(pollMilliseconds);
}

void ComparePanel::outdate() {
    if (reference_) {
        reference_.reset();
        poll_.stop();
        progress_->setText("The reference was of what was seen before. It begins again when the picture stands still.");
    }
}

void ComparePanel::poll() {
    if (!reference_) {
        return;
    }
    const ReferenceTask::State state = reference_->state();
    if (!state.fault.empty()) {
        reference_.reset();
        poll_.stop();
        Q_EMIT failed(QString::fromStdString(state.fault));
        return;
    }
    QString text = QString("Reference: %1 samples a pixel").arg(state.samples, 0, 'f', 1);
    if (state.version == 0) {
        text += "; it is seen once every pixel has one";
    }
    if (std::isfinite(state.noise) && state.noise > 0) {
        text += QString(", noise %1 %").arg(100 * state.noise, 0, 'g', 2);
    }
    progress_->setText(text);
    if (state.version != version_ && !state.light.values.empty()) {
        version_ = state.version;
        Q_EMIT given(state.light);
        Q_EMIT chosen();
    }
}

void ComparePanel::measure() {
    if (isComparing() && isReference() && !reference_) {
        startReference(); // the picture stands still again
        return;
    }
    const bool hasNothing = isReference() && version_ == 0;
    if (!isComparing() || !readSide || hasNothing) {
        error_->clear();
        map_->clear();
        return;
    }
    renderer::SidePicture first = readSide(0);
    renderer::SidePicture second = readSide(1);
    if (first.shown.values.size() != second.shown.values.size() || second.samples == 0) {
        return;
    }
    SidePair pair{std::move(first.shown), std::move(second.shown), {}, {}};
    if (!pictureIsDisplayed_ || !isPicture()) {
        pair.firstLight = std::move(first.light);
        pair.secondLight = std::move(second.light);
    }
    errorTask_.begin(std::move(pair));
    pollError_.start(pollMilliseconds);
}

bool ComparePanel::isMeasuring() const {
    return errorTask_.isBusy();
}

void ComparePanel::pollError() {
    if (const std::optional<SideError> error = errorTask_.take(); error && isComparing()) {
        showError(*error);
    }
    if (!errorTask_.isBusy()) {
        pollError_.stop();
    }
}

void ComparePanel::showError(const SideError& error) {
    QString text =
        std::isfinite(error.psnr)
            ? QString("PSNR of A against B: %1 dB\nFLIP: %2").arg(error.psnr, 0, 'f', 1).arg(error.flip, 0, 'f', 4)
            : QString("A and B are equal.");
    if (error.energyRatio) {
        text += QString("\nLight, A over B: red %1, green %2, blue %3")
                    .arg((*error.energyRatio)[0], 0, 'f', 3)
                    .arg((*error.energyRatio)[1], 0, 'f', 3)
                    .arg((*error.energyRatio)[2], 0, 'f', 3);
    }
    error_->setText(text);
    constexpr int mapWidth = 300; // px: as wide as the panel at least is
    map_->setPixmap(
        QPixmap::fromImage(toQImage(error.map)).scaledToWidth(std::min(mapWidth, width()), Qt::SmoothTransformation));
}

} // namespace nacre::view
