#include "view/window/document.hpp"

#include "scene/files/save_scene_file.hpp"
#include "view/model/edited_file.hpp"

#include <QFileSystemWatcher>

#include <algorithm>

namespace nacre::view {
namespace {

constexpr int editCommand = 1; // the id of those that may become one

/// A step of the history: the values before and after.
class EditCommand : public QUndoCommand {
public:
    EditCommand(Document& document, const QString& text, QString key, int edit, EditedScene before, EditedScene after)
        : QUndoCommand(text),
          document_(document),
          key_(std::move(key)),
          edit_(edit),
          before_(std::move(before)),
          after_(std::move(after)) {}

    void undo() override { document_.restore(before_); }
    void redo() override { document_.restore(after_); }
    int id() const override { return editCommand; }
    bool mergeWith(const QUndoCommand* other) override {
        const auto& next = static_cast<const EditCommand&>(*other);
        if (key_.isEmpty() || next.key_ != key_ || next.edit_ != edit_) {
            return false;
        }
        after_ = next.after_;
        return true;
    }

private:
    Document& document_;
    QString key_;
    int edit_;
    EditedScene before_;
    EditedScene after_;
};

} // namespace

Document::Document(QObject* parent) : QObject(parent), history_(this), watcher_(new QFileSystemWatcher(this)) {
    connect(watcher_, &QFileSystemWatcher::fileChanged, this, &Document::changedOnDisk);
}

void Document::openScene(scene::Scene scene, const std::filesystem::path& file) {
    scene_ = std::move(scene);
    edited_ = saved_ = editedOf(scene_);
    fileSurfaces_ = scene_.surfaces;
    file_ = file;
    history_.clear();
    material_ = 0;
    light_ = 0;
    watch();
    Q_EMIT opened();
    Q_EMIT changed();
    Q_EMIT selectionChanged();
}

void Document::watch() {
    if (!watcher_->files().isEmpty()) {
        watcher_->removePaths(watcher_->files());
    }
    QStringList files;
    if (!file_.empty()) {
        files << QString::fromStdString(file_.string());
    }
    for (const std::string& input : scene_.inputs) {
        files << QString::fromStdString(input);
    }
    if (!files.isEmpty()) {
        watcher_->addPaths(files);
    }
}

scene::Scene Document::current() const {
    return sceneOf(scene_, edited_);
}

bool Document::isSaved() const {
    return history_.isClean() || formatEdited(edited_) == formatEdited(saved_);
}

void Document::saveScene(const std::filesystem::path& file, const scene::Camera& camera) {
    scene::Scene scene = current();
    std::erase_if(scene.cameras, [&](const scene::Camera& other) { return other.name == camera.name; });
    scene.cameras.insert(scene.cameras.begin(), camera);
    if (!watcher_->files().isEmpty()) {
        watcher_->removePaths(watcher_->files()); // this change of the file is ours
    }
    try {
        scene::saveSceneFile(scene, fileSurfaces_, file_, file);
    } catch (...) {
        watch();
        throw;
    }
    file_ = file;
    saved_ = edited_;
    fileSurfaces_ = edited_.surfaces;
    history_.setClean();
    watch();
}

QString Document::name() const {
    return file_.empty() ? "gallery" : QString::fromStdString(file_.filename().string());
}

void Document::edit(const QString& text, const QString& key, const std::function<void(EditedScene&)>& change) {
    EditedScene after = edited_;
    change(after);
    history_.push(new EditCommand(*this, text, key, edit_, edited_, std::move(after)));
}

void Document::restore(const EditedScene& edited) {
    edited_ = edited;
    material_ = std::min(material_, edited_.materials.size() - 1);
    light_ = edited_.lights.empty() ? 0 : std::min(light_, edited_.lights.size() - 1);
    Q_EMIT changed();
}

void Document::select(std::size_t material) {
    material_ = std::min(material, edited_.materials.size() - 1);
    Q_EMIT selectionChanged();
}

void Document::selectLight(std::size_t light) {
    light_ = edited_.lights.empty() ? 0 : std::min(light, edited_.lights.size() - 1);
    Q_EMIT selectionChanged();
}

} // namespace nacre::view
