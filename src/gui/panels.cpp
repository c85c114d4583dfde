#include "gui/panels.h"

#include "gui/widgets.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <cstring>

namespace mb {
namespace {

void askOpen(Ui& ui) { ui.scenes.files = ui.editor.saves(), ui.show("Open"); }
void askSaveAs(Ui& ui) { ui.scenes.name = ui.editor.path().stem().string(), ui.show("Save as"); }
void askSaveRecording(Ui& ui) { ui.recordings.name = ui.editor.path().stem().string(), ui.show("Save recording"); }
void save(Ui& ui) { ui.editor.path().empty() ? askSaveAs(ui) : static_cast<void>(ui.editor.save()); }
void exit(Ui& ui) { ui.unlessUnsaved([&ui] { ui.quit = true; }); }
void playOrPause(Ui& ui) { ui.editor.playing() ? ui.editor.pause() : ui.editor.play(); }

bool hasSelection(const Ui& ui) { return ui.editor.selection().has_value(); }
bool hasObjects(const Ui& ui) { return !ui.editor.scene().objects.empty(); }
bool canStepBack(const Ui& ui) { return ui.editor.canStepBack(); }
bool canReset(const Ui& ui) { return ui.editor.canReset(); }

const Entry kEntries[] = {
    {.menu = "File", .name = "Open", .shortcut = {GLFW_KEY_O, true, "Ctrl+O"}, .tip = "a scene from the list of the saves",
     .draw = drawOpen, .run = askOpen, .width = 380},
    {.menu = "File", .name = "Save", .shortcut = {GLFW_KEY_S, true, "Ctrl+S"}, .tip = "to the scene's file", .run = save},
    {.menu = "File", .name = "Save as", .tip = "to a file of another name", .draw = drawSaveAs, .run = askSaveAs, .width = 380},
    {.menu = "File", .name = "Exit", .shortcut = {GLFW_KEY_ESCAPE, false, "Esc"}, .tip = "asks about unsaved work; Esc closes a panel in front first",
     .run = exit},

    {.menu = "Edit", .name = "Objects", .tip = "the tree of all objects", .draw = drawObjects, .place = Place::column_top, .at_start = true},
    {.menu = "Edit", .name = "Attributes", .tip = "of the selected object", .draw = drawAttributes, .place = Place::column_bottom,
     .at_start = true},
    {.menu = "Edit", .name = "Add object", .shortcut = {GLFW_KEY_INSERT, false, "Insert"}, .tip = "of any type", .draw = drawAddObject},
    {.menu = "Edit", .name = "Delete selected", .shortcut = {GLFW_KEY_DELETE, false, "Delete"}, .tip = "with its children",
     .run = [](Ui& ui) { ui.editor.removeSelected(); }, .enabled = hasSelection},
    {.menu = "Edit", .name = "Remove last", .tip = "the object added last", .run = [](Ui& ui) { ui.editor.removeLast(); },
     .enabled = hasObjects},
    {.menu = "Edit", .name = "Clear", .tip = "removes every object", .run = [](Ui& ui) { ui.editor.clear(); }, .enabled = hasObjects},
    {.menu = "Edit", .name = "Materials", .tip = "what surfaces look like", .draw = drawMaterials},
    {.menu = "Edit", .name = "Lights", .tip = "where the light comes from", .draw = drawLights},
    {.menu = "Edit", .name = "Camera", .tip = "where the scene is seen from", .draw = drawCamera},

    {.menu = "Motion", .name = "Play or pause", .shortcut = {GLFW_KEY_SPACE, false, "Space"}, .tip = "lets time pass, or stops it",
     .run = playOrPause},
    {.menu = "Motion", .name = "Step", .shortcut = {GLFW_KEY_PERIOD, false, ".", true}, .tip = "one step of the physics",
     .run = [](Ui& ui) { ui.editor.step(); }},
    {.menu = "Motion", .name = "Step back", .shortcut = {GLFW_KEY_COMMA, false, ",", true}, .tip = "to the moment one step before",
     .run = [](Ui& ui) { ui.editor.stepBack(); }, .enabled = canStepBack},
    {.menu = "Motion", .name = "Reset", .shortcut = {GLFW_KEY_R, false, "R"}, .tip = "the bodies go back to where they started",
     .run = [](Ui& ui) { ui.editor.reset(); }, .enabled = canReset},
    {.menu = "Motion", .name = "Throw about", .shortcut = {GLFW_KEY_J, false, "J"}, .tip = "gives every body a push",
     .run = [](Ui& ui) { ui.editor.throwAbout(); }},
    {.menu = "Motion", .name = "Explode", .shortcut = {GLFW_KEY_X, false, "X"},
     .tip = "blows the bodies away from what is under the mouse; else from the middle of the picture", .run = explodeThere},
    {.menu = "Motion", .name = "Meters", .shortcut = {GLFW_KEY_F5, false, "F5"}, .tip = "energy, momentum, overlap and contacts, now and over the last steps",
     .draw = drawMeters, .width = 420},
    {.menu = "Motion", .name = "Timeline", .shortcut = {GLFW_KEY_F4, false, "F4"}, .tip = "back and forth through all steps made",
     .draw = drawTimeline, .place = Place::below_picture, .height = 88},
    {.menu = "Motion", .name = "Save recording", .tip = "the run so far, to be made again and compared step by step", .draw = drawSaveRecording,
     .run = askSaveRecording, .width = 380},
    {.menu = "Motion", .name = "Open recording", .tip = "makes a recorded run again", .draw = drawOpenRecording, .width = 380},

    {.menu = "Settings", .name = "Controls", .shortcut = {GLFW_KEY_F1, false, "F1"}, .tip = "what the mouse and the keys do",
     .draw = drawControls, .width = 430},
    {.menu = "Settings", .name = "Debug", .tip = "the live state of every body", .draw = drawDebug, .width = 740, .height = 320},
    {.menu = "Settings", .name = "Constants", .tip = "gravity and where it points, restitution, friction, and the steps of time", .draw = drawConstants},
    {.menu = "Settings", .name = "Picture", .tip = "the picture's quality, and what the scene calls for", .draw = drawPicture, .width = 420},
    {.menu = "Settings", .name = "Effects", .shortcut = {GLFW_KEY_F2, false, "F2"}, .tip = "what the scene calls for, by which records, and what it costs",
     .draw = drawEffects, .width = 760, .height = 520},
    {.menu = "Settings", .name = "Accuracy", .shortcut = {GLFW_KEY_F3, false, "F3"}, .tip = "what the picture and the motion are wrong by, and what less costs",
     .draw = drawAccuracy, .width = 600, .height = 600},
};

constexpr MouseControl kMouse[] = {
    {"Left drag", "turns the view around the scene"},
    {"Shift + left drag on a body", "holds it by a spring, and plays; letting go throws it"},
    {"Middle drag", "moves the view sideways"},
    {"Wheel", "comes nearer or goes further"},
    {"Right click on an object", "opens its attributes; once more: those of the part under the mouse"},
    {"Ctrl+click on a slider", "types a number into it"},
};

bool inColumn(const Entry& entry) { return entry.place == Place::column_top || entry.place == Place::column_bottom; }

bool anyOpen(const Ui& ui, bool (*wanted)(const Entry&)) {
    for (std::size_t i = 0; i < entries().size(); ++i)
        if (ui.open[i] && wanted(entries()[i])) return true;
    return false;
}

/// Where a docked panel goes: below the picture, or in the column on the right, shared by those of its panels that are open.
void placeDocked(const Ui& ui, const Entry& entry) {
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const float top = ui.picture_corner.y, height = std::max(screen.y - 2 * top, 1.0f), left = ui.picture_corner.x + ui.picture_size.x;
    if (entry.place == Place::below_picture) {
        const float below = top + ui.picture_size.y;
        ImGui::SetNextWindowPos({ui.picture_corner.x, below});
        return ImGui::SetNextWindowSize({std::max(ui.picture_size.x, 1.0f), std::max(top + height - below, 1.0f)});
    }
    const bool above = anyOpen(ui, [](const Entry& e) { return e.place == Place::column_top; });
    const bool below = anyOpen(ui, [](const Entry& e) { return e.place == Place::column_bottom; });
    const float split = above && below ? 0.40f : 1.0f;
    const bool is_top = entry.place == Place::column_top;
    const float y = is_top || !above ? top : top + height * split, h = is_top ? height * split : height * (above ? 1 - split : 1.0f);
    ImGui::SetNextWindowPos({left, y});
    ImGui::SetNextWindowSize({std::max(screen.x - left, 1.0f), std::max(h, 1.0f)});
}

/// A cascade: each floating panel of the table starts below the title of the one before it.
void placeFloating(const Entry& entry, int order) {
    const float scale = ImGui::GetFontSize() / 15, step = ImGui::GetFrameHeight(), by = static_cast<float>(order);
    ImGui::SetNextWindowPos({16 + step * by, 1.5f * step + 1.25f * step * by}, ImGuiCond_FirstUseEver);
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    if (entry.height > 0) {
        ImGui::SetNextWindowSize({entry.width * scale, entry.height * scale}, ImGuiCond_FirstUseEver);
        ImGui::SetNextWindowSizeConstraints({100, 60}, {std::max(screen.x, 100.0f), std::max(screen.y - 2 * step, 60.0f)});
    }
    const float most = std::max(screen.y - 4 * step, 100.0f);
    if (entry.height == 0) ImGui::SetNextWindowSizeConstraints({entry.width * scale, 0}, {entry.width * scale * 2, most});
}

/// How many floating panels stand before that row of the table.
int floatingBefore(std::size_t row) {
    return static_cast<int>(std::ranges::count_if(entries().first(row), [](const Entry& e) { return e.draw && e.place == Place::floating; }));
}

/// A window that was made small and large again leaves no panel beyond its edges, nor does one that grew.
void keepInside(const Ui& ui) {
    const ImVec2 at = ImGui::GetWindowPos(), top = ui.picture_corner;
    const float lowest = top.y + ui.picture_size.y - ImGui::GetWindowHeight(), rightmost = ImGui::GetIO().DisplaySize.x - ImGui::GetWindowWidth();
    const ImVec2 inside{std::max(std::min(at.x, rightmost), 0.0f), std::max(std::min(at.y, lowest), top.y)};
    if (inside.x != at.x || inside.y != at.y) ImGui::SetWindowPos(inside);
}

void drawPanel(Ui& ui, const Entry& entry, std::size_t i) {
    ImGuiWindowFlags flags = ImGuiWindowFlags_NoSavedSettings;
    if (entry.place == Place::floating) {
        placeFloating(entry, floatingBefore(i));
        if (entry.height == 0) flags |= ImGuiWindowFlags_AlwaysAutoResize;
    } else {
        placeDocked(ui, entry);
        flags |= ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoBringToFrontOnFocus;
    }
    bool stays = true;
    ui::seen_panel = entry.name;
    const bool shown = ImGui::Begin(entry.name, &stays, flags);
    if (entry.place == Place::floating) keepInside(ui);
    if (shown) entry.draw(ui);
    ImGui::End();
    if (!stays) ui.open[i] = false;
}

/// The picture gets what the bars, the column and the panel below it leave.
void layOut(Ui& ui) {
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const float bar = ImGui::GetFrameHeight(), scale = ImGui::GetFontSize() / 15;
    const float width = anyOpen(ui, inColumn) ? std::min(340 * scale, screen.x / 2) : 0;
    const float high = std::max(screen.y - 2 * bar, 0.0f);
    float strip = 0;
    for (std::size_t i = 0; i < entries().size(); ++i)
        if (ui.open[i] && entries()[i].place == Place::below_picture) strip = std::min(entries()[i].height * scale, high / 2);
    ui.picture_corner = {0, bar};
    ui.picture_size = {std::max(screen.x - width, 0.0f), high - strip};
}

}  // namespace

std::span<const Entry> entries() { return kEntries; }
std::span<const MouseControl> mouseControls() { return kMouse; }

Ui::Ui(Editor& edited) : editor(edited) {
    for (const Entry& entry : entries()) open.push_back(entry.at_start);
    draft.type = &primitives().front(), draft.numbers = initialNumbers(*draft.type), draft.pos = {0, 1, 0};
}

bool Ui::isOpen(const char* panel) const {
    for (std::size_t i = 0; i < entries().size(); ++i)
        if (std::strcmp(entries()[i].name, panel) == 0) return open[i];
    return false;
}

void Ui::show(const char* panel, bool opened) {
    for (std::size_t i = 0; i < entries().size(); ++i)
        if (std::strcmp(entries()[i].name, panel) == 0) open[i] = opened;
}

void Ui::unlessUnsaved(std::function<void()> what) {
    if (!editor.unsaved()) return what();
    if (!after) after = std::move(what);
}

void Ui::stopMeasuring() {
    AccuracyMemory& a = accuracy;
    a.stopped |= picture.sweeping || picture.sweep_wanted || a.sweeping_motion;
    picture.sweeping = picture.sweep_wanted = a.sweeping_motion = false;
}

void drawInterface(Ui& ui) {
    drawMenuBar(ui);
    layOut(ui);
    drawHand(ui);
    for (std::size_t i = 0; i < entries().size(); ++i)
        if (ui.open[i] && entries()[i].draw) drawPanel(ui, entries()[i], i);
    if (!ui.isOpen("Effects")) ui.picture.pricing = ui.pricing_motion = false;  // nobody waits for it
    if (!ui.isOpen("Accuracy")) ui.stopMeasuring(), ui.picture.errors_wanted = false;
    drawStatusBar(ui);
    drawMessage(ui);
    drawQuestion(ui);
}

}  // namespace mb
