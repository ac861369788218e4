#include "view/window/script.hpp"

#include "nacre/files.hpp"
#include "view/window/main_window.hpp"
#include "view/window/material_panel.hpp"
#include "view/window/parameter_slider.hpp"
#include "view/window/shown_image.hpp"

#include <QApplication>
#include <QCheckBox>
#include <QComboBox>
#include <QDockWidget>
#include <QFileDialog>
#include <QFileInfo>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QMessageBox>
#include <QPainter>
#include <QScrollArea>
#include <QTest>
#include <QTimer>

#include <array>
#include <functional>

namespace nacre::view {
namespace {

constexpr int longestWait = 600'000; // ms: a software device needs its time

/// What is wrong with a step; the file and the step's number are put before it.
struct StepFault : std::runtime_error {
    using std::runtime_error::runtime_error;
};

[[noreturn]] void refuse(const QString& sentence) {
    throw StepFault(sentence.toStdString());
}

template <typename Widget> Widget& find(MainWindow& window, const QString& name) {
    auto* widget = window.findChild<Widget*>(name);
    if (widget == nullptr) {
        refuse("there is no " + QString(Widget::staticMetaObject.className()) + " '" + name + "'");
    }
    return *widget;
}

/// The same of what a user has to see, to use it: its panel scrolls to it.
template <typename Widget> Widget& findShown(MainWindow& window, const QString& name) {
    auto& widget = find<Widget>(window, name);
    if (!widget.isVisible() || !widget.isEnabled()) {
        refuse("'" + name + "' is " + (widget.isVisible() ? "disabled" : "not on the screen: its panel comes first"));
    }
    for (QWidget* above = widget.parentWidget(); above != nullptr; above = above->parentWidget()) {
        if (auto* area = qobject_cast<QScrollArea*>(above)) {
            area->ensureWidgetVisible(&widget);
        }
    }
    return widget;
}

QString textOf(const QJsonValue& value, const char* what) {
    if (!value.isString()) {
        refuse(QString("'%1' must be a text").arg(what));
    }
    return value.toString();
}

std::array<double, 2> pairOf(const QJsonValue& value, const char* what) {
    const QJsonArray numbers = value.toArray();
    if (numbers.size() != 2 || !numbers[0].isDouble() || !numbers[1].isDouble()) {
        refuse(QString("'%1' must be two numbers").arg(what));
    }
    return {numbers[0].toDouble(), numbers[1].toDouble()};
}

void requireNoFault(MainWindow& window, const QString& before) {
    if (window.lastFault() != before) {
        refuse("it went wrong: " + window.lastFault());
    }
}

/// Does what asks for a file where the step has a "file": types its name into the dialogue, as a user would. Whatever
/// else is asked ends the step.
void answering(const QJsonObject& step, const std::function<void()>& act) {
    if (!step.contains("file")) {
        act();
        return;
    }
    const QString file = QFileInfo(textOf(step["file"], "file")).absoluteFilePath();
    QString fault = "it asks for no file";
    QTimer timer;
    QObject::connect(&timer, &QTimer::timeout, [&] {
        QWidget* asking = QApplication::activeModalWidget();
        auto* dialog = qobject_cast<QFileDialog*>(asking);
        if (auto* box = qobject_cast<QMessageBox*>(asking)) {
            fault = "it asks: " + box->text();
            box->reject();
        } else if (dialog != nullptr && fault == "it asks for no file") {
            fault.clear();
            auto* name = dialog->findChild<QLineEdit*>("fileNameEdit");
            name->setText(file);
            QTimer::singleShot(0, name, [name] { QTest::keyClick(name, Qt::Key_Return); }); // which may ask again
        } else if (dialog != nullptr) {
            dialog->reject();
        }
    });
    constexpr int lookMilliseconds = 20;
    timer.start(lookMilliseconds);
    act();
    if (!fault.isEmpty()) {
        refuse(fault);
    }
}

/// {"set": NAME, "value": NUMBER}: as if typed into the parameter's field.
void set(MainWindow& window, const QJsonObject& step) {
    auto& slider = findShown<ParameterSlider>(window, textOf(step["set"], "set"));
    if (!step["value"].isDouble()) {
        refuse("'value' must be a number");
    }
    slider.setValue(step["value"].toDouble());
    Q_EMIT slider.finished();
}

/// {"choose": NAME, "item": TEXT} of a list.
void choose(MainWindow& window, const QJsonObject& step) {
    const QString item = textOf(step["item"], "item");
    auto& box = findShown<QComboBox>(window, textOf(step["choose"], "choose"));
    const int row = box.findText(item);
    if (row < 0) {
        refuse("'" + box.objectName() + "' has no item '" + item + "'");
    }
    box.setCurrentIndex(row);
    Q_EMIT box.activated(row);
}

/// {"select": NAME, "row": NUMBER}, and "checked" of that row.
void select(MainWindow& window, const QJsonObject& step) {
    auto& list = findShown<QListWidget>(window, textOf(step["select"], "select"));
    const int row = step["row"].toInt(-1);
    if (row < 0 || row >= list.count()) {
        refuse(QString("'%1' has no row %2, only 0 to %3").arg(list.objectName()).arg(row).arg(list.count() - 1));
    }
    list.setCurrentRow(row);
    if (step.contains("checked")) {
        list.item(row)->setCheckState(step["checked"].toBool() ? Qt::Checked : Qt::Unchecked);
    }
}

void click(MainWindow& window, const QJsonObject& step) {
    auto& button = findShown<QAbstractButton>(window, textOf(step["click"], "click"));
    answering(step, [&] { button.click(); });
}

void act(MainWindow& window, const QJsonObject& step) {
    auto& action = find<QAction>(window, textOf(step["action"], "action"));
    answering(step, [&] { action.trigger(); });
}

void press(MainWindow& window, const QJsonObject& step) {
    const QKeySequence keys(textOf(step["key"], "key"));
    if (keys.count() != 1 || keys[0].key() == Qt::Key_unknown) {
        refuse("'" + step["key"].toString() + "' is no key");
    }
    QTest::keyClick(&window, keys[0].key(), keys[0].keyboardModifiers());
}

void openFile(MainWindow& window, const QJsonObject& step) {
    const QString file = textOf(step["open"], "open");
    if (file == "gallery") {
        window.openFile({});
    } else {
        window.openAny(file);
    }
}

void showPanel(MainWindow& window, const QJsonObject& step) {
    auto& dock = find<QDockWidget>(window, "dock." + textOf(step["panel"], "panel").toLower());
    dock.show();
    dock.raise();
    QApplication::processEvents();
}

/// {"drag": [X, Y], "to": [X, Y], "with": "Shift" or "Ctrl"} in the picture, shares of it.
void drag(MainWindow& window, const QJsonObject& step) {
    const auto at = [&](const char* key) {
        const std::array<double, 2> place = pairOf(step[key], key);
        return QPoint(static_cast<int>(place[0] * window.picture().width()),
                      static_cast<int>(place[1] * window.picture().height()));
    };
    const QPoint from = at("drag");
    const QPoint to = at("to");
    const QString with = step["with"].toString();
    const Qt::KeyboardModifiers keys = with == "Shift"  ? Qt::ShiftModifier
                                       : with == "Ctrl" ? Qt::ControlModifier
                                                        : Qt::NoModifier;
    QTest::mousePress(&window.picture(), Qt::LeftButton, keys, from);
    constexpr int moves = 8;
    for (int i = 1; i <= moves; ++i) {
        const QPoint place = from + (to - from) * i / moves;
        QMouseEvent event(QEvent::MouseMove, place, window.picture().mapToGlobal(place), Qt::NoButton, Qt::LeftButton,
                          keys);
        QApplication::sendEvent(&window.picture(), &event);
        QApplication::processEvents();
    }
    QTest::mouseRelease(&window.picture(), Qt::LeftButton, keys, to);
}

void pick(MainWindow& window, const QJsonObject& step) {
    const std::array<double, 2> place = pairOf(step["pick"], "pick");
    Q_EMIT window.picture().clicked(QPointF(place[0], place[1]));
}

void resizeWindow(MainWindow& window, const QJsonObject& step) {
    const std::array<double, 2> size = pairOf(step["size"], "size");
    window.resize(static_cast<int>(size[0]), static_cast<int>(size[1]));
    QApplication::processEvents();
}

void waitStill(MainWindow& window, const QJsonObject&) {
    if (!window.drawUntilStill(longestWait)) {
        refuse("the picture is not finished after ten minutes");
    }
}

void savePicture(MainWindow& window, const QJsonObject& step) {
    window.writePicture(textOf(step["picture"], "picture"));
}

void saveScene(MainWindow& window, const QJsonObject& step) {
    window.writeScene(textOf(step["saveScene"], "saveScene"));
}

void pause(MainWindow&, const QJsonObject& step) {
    if (!step["pause"].isDouble()) {
        refuse("'pause' must be a number of milliseconds");
    }
    QTest::qWait(step["pause"].toInt());
}

/// {"expect": NAME, "text": PART, "within": MILLISECONDS}: that a label has this in its text, at once where no time is
/// given.
void expect(MainWindow& window, const QJsonObject& step) {
    const auto& label = find<QLabel>(window, textOf(step["expect"], "expect"));
    const QString part = textOf(step["text"], "text");
    if (!QTest::qWaitFor([&] { return label.text().contains(part); }, step["within"].toInt(0))) {
        refuse("'" + label.objectName() + "' says '" + label.text() + "', and not '" + part + "'");
    }
}

void recover(MainWindow& window, const QJsonObject&) {
    window.offerRecovered();
}

void hide(MainWindow& window, const QJsonObject& step) {
    window.setVisible(!step["hide"].toBool());
    QApplication::processEvents();
}

void saveMaterial(MainWindow& window, const QJsonObject& step) {
    window.materialPanel().save(textOf(step["saveMaterial"], "saveMaterial"));
}

void loadMaterialFile(MainWindow& window, const QJsonObject& step) {
    window.materialPanel().load(textOf(step["loadMaterial"], "loadMaterial"));
}

/// {"screenshot": FILE.png}: the window with its picture, which Qt does not see.
void takeScreenshot(MainWindow& window, const QJsonObject& step) {
    if (window.loop() == nullptr) {
        refuse("there is no picture");
    }
    window.finishSwatch();
    QPixmap shot = window.grab();
    const QRect area(window.centralWidget()->pos(), window.centralWidget()->size());
    QPainter painter(&shot);
    painter.drawImage(area, toQImage(window.loop()->readWindow(static_cast<std::uint32_t>(area.width()),
                                                               static_cast<std::uint32_t>(area.height()))));
    painter.end();
    const QString file = textOf(step["screenshot"], "screenshot");
    if (!shot.save(file)) {
        refuse("'" + file + "' cannot be written");
    }
}

/// A step is what its first key among these says.
struct StepKind {
    const char* key;
    void (*run)(MainWindow&, const QJsonObject&);
};
constexpr std::array kinds{StepKind{"set", set},
                           StepKind{"choose", choose},
                           StepKind{"select", select},
                           StepKind{"click", click},
                           StepKind{"action", act},
                           StepKind{"key", press},
                           StepKind{"open", openFile},
                           StepKind{"panel", showPanel},
                           StepKind{"drag", drag},
                           StepKind{"pick", pick},
                           StepKind{"size", resizeWindow},
                           StepKind{"wait", waitStill},
                           StepKind{"saveMaterial", saveMaterial},
                           StepKind{"loadMaterial", loadMaterialFile},
                           StepKind{"saveScene", saveScene},
                           StepKind{"recover", recover},
                           StepKind{"expect", expect},
                           StepKind{"pause", pause},
                           StepKind{"hide", hide},
                           StepKind{"picture", savePicture},
                           StepKind{"screenshot", takeScreenshot}};

void runStep(MainWindow& window, const QJsonObject& step) {
    for (const StepKind& kind : kinds) {
        if (step.contains(kind.key)) {
            const QString before = window.lastFault();
            kind.run(window, step);
            QApplication::processEvents();
            requireNoFault(window, before);
            return;
        }
    }
    QStringList names;
    for (const StepKind& kind : kinds) {
        names << kind.key;
    }
    refuse("it has none of the keys " + names.join(", "));
}

} // namespace

Script::Script(const std::filesystem::path& file) : file_(file) {
    const std::vector<std::uint8_t> bytes = readFile(file);
    QJsonParseError fault{};
    const QJsonDocument document = QJsonDocument::fromJson(
        QByteArray(reinterpret_cast<const char*>(bytes.data()), static_cast<qsizetype>(bytes.size())), &fault);
    if (fault.error != QJsonParseError::NoError) {
        throw FileError(file.string() + ": is not JSON: " + fault.errorString().toStdString());
    }
    content_ = document.object();
    if (!content_["steps"].isArray()) {
        throw FileError(file.string() + ": 'steps' must be a list");
    }
    static_cast<void>(windowSize());
    static_cast<void>(samples());
}

std::optional<QSize> Script::windowSize() const {
    if (!content_.contains("size")) {
        return std::nullopt;
    }
    const QJsonArray size = content_["size"].toArray();
    if (size.size() != 2 || size[0].toInt() < 1 || size[1].toInt() < 1) {
        throw FileError(file_.string() + ": 'size' must be two numbers of pixels");
    }
    return QSize(size[0].toInt(), size[1].toInt());
}

std::optional<std::uint32_t> Script::samples() const {
    if (!content_.contains("samples")) {
        return std::nullopt;
    }
    const int samples = content_["samples"].toInt();
    if (samples < 1) {
        throw FileError(file_.string() + ": 'samples' must be a number of at least 1");
    }
    return static_cast<std::uint32_t>(samples);
}

void Script::run(MainWindow& window) const {
    const QJsonArray rows = content_["steps"].toArray();
    for (qsizetype i = 0; i < rows.size(); ++i) {
        try {
            runStep(window, rows[i].toObject());
        } catch (const StepFault& error) {
            throw std::runtime_error(file_.string() + ": steps[" + std::to_string(i) + "]: " + error.what());
        }
    }
}

} // namespace nacre::view
