#include "gui/plot.h"

#include "gui/widgets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mb::ui {
namespace {

constexpr float kWide = 255, kHigh = 188;  // of a plot at least, at the font's first size
constexpr float kReach = 9;                // from a point at which the mouse is on it

struct Style {
    enum class Mark { dot, ring, square } mark;
    ImU32 color;
    float size;
};
Style styleOf(ChartSeries::Look look) {
    using enum ChartSeries::Look;
    constexpr ImU32 kBlue = IM_COL32(96, 165, 250, 255), kGrey = IM_COL32(128, 137, 152, 190);
    switch (look) {
    case line: return {Style::Mark::dot, kBlue, 3.5f};
    case faint_dots: return {Style::Mark::dot, kGrey, 2};
    case own: return {Style::Mark::ring, IM_COL32(251, 146, 60, 255), 7};
    case usual: return {Style::Mark::square, IM_COL32(74, 222, 128, 255), 5};
    case better: return {Style::Mark::ring, IM_COL32(192, 132, 252, 255), 7};
    }
    return {Style::Mark::dot, kGrey, 2};
}

float scaleOf() { return ImGui::GetFontSize() / 15; }

/// A pen in the current window.
struct Pen {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    float font = ImGui::GetFontSize() * 0.85f, scale = scaleOf(), alpha = 1;

    ImU32 faded(ImU32 color) const { return (color & ~IM_COL32_A_MASK) | static_cast<ImU32>(static_cast<float>(color >> IM_COL32_A_SHIFT) * alpha) << IM_COL32_A_SHIFT; }
    ImU32 ink(ImGuiCol color) const { return faded(ImGui::GetColorU32(color)); }
    ImVec2 sizeOf(std::string_view text) const { return ImGui::GetFont()->CalcTextSizeA(font, 1e6f, 0, text.data(), text.data() + text.size()); }
    /// Beside the place: 0 to its right, 0.5 in its middle, 1 to its left.
    void words(ImVec2 at, float anchor, std::string_view text, ImU32 color) const {
        list.AddText(ImGui::GetFont(), font, {at.x - anchor * sizeOf(text).x, at.y}, color, text.data(), text.data() + text.size());
    }
    void mark(const Style& s, ImVec2 at) const {
        const float r = s.size * scale;
        if (s.mark == Style::Mark::dot) list.AddCircleFilled(at, r, faded(s.color), 12);
        else if (s.mark == Style::Mark::ring) list.AddCircle(at, r, faded(s.color), 20, 2 * scale);
        else list.AddRect({at.x - r, at.y - r}, {at.x + r, at.y + r}, faded(s.color), 0, 0, 2 * scale);
    }
};

struct Plot {
    const ChartPanel& panel;
    Axis x, y;
    ImVec2 lo, hi;  // the axes' rectangle on the screen

    ImVec2 at(const ChartPoint& p) const {
        return {lo.x + static_cast<float>(placeOn(x, p.x, kZeroColumn)) * (hi.x - lo.x), hi.y - static_cast<float>(placeOn(y, p.y, kZeroColumn)) * (hi.y - lo.y)};
    }
};

/// The lines of an axis with their numbers, as many as there is room for, and of its 0.
void drawAxis(const Pen& pen, const Plot& plot, const Axis& axis, bool across) {
    const ImU32 grid = pen.faded(IM_COL32(255, 255, 255, 26)), dim = pen.ink(ImGuiCol_TextDisabled);
    const float length = across ? plot.hi.x - plot.lo.x : plot.hi.y - plot.lo.y, room = across ? 3.2f * pen.font : 1.6f * pen.font;
    const auto line = [&](float share, const std::string& name, bool zero) {
        const float along = share * length;
        const ImVec2 from = across ? ImVec2{plot.lo.x + along, plot.hi.y} : ImVec2{plot.lo.x, plot.hi.y - along};
        if (!zero) pen.list.AddLine(from, across ? ImVec2{from.x, plot.lo.y} : ImVec2{plot.hi.x, from.y}, grid);
        if (across) pen.words({from.x, from.y + 5 * pen.scale}, 0.5f, name, dim);
        else pen.words({from.x - 5 * pen.scale, from.y - pen.font / 2}, 1, name, dim);
    };
    if (axis.zero) line(0, "none", true);
    float last = axis.zero ? 0 : -room;
    for (const double value : axis.lines) {
        const auto share = static_cast<float>(placeOn(axis, value, kZeroColumn));
        const bool named = share * length - last >= room;
        line(share, named ? lineName(value) : std::string(), false);
        if (named) last = share * length;
    }
}

void drawSeries(const Pen& pen, const Plot& plot, const ChartSeries& s) {
    const Style style = styleOf(s.look);
    if (s.look == ChartSeries::Look::line)
        for (std::size_t i = 1; i < s.points.size(); ++i) pen.list.AddLine(plot.at(s.points[i - 1]), plot.at(s.points[i]), pen.faded(style.color), 1.5f * pen.scale);
    for (const ChartPoint& p : s.points) pen.mark(style, plot.at(p));
}

struct Rect {
    ImVec2 lo, hi;
    bool meets(const Rect& r) const { return lo.x < r.hi.x && r.lo.x < hi.x && lo.y < r.hi.y && r.lo.y < hi.y; }
    bool holds(const Rect& r) const { return lo.x <= r.lo.x && lo.y <= r.lo.y && hi.x >= r.hi.x && hi.y >= r.hi.y; }
};

/// What is written beside points, in one of their four corners: where there is room in one.
void drawLabels(const Pen& pen, const Plot& plot) {
    std::vector<Rect> taken;
    for (const ChartSeries& s : plot.panel.series)
        for (const ChartPoint& p : s.points) {
            const ImVec2 at = plot.at(p);
            const float r = styleOf(s.look).size * pen.scale;
            taken.push_back({{at.x - r, at.y - r}, {at.x + r, at.y + r}});
        }
    for (const ChartSeries& s : plot.panel.series)
        for (const ChartPoint& p : s.points) {
            if (p.label.empty()) continue;
            const ImVec2 at = plot.at(p), size = pen.sizeOf(p.label);
            const float gap = 5 * pen.scale;
            for (const ImVec2 corner : {ImVec2{1, -1}, ImVec2{-1, -1}, ImVec2{1, 1}, ImVec2{-1, 1}}) {
                const float x = corner.x > 0 ? at.x + gap : at.x - gap - size.x, y = corner.y < 0 ? at.y - gap - size.y + 3 * pen.scale : at.y + gap - 3 * pen.scale;
                const Rect here{{x, y}, {x + size.x, y + size.y}};
                if (!Rect{plot.lo, plot.hi}.holds(here) || std::ranges::any_of(taken, [&](const Rect& t) { return t.meets(here); })) continue;
                taken.push_back(here);
                pen.words(here.lo, 0, p.label, pen.ink(ImGuiCol_Text));
                break;
            }
        }
}

/// The point that the mouse is on, if it is on one.
const ChartPoint* pointUnder(const Plot& plot, ImVec2 mouse, float reach) {
    const ChartPoint* nearest = nullptr;
    float least = reach * reach;
    for (const ChartSeries& s : plot.panel.series)
        for (const ChartPoint& p : s.points) {
            const ImVec2 at = plot.at(p);
            const float dx = at.x - mouse.x, dy = at.y - mouse.y, apart = dx * dx + dy * dy;
            if (apart <= least) least = apart, nearest = &p;  // of points in one place the one drawn last: marks lie over dots
        }
    return nearest;
}

void notePoints(const Plot& plot) {
    if (!seen) return;
    for (const ChartSeries& s : plot.panel.series)
        for (const ChartPoint& p : s.points) {
            const ImVec2 at = plot.at(p);
            note(fmt::format("{} {}", plot.panel.title, p.run), at, at);
        }
}

std::optional<std::size_t> drawPlot(const ChartPanel& panel, ImVec2 size, bool faded) {
    const bool pressed = ImGui::InvisibleButton("plot", size);
    const bool hovered = ImGui::IsItemHovered();
    note(panel.title);
    const ImVec2 lo = ImGui::GetItemRectMin(), hi = ImGui::GetItemRectMax();
    Pen pen;
    pen.alpha = faded ? 0.4f : 1;
    std::vector<double> xs, ys;
    for (const ChartSeries& s : panel.series)
        for (const ChartPoint& p : s.points) xs.push_back(p.x), ys.push_back(p.y);
    const float gap = 4 * pen.scale, line = pen.font + gap, left = pen.sizeOf("1e-88").x + 8 * pen.scale;
    const Plot plot{panel, axisOf(xs), axisOf(ys), {lo.x + left, lo.y + 2 * line + gap}, {hi.x - 14 * pen.scale, hi.y - 2 * line - 2 * gap}};
    if (plot.hi.x <= plot.lo.x || plot.hi.y <= plot.lo.y) return std::nullopt;

    pen.list.PushClipRect(lo, hi, true);
    pen.words(lo, 0, panel.title, pen.ink(ImGuiCol_Text));
    pen.words({lo.x, lo.y + line}, 0, panel.y_label, pen.ink(ImGuiCol_TextDisabled));
    pen.words({plot.hi.x, hi.y - line}, 1, panel.x_label, pen.ink(ImGuiCol_TextDisabled));
    drawAxis(pen, plot, plot.x, true), drawAxis(pen, plot, plot.y, false);
    pen.list.AddRect(plot.lo, plot.hi, pen.faded(IM_COL32(140, 146, 158, 255)));
    for (const ChartSeries& s : panel.series) drawSeries(pen, plot, s);
    drawLabels(pen, plot);
    if (xs.empty()) pen.words({(plot.lo.x + plot.hi.x) / 2, (plot.lo.y + plot.hi.y) / 2}, 0.5f, "no point yet", pen.ink(ImGuiCol_TextDisabled));
    const ChartPoint* under = hovered ? pointUnder(plot, ImGui::GetIO().MousePos, kReach * pen.scale) : nullptr;
    if (under) pen.list.AddCircle(plot.at(*under), kReach * pen.scale, pen.ink(ImGuiCol_Text), 20, 1.5f * pen.scale);
    pen.list.PopClipRect();
    notePoints(plot);
    if (!under) return std::nullopt;
    tip(under->tip.empty() ? under->label : under->tip + (faded ? "" : "\nA click sets the knobs so."));
    return pressed && under->run >= 0 ? std::optional(static_cast<std::size_t>(under->run)) : std::nullopt;
}

/// Each named series once, whichever panel shows it.
void drawLegend(std::span<const ChartPanel> panels, bool faded) {
    Pen pen;
    pen.alpha = faded ? 0.4f : 1;
    std::vector<std::string_view> named;
    const float mark = 18 * pen.scale, right = ImGui::GetCursorScreenPos().x + ImGui::GetContentRegionAvail().x;
    for (const ChartPanel& panel : panels)
        for (const ChartSeries& s : panel.series) {
            if (s.name.empty() || s.points.empty() || std::ranges::find(named, s.name) != named.end()) continue;
            const float width = mark + pen.sizeOf(s.name).x;
            if (!named.empty() && ImGui::GetItemRectMax().x + 14 * pen.scale + width < right) ImGui::SameLine(0, 14 * pen.scale);
            named.push_back(s.name);
            ImGui::Dummy({width, ImGui::GetTextLineHeight()});
            const ImVec2 at = ImGui::GetItemRectMin();
            pen.mark(styleOf(s.look), {at.x + 8 * pen.scale, at.y + ImGui::GetTextLineHeight() / 2});
            pen.words({at.x + mark, at.y + 1}, 0, s.name, pen.ink(ImGuiCol_Text));
        }
}

}  // namespace

std::optional<std::size_t> plots(std::span<const ChartPanel> panels, bool faded) {
    const float gap = ImGui::GetStyle().ItemSpacing.x, width = ImGui::GetContentRegionAvail().x, scale = scaleOf();
    const int most = static_cast<int>(panels.size()), columns = std::clamp(static_cast<int>((width + gap) / (kWide * scale + gap)), 1, std::max(most, 1));
    const float each = std::max((width - gap * static_cast<float>(columns - 1)) / static_cast<float>(columns), 40.0f);
    std::optional<std::size_t> chosen;
    for (int i = 0; i < most; ++i) {
        if (i % columns > 0) ImGui::SameLine();
        ImGui::PushID(i);
        if (const auto run = drawPlot(panels[static_cast<std::size_t>(i)], {each, kHigh * scale}, faded)) chosen = run;
        ImGui::PopID();
    }
    drawLegend(panels, faded);
    return chosen;
}

}  // namespace mb::ui
