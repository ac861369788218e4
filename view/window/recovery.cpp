#include "view/window/recovery.hpp"

#include "nacre/files.hpp"
#include "view/model/edited_file.hpp"

#include <QCoreApplication>
#include <QDir>
#include <QFile>
#include <QJsonDocument>
#include <QJsonObject>
#include <QStandardPaths>

#include <csignal>
#include <vector>

namespace nacre::view {
namespace {

constexpr const char* pattern = "recovery-*.json";

QDir folder() {
    const QString path = QStandardPaths::writableLocation(QStandardPaths::AppDataLocation);
    QDir().mkpath(path);
    return {path};
}

bool isRunning(qint64 process) {
    return ::kill(static_cast<pid_t>(process), 0) == 0;
}

std::optional<Recovered> read(const QString& path) {
    QFile file(path);
    if (!file.open(QIODevice::ReadOnly)) {
        return std::nullopt;
    }
    const QJsonObject object = QJsonDocument::fromJson(file.readAll()).object();
    if (isRunning(object["process"].toInteger())) {
        return std::nullopt;
    }
    const QByteArray scene = QByteArray::fromPercentEncoding(object["scene"].toString().toLatin1());
    return Recovered{path, scene.toStdString(), object["edits"].toString()};
}

/// What programs that no longer run have left, the last one at the end.
std::vector<Recovered> left() {
    std::vector<Recovered> result;
    const QDir place = folder();
    for (const QString& name : place.entryList({pattern}, QDir::Files, QDir::Time | QDir::Reversed)) {
        if (std::optional<Recovered> found = read(place.filePath(name))) {
            result.push_back(std::move(*found));
        }
    }
    return result;
}

} // namespace

Recovery::Recovery() : file_(folder().filePath(QString("recovery-%1.json").arg(QCoreApplication::applicationPid()))) {}

/// The scene's file percent-encoded, since its name need not be UTF-8 as JSON is.
void Recovery::save(const std::filesystem::path& scene, const EditedScene& edited) {
    const QByteArray file = QByteArray::fromStdString(scene.string()).toPercentEncoding("/");
    const QJsonObject object{{"process", QCoreApplication::applicationPid()},
                             {"scene", QString::fromLatin1(file)},
                             {"edits", QString::fromStdString(formatEdited(edited))}};
    const QByteArray text = QJsonDocument(object).toJson();
    writeFileAtomically(file_.toStdString(),
                        {reinterpret_cast<const std::uint8_t*>(text.constData()), std::size_t(text.size())});
}

void Recovery::remove() {
    QFile::remove(file_);
}

std::optional<Recovered> Recovery::find() {
    std::optional<Recovered> result;
    for (Recovered& found : left()) {
        result = std::move(found);
    }
    return result;
}

void Recovery::forget() {
    for (const Recovered& found : left()) {
        QFile::remove(found.file);
    }
}

} // namespace nacre::view
