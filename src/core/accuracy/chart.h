#pragma once
// Charts on two logarithmic axes, as SVG: what an error costs.
#include <string>
#include <vector>

namespace mb {

struct ChartPoint {
    double x = 0, y = 0;
    std::string label;            // beside it; and, where `tip` is empty, shown under the mouse
    std::string tip;
};
struct ChartSeries {
    enum class Look { line, dots, faint_dots, own, usual, better } look = Look::line;
    std::string name;             // in the legend; empty: it is not there
    std::vector<ChartPoint> points;
};
/// A pair of axes. An error of 0 has no logarithm: it stands in a column of its own at the left, under "none".
struct ChartPanel {
    std::string title, x_label, y_label;
    std::vector<ChartSeries> series;
};

/// The decades an axis shows, from 10^lo to 10^hi: what holds all values that are not 0, at least one.
struct Decades {
    int lo = 0, hi = 1;
    bool zero = false;            // some value is 0
};
Decades decadesOf(const std::vector<double>& values);
/// Where a value lies on an axis, 0 to 1. `gap` is the width of the column of 0, as a share of the axis, where there is one.
double placeOn(const Decades& axis, double value, double gap);
inline constexpr double kZeroColumn = 0.09;

/// The panels beside one another, three in a row, with a legend below. Any text is allowed in what it is given.
std::string chartSvg(const std::vector<ChartPanel>& panels);

/// Text as it may stand in XML.
std::string escaped(std::string_view text);
/// A number short enough to read: three digits.
std::string brief(double x);

}  // namespace mb
