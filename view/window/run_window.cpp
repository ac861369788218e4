#include "view/run_window.hpp"

#include "view/window/main_window.hpp"
#include "view/window/script.hpp"

#include <QApplication>
#include <QTimer>

#include <iostream>
#include <stdexcept>

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

void requireNoMessages(const MainWindow& window) {
    const std::vector<std::string>& messages = window.device().validationMessages();
    if (!messages.empty()) {
        throw std::runtime_error("the validation layer has " + std::to_string(messages.size()) +
                                 " messages, the first: " + messages.front());
    }
}

void runScripted(MainWindow& window, const RunSettings& settings, const Script& script) {
    if (!window.openLoaded(settings.input, settings.load)) {
        throw std::runtime_error(window.lastFault().toStdString());
    }
    script.run(window);
}

/// What Qt has to say is a note, but for what a platform without windows cannot do.
void showNote(QtMsgType type, const QMessageLogContext&, const QString& text) {
    if (type != QtDebugMsg && type != QtInfoMsg && !text.startsWith("This plugin does not support")) {
        std::cerr << "nacre: note: " << text.toStdString() << '\n';
    }
}

} // namespace

int runWindow(const RunSettings& settings) {
    requireDisplay();
    int argumentCount = 1;
    char name[] = "nacre";
    char* arguments[] = {name, nullptr};
    qInstallMessageHandler(showNote);
    // A script answers Qt's own.
    QApplication::setAttribute(Qt::AA_DontUseNativeDialogs, !settings.script.empty());
    QApplication application(argumentCount, arguments);
    QApplication::setApplicationName("nacre");
    QApplication::setOrganizationName("nacre");
    MainWindow window(settings.device);
    if (!settings.script.empty()) {
        const Script script(settings.script);
        window.setQuiet(true);
        window.setStillSamples(script.samples());
        window.resize(script.windowSize().value_or(window.size()));
        window.show();
        QApplication::processEvents();
        runScripted(window, settings, script);
        requireNoMessages(window);
        return 0;
    }
    window.show();
    QTimer::singleShot(0, &window, [&] {
        window.openLoaded(settings.input, settings.load);
        window.offerRecovered();
    });
    const int result = QApplication::exec();
    requireNoMessages(window);
    return result;
}

} // namespace nacre::view
