#include "view/window/recovery.hpp"

#include "nacre/files.hpp"

#include <QCoreApplication>
#include <QDir>
#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QStandardPaths>

#include <csignal>

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
    file.remove();
    Recovered result{object["scene"].toString(), {}};
    for (const auto& text : object["materials"].toArray()) {
        try {
            result.materials.push_back(parseMaterial(text.toString().toStdString(), path.toStdString()));
        } catch (const FileError&) {
            return std::nullopt;
        }
    }
    return result;
}

} // namespace

Recovery::Recovery() : file_(folder().filePath(QString("recovery-%1.json").arg(QCoreApplication::applicationPid()))) {}

void Recovery::save(const QString& scene, const EditedScene& edited) {
    QJsonArray materials;
    for (const EditedMaterial& material : edited.materials) {
        materials.append(QString::fromStdString(formatMaterial(material.drawn())));
    }
    const QJsonObject object{
        {"process", QCoreApplication::applicationPid()}, {"scene", scene}, {"materials", materials}};
    const QByteArray text = QJsonDocument(object).toJson();
    writeFileAtomically(file_.toStdString(),
                        {reinterpret_cast<const std::uint8_t*>(text.constData()), std::size_t(text.size())});
}

void Recovery::remove() {
    QFile::remove(file_);
}

std::optional<Recovered> Recovery::take() {
    std::optional<Recovered> result;
    const QDir place = folder();
    for (const QString& name : place.entryList({pattern}, QDir::Files, QDir::Time | QDir::Reversed)) {
        if (std::optional<Recovered> found = read(place.filePath(name))) {
            result = std::move(found);
        }
    }
    return result;
}

} // namespace nacre::view
