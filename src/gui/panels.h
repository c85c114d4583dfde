#pragma once
// The interface: one table of panels and commands, which the menus, the windows, the keys and the list of controls walk.
// Everything here needs Dear ImGui and no window.
#include "core/accuracy/chart.h"
#include "core/render/ledger.h"
#include "core/render/picture_sweep.h"
#include "gui/editor.h"
#include "physics/ledger.h"
#include "physics/motion_sweep.h"

#include <imgui.h>

#include <functional>
#include <limits>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace mb {

/// What the viewport has to say in the status bar and to the Picture panel.
struct PictureState {
    glm::ivec2 drawn{0}, full{0};  // pixels of the picture shown, and of the place it is shown in
    double ms = 0;                 // of the last picture drawn
    bool refining = false;
    bool compiling = false;        // what is to be drawn or counted waits for its program; the last picture shows
    std::string why;               // it cannot be drawn; the last one that could still shows
    std::string renderer;          // GL_RENDERER
    const Grid* grid = nullptr;    // it was drawn through that; null: through none
    bool count_wanted = false;     // asked for by a panel; the viewport answers in `counts`
    std::string counts;
    std::optional<PictureLedger> ledger;  // asked for by a panel; the viewport fills it whenever the picture is at rest
    bool pricing = false;                 // it is not full yet
    std::optional<PictureSweep> sweep;    // the same of what accuracy costs
    bool sweeping = false;                // it is to go on
    bool sweep_wanted = false;            // of the scene as it is now; the viewport makes it, or says why it cannot
    std::string sweep_why;
    bool errors_wanted = false;           // the picture tinted by its errors in its place; off by itself where the view changes
    bool errors_shown = false;            // it shows, of the knobs as they are
    std::string errors_note;              // what there is to say of it
};

/// A key that went down, with what was held beside it.
struct KeyPress {
    int key = 0;        // GLFW's number
    bool ctrl = false, repeated = false;
};

/// What the Accuracy panel remembers.
struct AccuracyMemory {
    std::optional<MotionSweep> motions;   // of the scene of PictureState's sweep
    std::vector<const Knob*> motion_knobs;
    bool asked_motion = false;            // whether anything moves, once the picture was done
    bool sweeping_motion = false;         // it is to go on
    bool stopped = false;                 // before both were done
    bool current = false;                 // the scene is still the one measured, but for its knobs; seen from the same place
    std::uint64_t compared_revision = 0;  // when that was last asked
    // What is shown, and what it was made from.
    const Knob* knob = nullptr;           // null: all together
    bool motion = false;
    std::vector<ChartPanel> charts;
    std::string words;
    std::uint64_t charts_revision = 0;
    std::size_t charts_runs = 0;
    // The budget.
    double most_error = 0;
    std::string picked;                   // what was, in words; empty: the slider was not moved yet
};

/// What the Meters panel has seen of the run, the newest last.
struct Meters {
    static constexpr std::size_t kMost = 240;
    struct Moment {
        std::uint64_t step = 0;
        float energy = 0, kinetic = 0, deepest = 0;  // J, J, m
    };
    std::vector<Moment> moments;
};

/// What a panel of files remembers.
struct FileChoice {
    std::vector<std::string> files;
    std::string file, name;  // the one to open; the one to save as
};

inline constexpr double kForever = std::numeric_limits<double>::infinity();

struct Ui {
    explicit Ui(Editor& edited);

    Editor& editor;
    std::vector<bool> open;            // one a row of entries()
    bool quit = false;                 // the program is to end
    // Since the last frame. A slow frame may see a key go down and up again, which Dear ImGui's state of keys does not tell.
    std::vector<KeyPress> pressed;
    // Where the picture is: what the docked panels and the bars leave of the window; in ImGui's units, from the top left.
    ImVec2 picture_corner{0, 0}, picture_size{0, 0};
    PictureState picture;
    double frames_per_second = 0;      // 0: nothing moves, so nothing is redrawn

    // What the panels remember from frame to frame.
    Object draft;
    bool draft_below = false;          // the draft goes under the selected operator
    bool draft_stands = true;          // else it comes where its pos says
    Material new_material{.name = "material"};
    Light new_light{.name = "light", .pos = {0, 5, 0}};
    int shown_material = 0, shown_light = 0;
    FileChoice scenes, recordings;
    std::set<std::uint32_t> folded;    // operators whose children the tree hides
    ObjectId listed;                   // the selection the tree has last shown
    bool attributes_to_top = false;
    std::function<void()> after;       // what waits for an answer about unsaved work
    std::string save_name;             // typed into that question
    std::uint64_t planned_revision = 0;
    Plan plan;
    std::uint64_t called_revision = 0;
    std::vector<EffectPrice> called;   // of the scene as it is, unpriced: who calls for what
    std::optional<MotionLedger> motion_ledger;
    bool pricing_motion = false;       // it is not full yet
    std::uint64_t priced_revision = 0; // that both ledgers are of
    AccuracyMemory accuracy;
    Meters meters;
    bool holding = false;              // the mouse holds a body
    double message_until = kForever;   // ImGui's time when it goes by itself
    std::string message_shown;

    bool isOpen(const char* panel) const;
    void show(const char* panel, bool open = true);
    /// Calls `what` at once if nothing is unsaved; else asks first.
    void unlessUnsaved(std::function<void()> what);
    /// The sweeps rest, with the runs they have.
    void stopMeasuring();
};

/// A key with what is held down beside it. `key` is GLFW's number for it, 0 for none.
struct Shortcut {
    int key = 0;
    bool ctrl = false;
    const char* shown = "";
    bool repeats = false;  // while it is held
};

enum class Place { floating, column_top, column_bottom, below_picture };

/// One row of the interface: a panel if it draws, else a command that runs.
struct Entry {
    const char *menu, *name;
    Shortcut shortcut = {};
    const char* tip = "";
    void (*draw)(Ui&) = nullptr;
    void (*run)(Ui&) = nullptr;
    bool (*enabled)(const Ui&) = nullptr;
    Place place = Place::floating;
    bool at_start = false;
    float width = 360, height = 0;  // of a floating panel at first; height 0: as high as its contents. One below the picture has its height
};
std::span<const Entry> entries();
/// What the mouse does, one line each, for the list of controls.
struct MouseControl {
    const char *what, *does;
};
std::span<const MouseControl> mouseControls();

/// Draws the whole interface: between ImGui's NewFrame and Render, once a frame.
void drawInterface(Ui& ui);
/// Hands the keys and the mouse to the editor where Dear ImGui does not want them (input.cpp).
void handleInput(Ui& ui);
// The hand in the picture (hand.cpp).
/// Whether that place on the screen is of the picture; and where in it, in its pixels.
bool overPicture(const Ui& ui, ImVec2 at);
glm::dvec2 inPicture(const Ui& ui, ImVec2 at);
glm::ivec2 pictureSize(const Ui& ui);
/// Grabs, drags and lets go as the mouse does; says whether the mouse holds a body.
bool handleHand(Ui& ui);
/// A line from the place that is held to the hand.
void drawHand(const Ui& ui);
/// Blows up what is under the mouse, or in the middle of the picture where the mouse is elsewhere.
void explodeThere(Ui& ui);

// The panels, one file each or a few.
void drawObjects(Ui& ui);
void drawAttributes(Ui& ui);
void drawAddObject(Ui& ui);
void drawMaterials(Ui& ui);
void drawLights(Ui& ui);
void drawCamera(Ui& ui);
void drawOpen(Ui& ui);
void drawSaveAs(Ui& ui);
void drawOpenRecording(Ui& ui);
void drawSaveRecording(Ui& ui);
void drawTimeline(Ui& ui);
void drawMeters(Ui& ui);
void drawControls(Ui& ui);
void drawDebug(Ui& ui);
void drawConstants(Ui& ui);
void drawPicture(Ui& ui);
void drawEffects(Ui& ui);
void drawAccuracy(Ui& ui);
// What surrounds them (bars.cpp, question.cpp).
void drawMenuBar(Ui& ui);
void drawStatusBar(Ui& ui);
void drawMessage(Ui& ui);
void drawQuestion(Ui& ui);

}  // namespace mb
