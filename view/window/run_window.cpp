#include "view/run_window.hpp"

#include "view/window/main_window.hpp"

#include <QApplication>
#include <QTimer>

#include <iostream>

namespace nacre::view {
namespace {

/// Qt ends the program where it finds no display; a sentence does as well.
void requireDisplay() {
    const bool hasDisplay = qEnvironmentVariableIsSet("DISPLAY") || qEnvironmentVariableIsSet("WAYLAND_DISPLAY") ||
                            qEnvironmentVariableIsSet("QT_QPA_PLATFORM");
    if (!hasDisplay) {
        throw std::runtime_error("there is no display to open a window on; --headless draws without one");
    }
}

} // namespace

int runWindow(const RunSettings& settings) {
    requireDisplay();
    int argumentCount = 1;
    char name[] = "nacre";
    char* arguments[] = {name, nullptr};
    QApplication application(argumentCount, arguments);
    QApplication::setApplicationName("nacre");
    QApplication::setOrganizationName("nacre");
    MainWindow window({settings.input, settings.material, settings.device});
    window.show();
    QTimer::singleShot(0, &window, [&] {
        window.openFile(QString::fromStdString(settings.input.string()));
        window.offerRecovered();
    });
    const int result = QApplication::exec();
    if (!window.device().validationMessages().empty()) {
        throw std::runtime_error("the validation layer has " +
                                 std::to_string(window.device().validationMessages().size()) +
                                 " messages, the first: " + window.device().validationMessages().front());
    }
    return result;
}

} // namespace nacre::view
