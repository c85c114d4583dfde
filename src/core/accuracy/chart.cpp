#include "core/accuracy/chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace mb {
namespace {

constexpr std::size_t kAcross = 3;  // panels in a row
constexpr double kPanelWidth = 360, kPanelHeight = 330, kLeft = 64, kRight = 16, kTop = 34, kBottom = 56, kLegend = 30;

struct Box2 {
    double x, y, width, height;
    double atX(double share) const { return x + share * width; }
    double atY(double share) const { return y + height - share * height; }
};

struct Style {
    std::string_view mark, color;
    double size;
};
Style styleOf(ChartSeries::Look look) {
    using enum ChartSeries::Look;
    switch (look) {
    case line: return {"circle", "#2563a8", 3.5};
    case faint_dots: return {"circle", "#b9c2cc", 2};
    case own: return {"ring", "#c2410c", 7};
    case usual: return {"square", "#15803d", 9};
    case better: return {"ring", "#7c3aed", 7};
    }
    return {"circle", "#000", 3};
}

std::string markAt(const Style& s, double x, double y) {
    if (s.mark == "ring") return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2.5\"/>", x, y, s.size, s.color);
    if (s.mark == "square")
        return fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\"/>", x - s.size / 2, y - s.size / 2, s.size, s.size, s.color);
    return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"{}\"/>", x, y, s.size, s.color);
}
std::string words(double x, double y, std::string_view anchor, int size, std::string_view text, std::string_view more = {}) {
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" font-size=\"{}\"{}>{}</text>\n", x, y, anchor, size, more, escaped(text));
}
std::string stroke(double x1, double y1, double x2, double y2, std::string_view color) {
    return fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\"/>\n", x1, y1, x2, y2, color);
}

/// The lines of an axis with their numbers; those that would overlap have none.
template <class Line> void eachLine(const Axis& axis, double length, double room, Line line) {
    double last = axis.zero ? 0 : -room;
    for (const double value : axis.lines) {
        const double share = placeOn(axis, value, kZeroColumn), at = share * length;
        const bool named = at - last >= room;
        line(share, named ? lineName(value) : std::string());
        if (named) last = at;
    }
}
std::string axes(const Box2& box, const Axis& x, const Axis& y) {
    std::string out;
    eachLine(x, box.width, 36, [&](double share, const std::string& name) {
        const double at = box.atX(share);
        out += stroke(at, box.y, at, box.y + box.height, "#e5e7eb") + words(at, box.y + box.height + 15, "middle", 11, name);
    });
    eachLine(y, box.height, 15, [&](double share, const std::string& name) {
        const double at = box.atY(share);
        out += stroke(box.x, at, box.x + box.width, at, "#e5e7eb") + words(box.x - 6, at + 4, "end", 11, name);
    });
    if (x.zero) out += words(box.atX(0), box.y + box.height + 15, "middle", 11, "none");
    if (y.zero) out += words(box.x - 6, box.atY(0) + 4, "end", 11, "none");
    return out + fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"#6b7280\"/>\n", box.x, box.y, box.width, box.height);
}

/// What is written beside points: only where nothing else is.
class Labels {
public:
    std::string at(double x, double y, bool leftwards, const std::string& text) {
        const double width = 5.8 * static_cast<double>(text.size()), left = leftwards ? x - width : x;
        for (const Box2& t : taken_)
            if (left < t.x + t.width && t.x < left + width && std::fabs(y - t.y) < 10) return {};
        taken_.push_back({left, y, width, 10});
        return words(x, y, leftwards ? "end" : "start", 10, text, " fill=\"#374151\"");
    }

private:
    std::vector<Box2> taken_;
};

std::string seriesSvg(const ChartSeries& s, const Box2& box, const Axis& x, const Axis& y, Labels& io_labels) {
    const Style style = styleOf(s.look);
    std::string path, marks;
    for (const ChartPoint& p : s.points) {
        const double px = box.atX(placeOn(x, p.x, kZeroColumn)), py = box.atY(placeOn(y, p.y, kZeroColumn));
        path += fmt::format("{}{:.1f},{:.1f}", path.empty() ? "" : " ", px, py);
        const std::string tip = p.tip.empty() ? p.label : p.tip;
        marks += fmt::format("<g>{}{}</g>\n", markAt(style, px, py), tip.empty() ? "" : fmt::format("<title>{}</title>", escaped(tip)));
        const bool at_right = px > box.x + 0.8 * box.width;
        if (!p.label.empty()) marks += io_labels.at(px + (at_right ? -7 : 7), py - 6, at_right, p.label);
    }
    if (s.look == ChartSeries::Look::line && s.points.size() > 1)
        path = fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.5\"/>\n", path, style.color);
    else path.clear();
    return path + marks;
}

std::string panelSvg(const ChartPanel& panel, double left, double top) {
    const Box2 box{left + kLeft, top + kTop, kPanelWidth - kLeft - kRight, kPanelHeight - kTop - kBottom};
    std::vector<double> xs, ys;
    for (const ChartSeries& s : panel.series)
        for (const ChartPoint& p : s.points) xs.push_back(p.x), ys.push_back(p.y);
    const Axis x = axisOf(xs), y = axisOf(ys);
    Labels labels;
    std::string out = words(box.x + box.width / 2, top + 20, "middle", 13, panel.title, " font-weight=\"bold\"");
    out += axes(box, x, y);
    out += words(box.x + box.width / 2, box.y + box.height + 36, "middle", 12, panel.x_label);
    const double side = left + 14, middle = box.y + box.height / 2;
    out += words(side, middle, "middle", 12, panel.y_label, fmt::format(" transform=\"rotate(-90 {:.1f} {:.1f})\"", side, middle));
    for (const ChartSeries& s : panel.series) out += seriesSvg(s, box, x, y, labels);
    if (xs.empty()) out += words(box.x + box.width / 2, middle, "middle", 12, "every setting failed");
    return out;
}

/// Each named series once, whichever panel shows it, in as many lines as it takes.
struct Legend {
    std::string text;
    double height = 0;
};
Legend legendOf(const std::vector<ChartPanel>& panels, double width, double top) {
    Legend legend{{}, kLegend};
    std::vector<std::string> named;
    double x = kLeft;
    for (const ChartPanel& panel : panels)
        for (const ChartSeries& s : panel.series) {
            if (s.name.empty() || s.points.empty() || std::ranges::find(named, s.name) != named.end()) continue;
            named.push_back(s.name);
            const double room = 40 + 6.6 * static_cast<double>(s.name.size());
            if (x > kLeft && x + room - 28 > width) x = kLeft, legend.height += 18;
            const double y = top + legend.height - kLegend + 12;
            legend.text += markAt(styleOf(s.look), x, y) + words(x + 12, y + 4, "start", 12, s.name);
            x += room;
        }
    return legend;
}

}  // namespace

std::string escaped(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (c == '&') out += "&amp;";
        else if (c == '<') out += "&lt;";
        else if (c == '>') out += "&gt;";
        else if (c == '"') out += "&quot;";
        else if (static_cast<unsigned char>(c) >= 0x20 || c == '\n' || c == '\t') out += c;
    }
    return out;
}

std::string lineName(double value) {
    if (value >= 0.001 && value < 1e5) return fmt::format("{:g}", value);
    const int power = static_cast<int>(std::floor(std::log10(value) + 1e-9));
    return fmt::format("{:.0f}e{}", value / std::pow(10.0, power), power);
}
std::string brief(double x) { return fmt::format("{:.3g}", x); }

Axis axisOf(const std::vector<double>& values) {
    double least = INFINITY, most = 0;
    Axis axis;
    for (const double v : values) {
        if (!(v > 0)) axis.zero = true;
        else least = std::min(least, v), most = std::max(most, v);
    }
    if (most == 0) return axis;
    constexpr double kClose = 40;
    const bool close = most < kClose * least;
    std::vector<double> lines;
    for (int p = static_cast<int>(std::floor(std::log10(least))) - 1; lines.empty() || lines.back() < most; ++p)
        for (const double times : {1.0, 2.0, 5.0})
            if (times == 1 || close) lines.push_back(times * std::pow(10.0, p));
    // From the last line that is not above the least to the first that is not below the most.
    const auto end = std::ranges::find_if(lines, [&](double l) { return l >= most * (1 - 1e-9); }) + 1;
    const auto begin = std::ranges::find_if(lines, [&](double l) { return l > least * (1 + 1e-9); }) - 1;
    axis.lines.assign(std::min(begin, end - 2), end);
    return axis;
}

double placeOn(const Axis& axis, double value, double gap) {
    if (!(value > 0)) return 0;
    const double share = std::log(value / axis.lines.front()) / std::log(axis.lines.back() / axis.lines.front());
    return axis.zero ? gap + (1 - gap) * share : share;
}

std::string chartSvg(const std::vector<ChartPanel>& panels) {
    const std::size_t n = std::max<std::size_t>(panels.size(), 1), rows = (n + kAcross - 1) / kAcross;
    const double width = kPanelWidth * static_cast<double>(std::min(n, kAcross)), top = kPanelHeight * static_cast<double>(rows);
    const Legend legend = legendOf(panels, width, top);
    const double height = top + legend.height;
    std::string out = fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" font-family=\"sans-serif\" fill=\"#111827\">\n"
                                  "<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n", width, height);
    for (std::size_t i = 0; i < panels.size(); ++i)
        out += panelSvg(panels[i], kPanelWidth * static_cast<double>(i % kAcross), kPanelHeight * static_cast<double>(i / kAcross));
    return out + legend.text + "</svg>\n";
}

}  // namespace mb
