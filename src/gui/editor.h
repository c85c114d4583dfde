#pragma once
// What is being edited, and everything that can be done to it: the scene, its file, the selection, the eye, time. No
// window, no panels, no OpenGL: a panel draws what it reads here and calls the methods below.
//
// Every edit keeps the scene such that it can be saved: a command that would break that changes nothing and says why.
#include "core/accuracy/run.h"
#include "gui/orbit.h"
#include "gui/simulation.h"

#include <glm/vec2.hpp>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace mb {

inline constexpr std::size_t kLongestName = 64;  // bytes; the panels' text fields take no more

/// What the last command has to say; an error stays until something succeeds or it is dismissed.
struct Message {
    bool error = false;
    std::string text;  // may have several lines
};

class Editor {
public:
    /// A floor, a light and a ball, with no file.
    Editor();

    const Scene& scene() const { return scene_; }
    /// Counts every change of what can be seen, the eye's and the bodies' motion included.
    std::uint64_t revision() const { return revision_; }
    /// Edits since the file was read or written. The bodies' own motion and the eye's are no edits; a reset is one where it
    /// leads away from what was saved.
    bool unsaved() const { return edits_ != saved_edits_; }
    const std::filesystem::path& path() const { return path_; }
    const Message& message() const { return message_; }
    void say(bool error, std::string text) { message_ = {error, std::move(text)}; }

    // Files (editor_files.cpp). Each says whether it was done; if not, nothing changed and message() has the reason.
    bool open(const std::filesystem::path& path);
    bool save();                                     // to path(); needs one
    bool saveAs(const std::filesystem::path& path);  // ".txt" is added to a name with no extension
    /// Where the scenes and recordings are: the open file's folder, or ./saves if there is none.
    std::filesystem::path savesFolder() const;
    /// The names of the *.txt files there, sorted.
    std::vector<std::string> saves() const;

    // Recordings of runs (editor_files.cpp), likewise; ".rec" is added to a name with no extension.
    bool saveRecording(const std::filesystem::path& path);
    /// Begins a recorded run again: the scene is the one at its start, and has no file.
    bool openRecording(const std::filesystem::path& path);
    std::vector<std::string> recordings() const;

    // Objects. The type of an object stays what it is; a name in use gets a number behind it.
    ObjectId selected() const { return selected_; }
    void select(ObjectId id) { selected_ = id; }
    /// The selected object's index, if there still is one.
    std::optional<std::size_t> selection() const { return findObject(scene_, selected_); }
    /// Adds one like the draft, the last child of `parent` or at the end, and selects it. An operator comes with the
    /// children it must have, to start from. Null if it was refused.
    ObjectId addObject(const Object& draft, ObjectId parent = {});
    /// One of that type as it is at first; at the top level it stands where standing() puts it.
    ObjectId addObject(const ShapeType& type, ObjectId parent = {});
    /// Where a draft at the top level stands on what is below the point looked at: its lowest point is on the surface there,
    /// or at y = 0 where there is none. A draft without a lowest point stays where it is.
    glm::dvec3 standing(const Object& draft) const;
    bool remove(ObjectId id);
    bool removeSelected();
    /// Removes the top-level object that was added last.
    bool removeLast();
    /// Removes every object.
    void clear();
    /// Gives the object of that index the draft's values; its type, id and parent stay.
    bool setObject(std::size_t index, const Object& values);

    // The other records. Setting one is an edit only if it changes something.
    std::size_t addMaterial(Material draft);
    void setMaterial(std::size_t index, Material values);
    std::size_t addLight(Light draft);
    void setLight(std::size_t index, Light values);
    void removeLight(std::size_t index);
    void setWorld(const World& values);
    void setRender(const RenderKnobs& values);
    void setPhysics(const PhysicsKnobs& values);

    // The eye.
    Camera camera() const { return orbit_.camera(); }
    void turn(double yaw, double pitch) { orbit_.turn(yaw, pitch), ++revision_; }
    void zoom(double notches) { orbit_.zoom(notches), ++revision_; }
    void pan(double right, double up) { orbit_.pan(right, up), ++revision_; }
    void lookThrough(const Camera& camera) { orbit_ = Orbit::around(camera), ++revision_; }
    /// Makes the eye's place the scene's first camera: an edit. Looking around alone is none.
    void keepView();
    /// Back to the scene's first camera.
    void resetView();
    /// Selects what is seen at a point of the picture (pixels from its top left corner): the whole object first, the part of
    /// it if that is selected already. Null where nothing is. A grid that the picture was drawn through saves asking every object.
    ObjectId pick(glm::ivec2 picture, glm::dvec2 point, const Grid* drawn = nullptr);

    // The hand in the picture (editor_hand.cpp); points as in pick().
    /// Takes hold of the body seen at a point of the picture, by that point, and plays. Says whether there is one.
    bool grab(glm::ivec2 picture, glm::dvec2 point, const Grid* drawn = nullptr);
    /// Moves what is held to another point of the picture, at the distance it was taken hold of.
    void drag(glm::ivec2 picture, glm::dvec2 point);
    void letGo() { simulation_.letGo(); }
    /// The place that is held and the place of the hand.
    struct Held {
        glm::dvec3 place, hand;
    };
    std::optional<Held> held() const;
    /// Blows up at what is seen at a point of the picture, as far as half the way to the eye, and plays.
    bool explode(glm::ivec2 picture, glm::dvec2 point, const Grid* drawn = nullptr);

    // Time (editor_motion.cpp).
    const Simulation& simulation() const { return simulation_; }
    bool playing() const { return simulation_.playing; }
    /// The run so far; null before the first step.
    const Timeline* timeline() const { return simulation_.timeline(); }
    /// Whether the next advance() can change anything.
    bool moving() const { return (playing() && !simulation_.asleep()) || seeking(); }
    void play();
    void pause() { simulation_.playing = false; }
    /// The bodies as the next step finds them; null where the scene cannot be stepped.
    const PhysicsWorld* bodies();
    /// The seed of the next throw; each later one adds 1.
    void seedThrows(std::uint64_t seed) { simulation_.throws = seed; }
    void step();
    /// Goes to the moment after so many steps, at most the last one made, and pauses: the bodies are shown as they were, and
    /// what does not move as well. What takes longer than a frame goes on in advance(). Playing from there makes the same
    /// steps again, with all that was done; doing something new there discards them, and says so.
    void seek(std::uint64_t step);
    bool seeking() const { return simulation_.seeking(); }
    void stepBack();
    bool canStepBack() const { return simulation_.steps() > 0; }
    /// Puts the bodies back to where they were before the first step; whatever else was edited since stays.
    void reset();
    bool canReset() const { return before_.has_value(); }
    /// Gives every body a push of its own, and plays.
    void throwAbout();
    /// Lets wall time pass.
    void advance(double seconds);

    // What accuracy costs (editor_accuracy.cpp).
    /// Whether it shows that scene from there, whatever the knobs are at.
    bool stillShows(const Scene& scene, const Camera& from) const;
    /// Turns the knobs of a picture, or of a motion, to what that setting has them at, and says which; whatever else there is stays.
    void setKnobs(const Setting& setting, bool motion);

private:
    /// What an edit means to the run so far: nothing, shapes and knobs that change in it, or the begin of a new one.
    enum class Change { looks, statics, bodies };
    void edited(Change change);
    Change changeOf(std::size_t index) const;
    /// What is seen at a point of the picture: where, and the object's index.
    struct SeenAt {
        glm::dvec3 place;
        std::size_t index;
    };
    std::optional<SeenAt> seenAt(glm::ivec2 picture, glm::dvec2 point, const Grid* drawn) const;
    bool refuse(std::string why);
    std::string whyInvalid(Object object) const;
    void insertObject(Object object, int parent);
    double surfaceBelow(double x, double z) const;
    bool readyToMove();
    void leaveFuture();
    void moved();
    void begin(Scene scene, const std::filesystem::path& path);
    std::vector<std::string> filesEndingIn(std::string_view ending) const;
    void forget(ObjectId id);

    Scene scene_;
    std::filesystem::path path_, folder_ = "saves";  // folder_: where the files are while there is no path
    std::uint64_t revision_ = 1, edits_ = 0, saved_edits_ = 0;
    Scene saved_;  // the scene as it was read or written last
    Message message_;
    ObjectId selected_;
    Orbit orbit_;
    Simulation simulation_;
    double hand_ahead_ = 0;  // m, of the eye: the plane in which the hand moves
    std::optional<std::vector<Object>> before_;  // the objects as they were before the first step
};

/// A name near `wanted` that no record of these has, but for the one at `self`. Nothing stays nothing.
template <class Record> std::string freeName(const std::vector<Record>& records, const std::string& wanted, std::size_t self);

/// The top-level object above the one of that index, itself included.
std::size_t topLevel(const Scene& scene, std::size_t index);

}  // namespace mb
