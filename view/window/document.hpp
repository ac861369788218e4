// The scene that is open: what its file has, what was edited, and the history of that.
#pragma once

#include "view/model/edited_scene.hpp"

#include <QObject>
#include <QString>
#include <QUndoStack>

#include <filesystem>
#include <functional>

class QFileSystemWatcher;

namespace nacre::view {

class Document : public QObject {
    Q_OBJECT

public:
    explicit Document(QObject* parent = nullptr);

    /// Takes a scene that was read from `file`; an empty name is the gallery.
    void openScene(scene::Scene scene, const std::filesystem::path& file);

    /// The scene as its file has it; materials are there for all that `edited` has.
    const scene::Scene& scene() const { return scene_; }
    const EditedScene& edited() const { return edited_; }
    /// The scene with what was edited in it.
    scene::Scene current() const;
    const std::filesystem::path& file() const { return file_; }
    /// "gallery", or the file's name without its folder.
    QString name() const;

    /// Changes the scene, as a step of the history that undo calls `text`. Steps with one key that is not empty and
    /// without endEdit between them become one.
    void edit(const QString& text, const QString& key, const std::function<void(EditedScene&)>& change);
    void endEdit() { ++edit_; }
    QUndoStack& history() { return history_; }

    /// Whether everything that was edited is in files.
    bool isSaved() const;
    /// Writes the scene as it is, seen by `camera`, to a scene file, which is the document's file from now on. Throws
    /// FileError; nothing is lost then.
    void saveScene(const std::filesystem::path& file, const scene::Camera& camera);
    /// Says that the material that is shown has been written to a file.
    void materialSaved() { saved_.materials[material_] = edited_.materials[material_]; }

    /// Which material, layer and light the panels show.
    std::size_t material() const { return material_; }
    std::size_t light() const { return light_; }
    void select(std::size_t material);
    void selectLight(std::size_t light);

    /// Sets what was edited, from a command of the history.
    void restore(const EditedScene& edited);

Q_SIGNALS:
    void opened();
    void changed();
    void selectionChanged();
    /// A file that the scene was read from has changed.
    void changedOnDisk();

private:
    void watch();

    scene::Scene scene_;
    EditedScene edited_;
    EditedScene saved_;                        ///< what files have of it
    std::vector<scene::Surface> fileSurfaces_; ///< as `file_` has them
    std::filesystem::path file_;
    QUndoStack history_;
    QFileSystemWatcher* watcher_;
    int edit_ = 0;
    std::size_t material_ = 0;
    std::size_t light_ = 0;
};

} // namespace nacre::view
